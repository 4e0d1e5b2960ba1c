#include "cli/tonemap/tonemap_command.h"

#include <CLI/CLI.hpp>

namespace cli {

const char *const tonemap_help = "IN is an OpenEXR file, of `pt render` or another program, with the channels R, G and "
                                 "B; of one that was rendered,\n"
                                 "OUT has the pixels that `pt render` would have written with the same options. "
                                 "Negative numbers count as 0; one that\n"
                                 "is not finite is an error. --exposure auto is explained in `pt render --help`.\n";

void add_tonemap_options(CLI::App &command, TonemapOptions &options) {
    command.add_option("IN", options.input, "Linear radiance (.exr)")->required()->type_name("IN");
    command.add_option("OUT", options.output, "Image to write (.png, .jpg); - is standard output")
        ->required()
        ->type_name("OUT");
    add_format(command, options.format, picture_format_names);
    add_display_options(command, options.display, "");
    command.add_flag("-q,--quiet", options.quiet, "Print errors only");
}

} // namespace cli
