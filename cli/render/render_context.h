// What the options of `pt render` say about its context, and the messages of the validation layer.
#pragma once

#include "cli/base/message.h"
#include "cli/render/render_options.h"

#include <pt/pt.h>

#include <cstdint>
#include <string>

namespace cli {

// Messages of the validation layer. Each means a mistake in this program or its library.
struct ValidationLog {
    std::uint64_t count = 0;

    static void receive(void *user, std::int32_t level, const char *line) {
        if (level == PT_LOG_ERROR || level == PT_LOG_WARNING) {
            ++static_cast<ValidationLog *>(user)->count;
            print_message(std::string("validation: ") + line);
        }
    }
};

// Refers to both.
inline pt_create_info render_create_info(const RenderOptions &options, ValidationLog &log) {
    const auto text = [](const std::string &option) { return option.empty() ? nullptr : option.c_str(); };
    pt_create_info info{};
    info.struct_size = sizeof(pt_create_info);
    info.device = text(options.device);
    info.shader_dir = text(options.shader_dir);
    info.submit_milliseconds = options.submit_milliseconds;
    if (options.validation) {
        info.flags = PT_CREATE_VALIDATION;
        info.log = &ValidationLog::receive;
        info.log_user = &log;
    }
    return info;
}

} // namespace cli
