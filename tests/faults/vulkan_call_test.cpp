#include "tests/faults/life.h"
#include "tests/faults/vulkan_calls.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace {

using namespace faults;

pt_result expected_result(const CallFault &fault) {
    // The device is lost if work does not end, or if its state is unknown.
    if (fault.function == "vkWaitForFences" && fault.result == VK_TIMEOUT)
        return PT_OK;
    if (fault.function == "vkWaitForFences" || fault.function == "vkResetFences")
        return PT_ERROR_DEVICE_LOST;
    if (fault.function == "vkGetFenceStatus")
        return fault.result == VK_ERROR_DEVICE_LOST ? PT_ERROR_DEVICE_LOST : PT_OK;
    if (fault.function == "vkGetPipelineCacheData")
        return PT_OK;
    switch (fault.result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_MEMORY_MAP_FAILED:
        return PT_ERROR_OUT_OF_HOST_MEMORY;
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_TOO_MANY_OBJECTS:
    case VK_ERROR_FRAGMENTATION:
    case VK_ERROR_FRAGMENTED_POOL:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
        return PT_ERROR_OUT_OF_DEVICE_MEMORY;
    case VK_ERROR_DEVICE_LOST:
    case VK_TIMEOUT:
        return PT_ERROR_DEVICE_LOST;
    case VK_ERROR_INVALID_SHADER_NV:
        return PT_ERROR_SHADER;
    case VK_ERROR_INITIALIZATION_FAILED:
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        return PT_ERROR_NO_DEVICE;
    case VK_ERROR_LAYER_NOT_PRESENT:
    case VK_ERROR_EXTENSION_NOT_PRESENT:
    case VK_ERROR_FEATURE_NOT_PRESENT:
        return fault.function == "vkCreateInstance" ? PT_ERROR_NO_DEVICE : PT_ERROR_UNSUPPORTED;
    default:
        return PT_ERROR_INTERNAL;
    }
}

struct Place {
    std::string step;
    std::size_t number;
    CallFault fault;
};

// Every call fails once with its function's first error. Other errors are injected only into the first call of each
// function and into all submissions.
void fail_every_call(const Setting &setting) {
    const Expected expected = undisturbed();
    std::vector<Place> places;
    std::size_t error = 0;
    std::size_t armed = 0;
    const auto arm = [&](const std::string &step, std::size_t number) {
        armed = number;
        fail_call(call_number(step, number), error);
    };
    const auto disarm = [&](const std::string &step, pt_result result, const std::string &message) {
        const CallFault fault = call_fault();
        fail_call(0, 0);
        if (fault.function.empty())
            return false;
        places.push_back({step, armed, fault});
        // A CPU has one type of memory. On other devices, memory of another type may serve.
        const bool another_memory =
            fault.function == "vkAllocateMemory" && fault.result == VK_ERROR_OUT_OF_DEVICE_MEMORY && result == PT_OK;
        if (step != "pt_destroy" && !another_memory) {
            EXPECT_EQ(pt_result_name(result), std::string(pt_result_name(expected_result(fault))))
                << step << ", place " << armed << ", " << fault.function << ": " << message;
            EXPECT_TRUE(result >= 0 || !message.empty());
        }
        return true;
    };
    sweep(setting, expected, {arm, disarm});
    std::set<std::string> seen;
    const std::vector<Place> found = places;
    EXPECT_GT(found.size(), 100U);
    for (const Place &place : found) {
        if (!seen.insert(place.fault.function).second && place.fault.function != "vkQueueSubmit")
            continue;
        for (error = 1; error < place.fault.error_count; ++error) {
            Steps left{place.step};
            Steps met;
            Life(setting, expected, {arm, disarm}, place.number, left, met).live();
            heal_devices();
            // A hung device keeps its objects. The number of polls varies, so this run may end before the failing call.
            const CallFault &fault = places.back().fault;
            const bool hangs = !met.empty() && fault.function == "vkQueueSubmit" && fault.result == VK_TIMEOUT;
            EXPECT_EQ(live_objects().contains("vkCreateDevice"), hangs);
            for (const auto &[maker, count] : live_objects())
                EXPECT_TRUE(hangs) << place.step << ", " << place.fault.function << ": " << count << " of " << maker;
            forget_objects();
        }
    }
}

TEST(VulkanCallTest, EveryCallMayFail) {
    fail_every_call({.gpu = false, .device_count = 1, .submit_milliseconds = 1});
}

TEST(VulkanCallTest, EveryCallMayFailOnTwoGpus) {
    fail_every_call({.gpu = true, .device_count = 2, .submit_milliseconds = 8});
}

} // namespace
