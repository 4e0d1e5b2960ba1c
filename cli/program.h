#pragma once

namespace cli {

// Unknown names run `pt-NAME`, like in git. Throws Failure.
int run_program(int argument_count, char **arguments);

} // namespace cli
