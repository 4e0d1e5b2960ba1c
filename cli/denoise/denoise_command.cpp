#include "cli/base/devices.h"
#include "cli/base/file.h"
#include "cli/base/json.h"
#include "cli/base/options.h"
#include "cli/base/text.h"
#include "cli/commands.h"
#include "cli/film/film.h"
#include "cli/image/image_file.h"
#include "cli/picture/denoise.h"
#include "cli/picture/picture_output.h"
#include "lib/platform/module.h"

#include <nlohmann/json.hpp>

namespace cli {
namespace {

struct DenoiseOptions {
    std::string first;
    std::string second;
    std::string guides;
    std::string library = platform::denoiser_file;
    OutputOptions output;
    std::vector<SceneOverride> display;
};

void check(const DenoiseOptions &options) {
    refuse_if(options.output.images.empty(), "-o is missing: there is nothing to write");
    check_names(options.output,
                {{"the film", options.first}, {"the film", options.second}, {"the guides", options.guides}});
    require_denoiser(options.library);
}

// Refuses unequal sample counts, because such a film has no stated error.
RenderReport even_report(const std::string &path, const FilmHandle &film) {
    RenderReport report = film_report(film);
    const pt_stats &stats = report.stats;
    refuse_if(stats.sample_count != stats.max_sample_count || stats.sample_count == 0,
              concat(path, ": has ", stats.sample_count, " to ", stats.max_sample_count,
                     " samples per pixel: must have the same number in all pixels; render it without --error"));
    return report;
}

RenderedImage image_of(const FilmHandle &film, const RenderReport &report) {
    RenderedImage image{report.window.part, film.read_image(PT_QUANTITY_RADIANCE)};
    image.stats = report.stats;
    return image;
}

RenderReport read_halves(const DenoiseOptions &options, Halves &halves) {
    FilmHandle first(options.first, read_film_file(options.first));
    const std::vector<std::byte> bytes = read_film_file(options.second);
    const FilmHandle second(options.second, bytes);
    const RenderReport report = even_report(options.first, first);
    const RenderReport other = even_report(options.second, second);
    refuse_if(report.render.seed == other.render.seed,
              concat(options.second, ": seed = ", other.render.seed,
                     ": must differ from the other film's, because parts of one sequence depend on each other"));
    first.require_same_picture(options.second, bytes);
    refuse_if(report.window != other.window || report.stats.sample_count != other.stats.sample_count,
              concat(options.second, ": is ", window_text(other.window), " with ", other.stats.sample_count,
                     " samples per pixel, ", options.first, " is ", window_text(report.window), " with ",
                     report.stats.sample_count, ": both must be equal"));
    halves.first = image_of(first, report);
    halves.second = image_of(second, other);
    return report;
}

DecodedImage read_guides(const std::string &path, const ImageWindow &window) {
    DecodedImage guides = read_image(path);
    refuse_if(guides.window() != window, concat(path, ": is ", window_text(guides.window()), ": must be ",
                                                window_text(window), " like the films"));
    return guides;
}

nlohmann::ordered_json stats_json_of(const RenderReport &report, const RenderedImage &second) {
    nlohmann::ordered_json stats{{"version", version_text()},
                                 {"width", report.render.width},
                                 {"height", report.render.height},
                                 {"spp", report.stats.sample_count},
                                 {"max_path_length", report.render.max_path_length},
                                 {"denoised", true}};
    stats.update(error_json(second.error));
    stats.update(nlohmann::ordered_json{{"tone_map", tone_map_json(report.tone_map)}});
    return stats;
}

int run_denoise(const DenoiseOptions &options) {
    const OutputOptions &output = options.output;
    check(options);
    Halves halves;
    RenderReport report = read_halves(options, halves);
    check_files(output, report.window);
    const DecodedImage guides = read_guides(options.guides, report.window);
    halves.albedo = guides.layer("albedo");
    halves.normal = guides.layer("N");
    const RenderedImage image = denoised(options.library, std::move(halves));
    report.stats = image.stats;
    report.error = image.error;
    report.is_denoised = true;
    if (needs_tone_map(output))
        report.tone_map = tone_map_for(display_of(options.display), image.radiance);
    ImageWriter writer;
    const bool all_written = write_images(writer, output, report, image).size() == output.images.size();
    write_report_file(output.stats, json_text(stats_json_of(report, image)));
    if (!output.quiet)
        print_for_people(concat(window_text(report.window), ", ", report.stats.sample_count, " spp, denoised\n",
                                automatic_exposure_line(report.tone_map), error_text(report), "\n"),
                         output.takes_standard_output());
    return static_cast<int>(all_written ? ExitCode::done : ExitCode::file);
}

constexpr const char *denoise_help =
    "The films come from `pt render` (--film or --checkpoint) or `pt merge`. They must differ only in --seed,\n"
    "and be rendered without --error. Each film shows the filter's error on the other, so the error of the\n"
    "result is known, as with `pt render --denoise`. No device is needed.\n";

} // namespace

void add_denoise_command(CLI::App &program, Run &chosen) {
    const auto [command, options] =
        add_command(program, chosen, "denoise", "Denoise a picture kept as films", denoise_help, &run_denoise);
    add_text(command, "FIRST", options.first, "FIRST", "Film with half of the samples")->required();
    add_text(command, "SECOND", options.second, "SECOND", "Film of the same picture with another seed")->required();
    add_text(command, "GUIDES", options.guides, "GUIDES",
             "Image of the same picture with the layers albedo and normal (.exr)")
        ->required();
    add_image_outputs(command, options.output);
    add_text(command, "--denoise", options.library, "FILE", "Open Image Denoise 2")->capture_default_str();
    add_scene_options(command, options.display, false);
    command.option_defaults()->group("Messages");
    add_quiet(command, options.output.quiet);
}

} // namespace cli
