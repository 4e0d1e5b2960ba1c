// Translation of Vulkan's errors into the library's. Used all over lib/vulkan/.
#pragma once

#include "lib/base/error.h"
#include "lib/vulkan/api.h"

#include <string>
#include <utility>

namespace pt::vulkan {

// The pt_result that a VkResult stands for; others are PT_ERROR_INTERNAL.
pt_result result_of(vk::Result result);

// Runs a function; what Vulkan throws becomes a pt::Error that says what was being done.
template <typename Function>
decltype(auto) translated(const std::string &what_was_being_done, Function &&function) {
    try {
        return std::forward<Function>(function)();
    } catch (const vk::SystemError &error) {
        const auto result = static_cast<vk::Result>(error.code().value());
        throw Error(result_of(result), what_was_being_done + ": " + vk::to_string(result));
    }
}

} // namespace pt::vulkan
