#include "cli/compare/compare_command.h"

#include "cli/base/common_options.h"

namespace cli {

const char *const compare_help =
    "For values x of the image and r of the reference, mse is the mean of (x-r)^2 over pixels and channels, "
    "relative_mse\n"
    "that of (x-r)^2/(r^2+0.01), and maximum the largest |x-r|. Both files hold radiance, or both what displays take,\n"
    "from 0 to 1. Pixels that are not finite in either image are left out and counted; any limit is exceeded then.\n\n"
    "The picture of --difference shows the root of each pixel's relative_mse, from 0 (dark) to the largest (bright) "
    "by\n"
    "the color map viridis; pixels that are not finite are white.\n";

void add_compare_options(CLI::App &command, CompareOptions &options) {
    constexpr ValueRule limit{.least = 0.0, .largest = 1e18};
    const std::string group = "Limits";
    add_text(command, "IMAGE", options.image, "IMAGE", "Image (.exr, .png, .jpg)")->required();
    add_text(command, "REFERENCE", options.reference, "REFERENCE",
             "What it is compared with, of the same size and kind")
        ->required();
    add_text(command, "--layer", options.layer, "NAME",
             "Compare this layer of both files (default: the channels R, G and B)");
    add_text(command, "--difference", options.difference, "PNG", "Write a picture of where they differ (.png)");
    add_number(command, "--max-mse", limit, options.mse, "Exit with 8 if mse is above X")->group(group);
    add_number(command, "--max-relative-mse", limit, options.relative_mse, "Exit with 8 if relative_mse is above X")
        ->group(group);
    add_number(command, "--max-difference", limit, options.maximum, "Exit with 8 if maximum is above X")->group(group);
    add_text(command, "--json", options.json, "JSON", "Write the figures as JSON; - is standard output");
    add_quiet(command, options.quiet);
}

} // namespace cli
