#pragma once

#include <pt/pt.h>

#include <cstdint>
#include <optional>

// Uses each device devices_of_each times. `like_gpus` uses CPUs as if they were GPUs.
pt_result create_shared(uint32_t devices_of_each, const pt_create_info &info, pt_context **context,
                        bool like_gpus = false, std::optional<uint32_t> adaptive_from = std::nullopt);

inline auto shared_by(uint32_t devices_of_each, bool like_gpus, std::optional<uint32_t> adaptive_from = std::nullopt) {
    return [=](const pt_create_info *info, pt_context **context) {
        return create_shared(devices_of_each, *info, context, like_gpus, adaptive_from);
    };
}

pt_result create_with_tree_from(uint32_t spheres, const pt_create_info *info, pt_context **context);

inline pt_result create_with_tree(const pt_create_info *info, pt_context **context) {
    return create_with_tree_from(1, info, context);
}

inline pt_result create_without_tree(const pt_create_info *info, pt_context **context) {
    return create_with_tree_from(UINT32_MAX, info, context);
}
