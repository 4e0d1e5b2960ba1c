#include "cli/tonemap/tonemap_command.h"

#include "cli/base/common_options.h"
#include "cli/render/output_options.h"
#include "cli/scene/scene_options.h"

namespace cli {

const char *const tonemap_help = "IN is an OpenEXR file, of `pt render` or another program, with the channels R, G and "
                                 "B; of one that was rendered,\n"
                                 "OUT has the pixels that `pt render` would have written with the same options. "
                                 "Negative numbers count as 0; one that\n"
                                 "is not finite is an error. --exposure auto is explained in `pt render --help`.\n";

void add_tonemap_options(CLI::App &command, TonemapOptions &options) {
    add_text(command, "IN", options.input, "IN", "Linear radiance (.exr)")->required();
    add_text(command, "OUT", options.output, "OUT", "Image to write (.png, .jpg); - is standard output")->required();
    add_format(command, options.format, picture_format_names);
    add_scene_options(command, options.display, false);
    add_png_bits(command, options.png_bits);
    add_quiet(command, options.quiet);
}

} // namespace cli
