#include "cli/base/devices.h"
#include "cli/base/file.h"
#include "cli/base/json.h"
#include "cli/base/options.h"
#include "cli/base/text.h"
#include "cli/commands.h"
#include "cli/film/film.h"
#include "cli/image/image_file.h"
#include "cli/picture/picture_output.h"
#include "cli/picture/render_report.h"
#include "lib/scene_file/enumerations.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace cli {
namespace {

using Ranges = std::vector<pt_sample_range>;

struct MergeOptions {
    std::vector<std::string> parts;

    // Expected samples. The default is the whole range from the films' first to their last sample.
    std::optional<std::uint32_t> first_sample;
    std::optional<std::uint32_t> sample_count;

    OutputOptions output;
    std::vector<SceneOverride> display;
};

struct MergeReport {
    RenderReport picture;
    pt_film_info info;
    std::size_t part_count;
    Ranges samples; // samples that all pixels have
    Ranges missing; // samples that some pixel lacks
};

void check(const MergeOptions &options) {
    const OutputOptions &output = options.output;
    refuse_if(output.images.empty() && output.film.empty() && output.stats.empty(),
              "-o, --film or --stats is missing: there is nothing to write");
    std::vector<NamedFile> parts;
    for (const std::string &part : options.parts)
        parts.push_back({"the part", part});
    check_names(output, parts);
}

// Reads all parts before it fails, to report all faults.
std::unique_ptr<FilmHandle> sum_of(const std::vector<std::string> &parts) {
    std::unique_ptr<FilmHandle> sum;
    std::optional<ExitCode> failed;
    for (const std::string &part : parts) {
        try {
            const std::vector<std::byte> bytes = read_film_file(part);
            if (sum)
                sum->merge(part, bytes);
            else
                sum = std::make_unique<FilmHandle>(part, bytes);
        } catch (const Failure &failure) {
            failed = failed.value_or(failure.code());
            print_message(failure.what());
        }
    }
    if (failed)
        throw Failure(*failed, "nothing was written");
    return sum;
}

Ranges united(Ranges ranges) {
    std::sort(ranges.begin(), ranges.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    Ranges all;
    for (const pt_sample_range &range : ranges)
        if (!all.empty() && range.first <= all.back().end)
            all.back().end = std::max(all.back().end, range.end);
        else
            all.push_back(range);
    return all;
}

Ranges missing_in_any(const pt_sample_range &wanted, const std::vector<Ranges> &tiles) {
    Ranges missing;
    for (const Ranges &ranges : tiles) {
        const Ranges lacked = missing_of(wanted, ranges);
        missing.insert(missing.end(), lacked.begin(), lacked.end());
    }
    return united(std::move(missing));
}

pt_sample_range wanted_range(const MergeOptions &options, const pt_sample_range &hull) {
    const std::uint64_t first = options.first_sample.value_or(static_cast<std::uint32_t>(hull.first));
    return {first, options.sample_count ? first + *options.sample_count : std::max(first, hull.end)};
}

nlohmann::ordered_json json_of(const Ranges &ranges) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const pt_sample_range &range : ranges)
        list.push_back({range.first, range.end});
    return list;
}

MergeReport merge_report(const FilmHandle &film, const MergeOptions &options) {
    std::vector<Ranges> tiles;
    for (std::uint32_t i = 0; i < film.info().tile_count; ++i)
        tiles.push_back(film.ranges(i));
    const pt_sample_range hull = film.hull();
    MergeReport report{film_report(film), film.info(), options.parts.size(), {}, {}};
    report.samples = missing_of(hull, missing_in_any(hull, tiles));
    report.missing = missing_in_any(wanted_range(options, hull), tiles);
    return report;
}

nlohmann::ordered_json stats_json(const MergeReport &report) {
    const pt_film_info &info = report.info;
    nlohmann::ordered_json stats{{"version", version_text()},
                                 {"films", report.part_count},
                                 {"width", info.width},
                                 {"height", info.height},
                                 {"rectangle", {info.x, info.y, info.columns, info.rows}},
                                 {"tiles", info.tile_count},
                                 {"spp", report.picture.stats.sample_count},
                                 {"samples", json_of(report.samples)},
                                 {"missing", json_of(report.missing)},
                                 {"seed", info.seed},
                                 {"max_path_length", info.max_path_length},
                                 {"sampler", pt::samplers.name(info.sampler)},
                                 {"estimator", pt::estimators.name(info.estimator)},
                                 {"device", info.device}};
    stats.update(error_json(report.picture.error));
    stats.update(nlohmann::ordered_json{{"rejected_samples", report.picture.stats.rejected_samples},
                                        {"tone_map", tone_map_json(report.picture.tone_map)}});
    return stats;
}

