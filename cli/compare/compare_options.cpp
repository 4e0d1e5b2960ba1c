#include "cli/compare/compare_command.h"

#include "cli/base/common_options.h"

namespace cli {
namespace {

void add_limit(CLI::App &command, const std::string &name, std::optional<double> &limit, const std::string &figure) {
    constexpr double largest = 1e18;
    add_real_number(command, name, limit, 0.0, largest, "Exit with 8 if " + figure + " is above X")
        ->type_name("X")
        ->group("Limits");
}

} // namespace

const char *const compare_help =
    "For values x of the image and r of the reference, mse is the mean of (x-r)^2 over pixels and channels, "
    "relative_mse\n"
    "that of (x-r)^2/(r^2+0.01), and maximum the largest |x-r|. Both files hold radiance, or both what displays take,\n"
    "from 0 to 1. Pixels that are not finite in either image are left out and counted; any limit is exceeded then.\n\n"
    "The picture of --difference shows the root of each pixel's relative_mse, from 0 (dark) to the largest (bright) "
    "by\n"
    "the colour map viridis; pixels that are not finite are white.\n";

void add_compare_options(CLI::App &command, CompareOptions &options) {
    command.add_option("IMAGE", options.image, "Image (.exr, .png, .jpg)")->required()->type_name("IMAGE");
    command.add_option("REFERENCE", options.reference, "What it is compared with, of the same size and kind")
        ->required()
        ->type_name("REFERENCE");
    command.add_option("--layer", options.layer, "Compare this layer of both files (default: the channels R, G and B)")
        ->type_name("NAME");
    command.add_option("--difference", options.difference, "Write a picture of where they differ (.png)")
        ->type_name("PNG");
    add_limit(command, "--max-mse", options.mse, "mse");
    add_limit(command, "--max-relative-mse", options.relative_mse, "relative_mse");
    add_limit(command, "--max-difference", options.maximum, "maximum");
    command.add_option("--json", options.json, "Write the figures as JSON; - is standard output")->type_name("JSON");
    command.add_flag("-q,--quiet", options.quiet, "Print errors only");
}

} // namespace cli
