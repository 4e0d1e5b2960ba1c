#pragma once

#include "lib/base/error.h"
#include "lib/vulkan/api.h"

#include <string_view>
#include <utility>

namespace pt::vulkan {

pt_result result_of(vk::Result result);

[[noreturn]] void throw_translated(const vk::SystemError &error, std::string_view what_was_being_done);

template <typename Function>
decltype(auto) translated(std::string_view what_was_being_done, Function &&function) {
    try {
        return std::forward<Function>(function)();
    } catch (const vk::SystemError &error) {
        throw_translated(error, what_was_being_done);
    }
}

} // namespace pt::vulkan