std::string summary_text(const MergeReport &report) {
    return concat(counted(report.part_count, "film"), " of ", report.info.columns, "x", report.info.rows,
                  " pixels: ", report.picture.stats.sample_count, " spp, samples ", ranges_text(report.samples));
}

std::string missing_text(const MergeReport &report) {
    return report.missing.empty() ? ""
                                  : concat(counted(sample_count_of(report.missing), "sample"),
                                           " per pixel missing: ", ranges_text(report.missing));
}

void check_coverage(const FilmHandle &film, const OutputOptions &output) {
    refuse_if(output.alpha && (film.info().flags & PT_RENDER_COVERAGE) == 0,
              "--alpha: the films have no alpha; render them with `pt render --alpha`");
}

bool write_outputs(const FilmHandle &film, const MergeOptions &options, MergeReport &report) {
    const OutputOptions &output = options.output;
    RenderedImage image{report.picture.window.part, film.read_image(PT_QUANTITY_RADIANCE), {}};
    std::vector<std::uint32_t> layers = output.layers;
    if (output.alpha)
        layers.push_back(PT_QUANTITY_COVERAGE);
    for (const std::uint32_t quantity : layers)
        image.layers.emplace_back(quantity, image.part.pixel_count()).take(film.read_image(quantity), 0);
    if (needs_tone_map(output))
        report.picture.tone_map = tone_map_for(display_of(options.display), image.radiance);
    ImageWriter writer;
    const std::size_t written = write_images(writer, output, report.picture, image).size();
    const bool has_film = output.film.empty() || write_film(output.film, film.bytes());
    write_report_file(output.stats, json_text(stats_json(report)));
    return has_film && written == output.images.size();
}

int run_merge(const MergeOptions &options) {
    check(options);
    const std::unique_ptr<FilmHandle> film = sum_of(options.parts);
    check_coverage(*film, options.output);
    MergeReport report = merge_report(*film, options);
    check_files(options.output, report.picture.window);
    if (!write_outputs(*film, options, report))
        return static_cast<int>(ExitCode::file);
    if (!options.output.quiet) {
        print_for_people(summary_text(report) + "\n" + automatic_exposure_line(report.picture.tone_map) +
                             error_text(report.picture) + "\n",
                         options.output.takes_standard_output());
        print_message(missing_text(report));
    }
    const bool lacks = options.sample_count && !report.missing.empty();
    return static_cast<int>(lacks ? ExitCode::target_missed : ExitCode::done);
}

constexpr const char *merge_help =
    "Samples are added exactly. In any order of films the picture has the bits of one rendering on the same\n"
    "model of device and driver. No device is needed. A film that is damaged, belongs to another picture or\n"
    "repeats samples is refused, with the difference, and nothing is written.\n";

} // namespace

void add_merge_command(CLI::App &program, Run &chosen) {
    const auto [command, options] =
        add_command(program, chosen, "merge", "Add films of one picture", merge_help, &run_merge);
    command.add_option("PART", options.parts, "Films of one picture (pt render --film or --checkpoint), in any order")
        ->required()
        ->type_name("PART");
    constexpr std::size_t film_layers = 3; // films have no first hits
    add_output_options(command, options.output, file_layers.names().first(film_layers));
    command.option_defaults()->group("Samples");
    add_number<std::uint32_t>(command, "--first-sample", natural_number, options.first_sample,
                              "First expected sample (default: the first of the films)");
    add_number<std::uint32_t>(
        command, "--spp", positive_number, options.sample_count,
        "Expected number of samples; missing ones are reported, with exit code 7 (default: up to the last of the "
        "films)");
    add_scene_options(command, options.display, false);
    command.option_defaults()->group("Messages");
    add_quiet(command, options.output.quiet);
}

} // namespace cli
