#pragma once

#include "lib/vulkan/device_choice.h"
#include "tests/support/sized.h"

#include <pt/pt.h>
#include <pt/vulkan.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// Thread-safe.
class LayerMessages {
public:
    std::vector<std::string> take() {
        const std::lock_guard held(mutex_);
        return std::exchange(lines_, {});
    }

    template <typename Severity, typename Types, typename Data> // types of the C header or of newer Vulkan-Hpp
    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(Severity, Types, const Data *data, void *user) {
        auto *messages = static_cast<LayerMessages *>(user);
        const std::lock_guard held(messages->mutex_);
        messages->lines_.emplace_back(data->pMessage);
        return VK_FALSE;
    }

private:
    std::mutex mutex_;
    std::vector<std::string> lines_;
};

class CallersOwnVulkan {
public:
    static bool validation() { return std::getenv("PT_TEST_NO_VALIDATION") == nullptr; }

    // `messages` must outlive this object.
    explicit CallersOwnVulkan(LayerMessages &messages, std::uint32_t api_version = VK_API_VERSION_1_2) :
        context_(&::vkGetInstanceProcAddr),
        instance_(make_instance(context_, messages, api_version)),
        messenger_(make_messenger(instance_, messages)),
        physical_device_(choose(instance_)),
        family_(compute_family(physical_device_)),
        device_(make_device(physical_device_, family_)),
        queue_(device_.getQueue(family_, 0)) {}

    const vk::raii::Instance &instance() const { return instance_; }
    const vk::raii::PhysicalDevice &physical_device() const { return physical_device_; }
    const vk::raii::Device &device() const { return device_; }
    const vk::raii::Queue &queue() const { return queue_; }
    std::uint32_t family() const { return family_; }

    pt_vulkan handles() const {
        auto vulkan = sized<pt_vulkan>();
        vulkan.queue_family = family_;
        vulkan.instance = static_cast<VkInstance>(*instance_);
        vulkan.physical_device = static_cast<VkPhysicalDevice>(*physical_device_);
        vulkan.device = static_cast<VkDevice>(*device_);
        vulkan.queue = static_cast<VkQueue>(*queue_);
        return vulkan;
    }

private:
    static vk::DebugUtilsMessengerCreateInfoEXT messenger_info(LayerMessages &messages) {
        using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
        using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
        return {.messageSeverity = Severity::eWarning | Severity::eError,
                .messageType = Type::eGeneral | Type::eValidation | Type::ePerformance,
                .pfnUserCallback = &LayerMessages::receive,
                .pUserData = &messages};
    }

    static vk::raii::Instance make_instance(const vk::raii::Context &context, LayerMessages &messages,
                                            std::uint32_t api_version) {
        static constexpr std::array layers = {"VK_LAYER_KHRONOS_validation"};
        static constexpr std::array extensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
        const vk::ApplicationInfo application{.apiVersion = api_version};
        const vk::DebugUtilsMessengerCreateInfoEXT messenger = messenger_info(messages);
        if (!validation())
            return context.createInstance({.pApplicationInfo = &application});
        return context.createInstance({.pNext = &messenger,
                                       .pApplicationInfo = &application,
                                       .enabledLayerCount = layers.size(),
                                       .ppEnabledLayerNames = layers.data(),
                                       .enabledExtensionCount = extensions.size(),
                                       .ppEnabledExtensionNames = extensions.data()});
    }

    static std::optional<vk::raii::DebugUtilsMessengerEXT> make_messenger(const vk::raii::Instance &instance,
                                                                          LayerMessages &messages) {
        if (!validation())
            return std::nullopt;
        return instance.createDebugUtilsMessengerEXT(messenger_info(messages));
    }

    // Devices have the same order in instances of all versions.
    static vk::raii::PhysicalDevice choose(const vk::raii::Instance &instance) {
        std::uint32_t count = 0;
        pt_get_devices(nullptr, &count);
        std::vector<pt_device_info> infos(count);
        pt_get_devices(infos.data(), &count);
        const char *wanted = std::getenv("PT_TEST_DEVICE");
        return instance.enumeratePhysicalDevices().at(pt::vulkan::choose_device(infos, wanted ? wanted : ""));
    }

    static std::uint32_t compute_family(const vk::raii::PhysicalDevice &device) {
        const std::vector<vk::QueueFamilyProperties> families = device.getQueueFamilyProperties();
        std::uint32_t family = 0;
        while (!(families.at(family).queueFlags & vk::QueueFlagBits::eCompute))
            ++family;
        return family;
    }

    static vk::raii::Device make_device(const vk::raii::PhysicalDevice &physical_device, std::uint32_t family) {
        const float priority = 1.0F;
        const vk::DeviceQueueCreateInfo queue{
            .queueFamilyIndex = family, .queueCount = 1, .pQueuePriorities = &priority};
        return physical_device.createDevice({.queueCreateInfoCount = 1, .pQueueCreateInfos = &queue});
    }

    vk::raii::Context context_;
    vk::raii::Instance instance_;
    std::optional<vk::raii::DebugUtilsMessengerEXT> messenger_;
    vk::raii::PhysicalDevice physical_device_;
    std::uint32_t family_;
    vk::raii::Device device_;
    vk::raii::Queue queue_;
};

class CallerVulkanFixture : public testing::Test {
protected:
    void SetUp() override { caller_.emplace(messages_); }

    void TearDown() override {
        caller_.reset();
        for (const std::string &line : messages_.take())
            ADD_FAILURE() << line;
    }

    LayerMessages messages_;
    std::optional<CallersOwnVulkan> caller_;
};
