#include "cli/film/merge_command.h"

#include "cli/base/atomic_file.h"
#include "cli/base/distinct_files.h"
#include "cli/base/exit_code.h"
#include "cli/base/json_text.h"
#include "cli/base/message.h"
#include "cli/base/report_file.h"
#include "cli/film/film_file.h"
#include "cli/film/film_handle.h"
#include "cli/film/merge_report.h"
#include "cli/image/image_file.h"
#include "cli/render/render_output.h"

#include <memory>

namespace cli {
namespace {

void check(const MergeOptions &options) {
    const RenderOptions &output = options.output;
    if (output.outputs.empty() && output.film.empty() && output.standard_error.empty() && output.stats.empty())
        throw Failure(ExitCode::usage, "-o, --film, --standard-error or --stats is missing: there is nothing to write");
    std::vector<NamedFile> parts;
    for (const std::string &part : options.parts)
        parts.push_back({"the part", part});
    check_merged_names(output, parts);
}

// All parts are looked at, so that all that is wrong is told at once.
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

std::optional<ToneMap> tone_map_of(const RenderOptions &options, std::span<const float> radiance) {
    if (!needs_tone_map(options))
        return std::nullopt;
    const DisplayOptions &display = options.display;
    const std::optional<double> stops = display.exposure.value_or(Exposure{}).stops;
    return ToneMap{stops ? *stops : automatic_exposure(radiance), display.tone_curve.value_or(ToneCurve::none),
                   display.gamma};
}

// Whether all files could be written.
bool write_outputs(const FilmHandle &film, const RenderOptions &options, MergeReport &report) {
    const std::vector<float> radiance = film.read_image(PT_QUANTITY_RADIANCE);
    const std::vector<float> standard_error =
        options.standard_error.empty() ? std::vector<float>() : film.read_image(PT_QUANTITY_STANDARD_ERROR);
    report.picture.tone_map = tone_map_of(options, radiance);
    report.picture.automatic_exposure = report.picture.tone_map && !options.display.exposure.value_or(Exposure{}).stops;
    ImageWriter writer;
    const std::size_t written = write_images(writer, options, report.picture, {radiance, standard_error, {}}).size();
    const bool has_film = options.film.empty() || write_film([&] { return film.bytes(); }, options.film);
    write_report_file(options.stats, json_text(stats_json(report)));
    return has_film && written == output_count(options);
}

void print_summary(const RenderOptions &options, const MergeReport &report) {
    const std::string exposure = report.picture.automatic_exposure ? exposure_text(report.picture) + "\n" : "";
    print_for_people(summary_text(report) + "\n" + exposure + error_text(report.picture) + "\n",
                     takes_standard_output(options));
}

} // namespace

int run_merge(const MergeOptions &options) {
    check(options);
    const std::unique_ptr<FilmHandle> film = sum_of(options.parts);
    MergeReport report = merge_report(*film, options);
    check_files(options.output, report.picture.window);
    if (!write_outputs(*film, options.output, report))
        return static_cast<int>(ExitCode::file);
    if (!options.output.quiet) {
        print_summary(options.output, report);
        print_message(missing_text(report));
    }
    const bool lacks = options.sample_count && !report.missing.empty();
    return static_cast<int>(lacks ? ExitCode::target_missed : ExitCode::done);
}

} // namespace cli
