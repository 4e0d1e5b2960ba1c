// If the validation layer reports anything, the test fails.
#pragma once

#include "lib/vulkan/device.h"
#include "lib/vulkan/device_choice.h"
#include "lib/vulkan/instance.h"

#include "lib/base/log.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

class VulkanFixture : public testing::Test {
protected:
    static bool validation() { return std::getenv("PT_TEST_NO_VALIDATION") == nullptr; }

    void SetUp() override {
        log_ = {&collect, &messages_};
        instance_.emplace(log_, validation());
    }

    // The layer reports leaks when the device is destroyed.
    void TearDown() override {
        device_.reset();
        instance_.reset();
        for (const std::string &line : messages_)
            ADD_FAILURE() << line;
    }

    vk::raii::PhysicalDevice physical_device() const {
        const std::vector<vk::raii::PhysicalDevice> devices = instance_->physical_devices();
        std::vector<pt_device_info> infos;
        for (const vk::raii::PhysicalDevice &device : devices)
            infos.push_back(pt::vulkan::describe(device));
        const char *wanted = std::getenv("PT_TEST_DEVICE");
        return devices[pt::vulkan::choose_device(infos, wanted ? wanted : "")];
    }

    pt::vulkan::Instance &instance() { return *instance_; }

    pt::vulkan::Device &device() {
        if (!device_)
            device_with(pt::vulkan::default_policy(pt::vulkan::describe(physical_device())));
        return *device_;
    }

    pt::vulkan::Device &device_with(const pt::vulkan::DevicePolicy &policy) {
        device_.emplace(*instance_, physical_device(), policy);
        return *device_;
    }

    std::vector<std::string> messages_;

private:
    static void collect(void *user, int32_t level, const char *line) {
        if (level <= PT_LOG_WARNING)
            static_cast<std::vector<std::string> *>(user)->push_back(line);
    }

    pt::Log log_;
    std::optional<pt::vulkan::Instance> instance_;
    std::optional<pt::vulkan::Device> device_;
};
