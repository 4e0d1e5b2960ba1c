#include "cli/merge/merge_command.h"

#include "cli/base/common_options.h"
#include "cli/scene/scene_options.h"

namespace cli {

const char *const merge_help =
    "Samples are added exactly: the picture has the bits of one that was rendered whole, on the same model of device "
    "with\n"
    "the same driver, in whatever order the films are named. Needs no device. A film of another picture, one that is\n"
    "damaged and one with samples that another has already are refused, with the difference, and nothing is written.\n";

void add_merge_options(CLI::App &command, MergeOptions &options) {
    command.add_option("PART", options.parts, "Films of one picture (pt render --film or --checkpoint), in any order")
        ->required()
        ->type_name("PART");
    add_output_options(command, options.output);
    add_number(command, "--first-sample", natural_number, options.first_sample,
               "First of the samples that there should be (default: the first there is)")
        ->group("Samples");
    add_number(command, "--spp", positive_number, options.sample_count,
               "How many there should be from there on; those missing are told, with exit code 7 (default: up to the "
               "last there is)")
        ->group("Samples");
    add_scene_options(command, options.display, false);
    add_png_bits(command, options.output.png_bits);
    add_quiet(command, options.output.quiet)->group("Messages");
}

} // namespace cli
