#include "tests/support/shared_context.h"

#include "lib/api/context.h"

#include <memory>

pt_result create_shared(uint32_t devices_of_each, const pt_create_info &info, pt_context **context, bool like_gpus,
                        std::optional<uint32_t> adaptive_from) {
    return pt::guard(pt::thread_last_error, [&] {
        pt::CreateSettings settings = pt::validated_create(info);
        settings.devices_of_each = devices_of_each;
        settings.like_gpus = like_gpus;
        settings.adaptive_from = adaptive_from;
        *context = std::make_unique<pt_context>(settings).release();
    });
}

pt_result create_with_tree_from(uint32_t spheres, const pt_create_info *info, pt_context **context) {
    return pt::guard(pt::thread_last_error, [&] {
        pt::CreateSettings settings = pt::validated_create(*info);
        settings.tree_from = spheres;
        *context = std::make_unique<pt_context>(settings).release();
    });
}
