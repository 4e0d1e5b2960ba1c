// Translation of Vulkan's errors into the library's. Used all over lib/vulkan/.
#pragma once

#include "lib/base/error.h"
#include "lib/vulkan/api.h"

#include <string_view>
#include <utility>

namespace pt::vulkan {

// The pt_result of a VkResult; PT_ERROR_INTERNAL for those not in the table.
pt_result result_of(vk::Result result);

// Throws a pt::Error for what Vulkan threw; its message says what was being done.
[[noreturn]] void throw_translated(const vk::SystemError &error, std::string_view what_was_being_done);

// Runs a function, and translates what Vulkan throws.
template <typename Function>
decltype(auto) translated(std::string_view what_was_being_done, Function &&function) {
    try {
        return std::forward<Function>(function)();
    } catch (const vk::SystemError &error) {
        throw_translated(error, what_was_being_done);
    }
}

} // namespace pt::vulkan
