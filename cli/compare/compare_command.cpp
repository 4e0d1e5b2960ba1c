#include "cli/compare/compare_command.h"

#include "cli/base/atomic_file.h"
#include "cli/base/distinct_files.h"
#include "cli/base/exit_code.h"
#include "cli/base/json_text.h"
#include "cli/base/message.h"
#include "cli/base/output_file.h"
#include "cli/compare/compare_report.h"
#include "cli/compare/viridis.h"
#include "cli/image/image_file.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>
#include <vector>

namespace cli {
namespace {

void check_outputs(const CompareOptions &options) {
    if (!options.difference.empty() && image_format(options.difference) != ImageFormat::png)
        throw Failure(ExitCode::usage, "--difference " + options.difference + ": the name must end in .png");
    require_distinct_files({{"the image", options.image}, {"the reference", options.reference}},
                           {{"--difference", options.difference}, {"--json", options.json}});
    if (!options.difference.empty())
        AtomicFile::check_writable(options.difference);
    check_report_file(options.json);
}

std::string size_text(const DecodedImage &image) {
    const auto pair = [](auto a, const char *between, auto b) {
        return std::to_string(a) + between + std::to_string(b);
    };
    return pair(image.width, "x", image.height) + " at " + pair(image.x, ",", image.y) + " of " +
           pair(image.full_width, "x", image.full_height);
}

const char *kind_text(const DecodedImage &image) {
    return image.is_float ? "radiance" : "numbers for a display";
}

void require_comparable(const DecodedImage &image, const DecodedImage &reference) {
    if (size_text(image) != size_text(reference)) {
        throw Failure(ExitCode::usage, image.path + " is " + size_text(image) + ", " + reference.path + " is " +
                                           size_text(reference) + ": they must be equally large");
    }
    if (image.is_float != reference.is_float) {
        throw Failure(ExitCode::usage, image.path + " holds " + kind_text(image) + ", " + reference.path + " " +
                                           kind_text(reference) + ": they must be of one kind");
    }
}

// Dark is no difference, bright the largest, white what is not finite.
std::vector<std::uint8_t> difference_picture(std::span<const float> differences, float largest) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * differences.size());
    for (const float difference : differences) {
        const double share = largest > 0.0F ? difference / largest : 0.0;
        const auto color = std::isnan(difference) ? std::array<std::uint8_t, 3>{255, 255, 255} : viridis(share);
        bytes.insert(bytes.end(), color.begin(), color.end());
    }
    return bytes;
}

// Returns what the brightest color stands for.
float write_difference(const std::string &path, std::uint32_t width, const std::vector<float> &differences) {
    const float largest = std::accumulate(differences.begin(), differences.end(), 0.0F,
                                          [](float most, float each) { return std::fmax(most, each); });
    const auto height = static_cast<std::uint32_t>(differences.size() / width);
    ImageWriter().write_signal({path, ImageFormat::png}, whole_window(width, height),
                               difference_picture(differences, largest), {});
    return largest;
}

} // namespace

int run_compare(const CompareOptions &options) {
    check_outputs(options);
    const DecodedImage image = read_image(options.image);
    const DecodedImage reference = read_image(options.reference);
    require_comparable(image, reference);
    const std::vector<float> values = image.layer(options.layer);
    const std::vector<float> wanted = reference.layer(options.layer);

    const CompareReport report{options, image, compare_images(values, wanted)};
    std::string text = report.text();
    if (!options.difference.empty()) {
        const float largest = write_difference(options.difference, image.width, pixel_differences(values, wanted));
        text += "wrote " + options.difference + ": relative differences from 0 to " + std::to_string(largest) + "\n";
    }
    write_report_file(options.json, json_text(report.json()));
    if (!options.quiet)
        print_for_people(text, options.json == standard_stream);
    const std::vector<std::string> exceeded = report.exceeded();
    for (const std::string &line : exceeded)
        print_message(line);
    return static_cast<int>(exceeded.empty() ? ExitCode::done : ExitCode::images_differ);
}

} // namespace cli
