#include "cli/film/merge_options.h"

#include "cli/base/common_options.h"

namespace cli {
namespace {

void add_file_options(CLI::App &command, MergeOptions &options) {
    const std::string group = "Output";
    command.add_option("PART", options.parts, "Films of one picture (pt render --film or --checkpoint), in any order")
        ->required()
        ->type_name("PART");
    command
        .add_option("-o,--output", options.output.outputs,
                    "Image to write, may be given again: .exr is linear 32-bit radiance; .png, .jpg are tone-mapped; "
                    "- is standard output")
        ->expected(1)
        ->take_all()
        ->type_name("IMAGE")
        ->group(group);
    add_format(command, options.output.format, image_format_names)->group(group);
    command
        .add_option("--standard-error", options.output.standard_error,
                    "Write the standard error of every pixel (.exr), estimated from two parts of its samples")
        ->type_name("EXR")
        ->group(group);
    command.add_option("--film", options.output.film, "Write the sum of the films (.ptfilm)")
        ->type_name("FILM")
        ->group(group);
    command
        .add_option("--stats", options.output.stats,
                    "Write what the films have as JSON; - is standard output, the summary then goes to stderr")
        ->type_name("JSON")
        ->group(group);
}

} // namespace

const char *const merge_help =
    "Samples are added exactly: the picture has the bits of one that was rendered whole, on the same model of device "
    "with\n"
    "the same driver, in whatever order the films are named. Needs no device. A film of another picture, one that is\n"
    "damaged and one with samples that another has already are refused, with the difference, and nothing is written.\n";

void add_merge_options(CLI::App &command, MergeOptions &options) {
    add_file_options(command, options);
    add_whole_number<std::uint32_t>(command, "--first-sample", options.first_sample, 0,
                                    "First of the samples that there should be (default: the first there is)")
        ->group("Samples");
    add_whole_number<std::uint32_t>(command, "--spp", options.sample_count, 1,
                                    "How many there should be from there on; those missing are told, with exit code 7 "
                                    "(default: up to the last there is)")
        ->group("Samples");
    add_display_options(command, options.output.display, "");
    command.add_flag("-q,--quiet", options.output.quiet, "Print errors only")->group("Messages");
}

} // namespace cli
