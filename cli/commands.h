#pragma once

#include "cli/base/options.h"

namespace cli {

void add_render_command(CLI::App &program, Run &chosen);
void add_tonemap_command(CLI::App &program, Run &chosen);
void add_compare_command(CLI::App &program, Run &chosen);
void add_merge_command(CLI::App &program, Run &chosen);
void add_denoise_command(CLI::App &program, Run &chosen);
void add_selftest_command(CLI::App &program, Run &chosen);
void add_course_command(CLI::App &program, Run &chosen);
void add_schema_command(CLI::App &program, Run &chosen);
void add_devices_command(CLI::App &program, Run &chosen);

} // namespace cli
