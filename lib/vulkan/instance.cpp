#include "lib/vulkan/instance.h"

#include "lib/base/error.h"
#include "lib/platform/module.h"
#include "lib/platform/vulkan.h"
#include "lib/vulkan/result.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>

namespace pt::vulkan {

namespace {

constexpr const char *validation_layer = "VK_LAYER_KHRONOS_validation";

// The parameters' types differ between versions of Vulkan-Hpp.
template <typename Severity, typename Types, typename Data>
VKAPI_ATTR VkBool32 VKAPI_CALL on_message(Severity severity, Types /*types*/, const Data *data, void *user) {
    const bool is_error = static_cast<vk::DebugUtilsMessageSeverityFlagBitsEXT>(severity) >=
                          vk::DebugUtilsMessageSeverityFlagBitsEXT::eError;
    static_cast<const Log *>(user)->write(is_error ? PT_LOG_ERROR : PT_LOG_WARNING,
                                          data->pMessage ? data->pMessage : "");
    return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT messenger_info(const Log &log) {
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
    return {.messageSeverity = Severity::eWarning | Severity::eError,
            .messageType = Type::eGeneral | Type::eValidation | Type::ePerformance,
            .pfnUserCallback = &on_message,
            .pUserData = const_cast<Log *>(&log)};
}

template <typename Properties, typename Name>
bool contains(const std::vector<Properties> &list, Name name, const char *wanted) {
    return std::ranges::any_of(list, [&](const Properties &item) { return std::strcmp(item.*name, wanted) == 0; });
}

std::string driver_advice(const vk::raii::Context &context) {
    const std::uint32_t version = context.enumerateInstanceVersion();
    std::string advice = " (Vulkan loader " + std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
                         std::to_string(VK_API_VERSION_MINOR(version)) + "." +
                         std::to_string(VK_API_VERSION_PATCH(version));
    for (const char *name :
         {"VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_LOADER_DRIVERS_SELECT", "VK_LOADER_DRIVERS_DISABLE"})
        if (const char *value = std::getenv(name))
            advice += std::string(", ") + name + "=" + value;
    return advice + "): install the GPU's Vulkan driver, or mesa-vulkan-drivers to render on the CPU";
}

PFN_vkGetInstanceProcAddr loader() {
    if (const PFN_vkGetInstanceProcAddr functions = platform::vulkan_functions())
        return functions;
    throw Error(PT_ERROR_NO_DEVICE,
                "no Vulkan loader: " + platform::module_error() + ": install the GPU's Vulkan driver");
}

void throw_if_out_of_memory(const vk::SystemError &error, const std::string &what_was_being_done) {
    const pt_result result = result_of(static_cast<vk::Result>(error.code().value()));
    if (result == PT_ERROR_OUT_OF_HOST_MEMORY || result == PT_ERROR_OUT_OF_DEVICE_MEMORY)
        throw Error(result, what_was_being_done + ": " + error.what());
}

vk::raii::Instance create_instance(const vk::raii::Context &context,
                                   const vk::DebugUtilsMessengerCreateInfoEXT *messages) {
    std::vector<const char *> layers;
    std::vector<const char *> extensions;
    vk::InstanceCreateFlags flags;
    if (contains(context.enumerateInstanceExtensionProperties(), &vk::ExtensionProperties::extensionName,
                 VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME)) {
        // Without this flag, drivers that are layers over another interface are not listed.
        extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
        flags |= vk::InstanceCreateFlagBits::eEnumeratePortabilityKHR;
    }
    if (messages) {
        if (!contains(context.enumerateInstanceLayerProperties(), &vk::LayerProperties::layerName, validation_layer))
            throw Error(PT_ERROR_UNSUPPORTED, std::string("the validation layer ") + validation_layer +
                                                  " is not installed (Debian: vulkan-validationlayers)");
        layers.push_back(validation_layer);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    const vk::ApplicationInfo application{.pApplicationName = "pt", .apiVersion = VK_API_VERSION_1_2};
    const vk::Instance instance =
        vk::createInstance({.pNext = messages,
                            .flags = flags,
                            .pApplicationInfo = &application,
                            .enabledLayerCount = static_cast<std::uint32_t>(layers.size()),
                            .ppEnabledLayerNames = layers.data(),
                            .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                            .ppEnabledExtensionNames = extensions.data()},
                           nullptr, *context.getDispatcher());
    try {
        return {context, instance};
    } catch (const std::bad_alloc &) { // no memory for the function table
        const PFN_vkVoidFunction destroy =
            context.getDispatcher()->vkGetInstanceProcAddr(instance, "vkDestroyInstance");
        reinterpret_cast<PFN_vkDestroyInstance>(destroy)(instance, nullptr);
        throw;
    }
}

// The loader unloads drivers with the last instance. NVIDIA's driver (580.159) leaks static thread-local storage at
// each load, so some later load fails.
void keep_nvidia_driver_loaded() noexcept {
    for (const char *name : {"libGLX_nvidia.so.0", "libEGL_nvidia.so.0"})
        platform::keep_loaded(name);
}

vk::raii::Instance owned_instance(const vk::raii::Context &context, const Log &log, bool validation) {
    const vk::DebugUtilsMessengerCreateInfoEXT messages = messenger_info(log);
    try {
        vk::raii::Instance instance = create_instance(context, validation ? &messages : nullptr);
        keep_nvidia_driver_loaded();
        return instance;
    } catch (const vk::SystemError &error) {
        throw_if_out_of_memory(error, "creating the Vulkan instance");
        throw Error(PT_ERROR_NO_DEVICE, std::string("no Vulkan driver: ") + error.what() + driver_advice(context));
    }
}

} // namespace

Instance::Instance(const Log &log, bool validation) :
    log_(std::make_unique<Log>(log)),
    context_(loader()),
    instance_(owned_instance(context_, *log_, validation)),
    is_owned_(true) {
    if (validation)
        messenger_.emplace(translated("creating the validation messenger",
                                      [&] { return instance_.createDebugUtilsMessengerEXT(messenger_info(*log_)); }));
}

Instance::Instance(const Log &log, VkInstance instance) :
    log_(std::make_unique<Log>(log)),
    context_(loader()),
    instance_(context_, instance),
    is_owned_(false) {}

std::vector<vk::raii::PhysicalDevice> Instance::physical_devices() const {
    std::vector<vk::raii::PhysicalDevice> devices;
    std::string reason = "the drivers found no device";
    try {
        devices = instance_.enumeratePhysicalDevices();
    } catch (const vk::SystemError &error) {
        throw_if_out_of_memory(error, "listing the Vulkan devices");
        reason = error.what();
    }
    if (devices.empty())
        throw Error(PT_ERROR_NO_DEVICE, "no Vulkan device: " + reason + driver_advice(context_));
    return devices;
}

void Instance::abandon() {
    messenger_.reset();
    is_owned_ = false;
}

} // namespace pt::vulkan
