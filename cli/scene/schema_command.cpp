#include "cli/base/exit_code.h"
#include "cli/base/options.h"
#include "cli/commands.h"
#include "lib/scene_file/scene_schema.h"

#include <iostream>

namespace cli {

void add_schema_command(CLI::App &program, Run &chosen) {
    add_command(program, chosen, "schema", "Print the JSON Schema of scene files", "", [] {
        std::cout << pt::scene_schema();
        return static_cast<int>(ExitCode::done);
    });
}

} // namespace cli
