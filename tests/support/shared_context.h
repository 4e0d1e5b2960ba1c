#pragma once

#include "lib/api/context.h"

#include <cstdint>
#include <memory>
#include <optional>

// Uses each device devices_of_each times. `like_gpus` uses CPUs as if they were GPUs.
inline pt_result create_shared(uint32_t devices_of_each, const pt_create_info &info, pt_context **context,
                               bool like_gpus = false, std::optional<uint32_t> adaptive_from = std::nullopt) {
    return pt::guard(pt::thread_last_error, [&] {
        pt::CreateSettings settings = pt::validated_create(info);
        settings.devices_of_each = devices_of_each;
        settings.like_gpus = like_gpus;
        settings.adaptive_from = adaptive_from;
        *context = std::make_unique<pt_context>(settings).release();
    });
}

inline auto shared_by(uint32_t devices_of_each, bool like_gpus, std::optional<uint32_t> adaptive_from = std::nullopt) {
    return [=](const pt_create_info *info, pt_context **context) {
        return create_shared(devices_of_each, *info, context, like_gpus, adaptive_from);
    };
}

inline pt_result create_with_tree_from(uint32_t spheres, const pt_create_info *info, pt_context **context) {
    return pt::guard(pt::thread_last_error, [&] {
        pt::CreateSettings settings = pt::validated_create(*info);
        settings.tree_from = spheres;
        *context = std::make_unique<pt_context>(settings).release();
    });
}

inline pt_result create_with_tree(const pt_create_info *info, pt_context **context) {
    return create_with_tree_from(1, info, context);
}

inline pt_result create_without_tree(const pt_create_info *info, pt_context **context) {
    return create_with_tree_from(UINT32_MAX, info, context);
}
