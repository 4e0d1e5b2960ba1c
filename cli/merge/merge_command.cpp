#include "cli/merge/merge_command.h"

#include "cli/base/json_text.h"
#include "cli/base/message.h"
#include "cli/base/output_file.h"
#include "cli/film/film_file.h"
#include "cli/film/film_handle.h"
#include "cli/image/image_file.h"
#include "cli/merge/merge_report.h"
#include "cli/render/render_output.h"

#include <memory>

namespace cli {
namespace {

void check(const MergeOptions &options) {
    const OutputOptions &output = options.output;
    if (output.images.empty() && output.film.empty() && output.standard_error.empty() && output.stats.empty())
        throw Failure(ExitCode::usage, "-o, --film, --standard-error or --stats is missing: there is nothing to write");
    std::vector<NamedFile> parts;
    for (const std::string &part : options.parts)
        parts.push_back({"the part", part});
    check_names(output, parts);
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

// Whether all files could be written.
bool write_outputs(const FilmHandle &film, const MergeOptions &options, MergeReport &report) {
    const OutputOptions &output = options.output;
    const std::vector<float> radiance = film.read_image(PT_QUANTITY_RADIANCE);
    const std::vector<float> standard_error =
        output.standard_error.empty() ? std::vector<float>() : film.read_image(PT_QUANTITY_STANDARD_ERROR);
    const Display display = display_of(options.display);
    if (needs_tone_map(output))
        report.picture.tone_map = display.tone_map(radiance);
    report.picture.automatic_exposure = report.picture.tone_map && !display.exposure;
    ImageWriter writer;
    const std::size_t written = write_images(writer, output, report.picture, {radiance, standard_error, {}}).size();
    const bool has_film = output.film.empty() || write_film([&] { return film.bytes(); }, output.film);
    write_report_file(output.stats, json_text(stats_json(report)));
    return has_film && written == output_count(output);
}

} // namespace

int run_merge(const MergeOptions &options) {
    check(options);
    const std::unique_ptr<FilmHandle> film = sum_of(options.parts);
    MergeReport report = merge_report(*film, options);
    check_files(options.output, report.picture.window);
    if (!write_outputs(*film, options, report))
        return static_cast<int>(ExitCode::file);
    if (!options.output.quiet) {
        print_for_people(summary_text(report) + "\n" + automatic_exposure_line(report.picture) +
                             error_text(report.picture) + "\n",
                         options.output.takes_standard_output());
        print_message(missing_text(report));
    }
    const bool lacks = options.sample_count && !report.missing.empty();
    return static_cast<int>(lacks ? ExitCode::target_missed : ExitCode::done);
}

} // namespace cli
