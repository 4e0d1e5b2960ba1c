#include "lib/api/context.h"

#include "lib/base/rules.h"
#include "lib/base/struct_size.h"

namespace pt {

thread_local LastError thread_last_error;

CreateSettings validated_create(const pt_create_info &info) {
    constexpr std::uint32_t known_flags = PT_CREATE_VALIDATION | PT_CREATE_NO_SCENE_KERNELS;
    constexpr std::uint32_t default_submit_milliseconds = 50;
    Violations violations;
    const Subject create(violations, "create");
    create.require((info.flags & ~known_flags) == 0, "flags", info.flags,
                   "must be a combination of PT_CREATE_* of pt.h");
    create.require(info.submit_milliseconds <= 1000, "submit_milliseconds", info.submit_milliseconds,
                   "must be <= 1000");
    create.require(info.reserved == 0, "reserved", info.reserved, "must be 0");
    create.require(!info.vulkan || (info.flags & PT_CREATE_VALIDATION) == 0, "flags", info.flags,
                   "must not have PT_CREATE_VALIDATION with vulkan, whose instance has its own layers");
    if (info.vulkan && info.device)
        create.refuse("device", std::string("\"") + info.device + '"', "must be NULL with vulkan, which has one");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    CreateSettings settings;
    settings.validation = (info.flags & PT_CREATE_VALIDATION) != 0;
    settings.scene_kernels = (info.flags & PT_CREATE_NO_SCENE_KERNELS) == 0;
    settings.kernel_store = {info.load_kernels, info.store_kernels, info.kernels_user};
    settings.device = info.device ? info.device : "";
    settings.shader_directory = info.shader_dir ? info.shader_dir : "";
    settings.log = {info.log, info.log_user};
    settings.submit_milliseconds =
        info.submit_milliseconds == 0 ? default_submit_milliseconds : info.submit_milliseconds;
    if (info.vulkan)
        settings.vulkan = vulkan::validated_vulkan(copy_in(info.vulkan, "vulkan"));
    return settings;
}

} // namespace pt
