// `pt compare`: differences of two images.
#include "cli/base/exit_code.h"
#include "cli/base/file.h"
#include "cli/base/json.h"
#include "cli/base/options.h"
#include "cli/base/text.h"
#include "cli/commands.h"
#include "cli/image/image_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cli {
namespace {

struct ImageDifference {
    // Means over channels of pixels that are finite in both images.
    double mse;          // of (x - r)^2, for values x and the reference's r
    double relative_mse; // of (x - r)^2 / (r^2 + 0.01)

    double maximum;
    std::size_t maximum_value; // index into the values

    std::size_t not_finite; // pixels with a channel that is not finite in either image
};

using Values = std::span<const float>;

constexpr double relative_offset = 0.01;

bool is_finite(Values pixel) {
    return std::all_of(pixel.begin(), pixel.end(), [](float value) { return std::isfinite(value); });
}

// Both have equally many values.
ImageDifference compare_images(Values image, Values reference) {
    ImageDifference total{};
    for (std::size_t i = 0; i < image.size(); i += 3) {
        if (!is_finite(image.subspan(i, 3)) || !is_finite(reference.subspan(i, 3))) {
            ++total.not_finite;
            continue;
        }
        for (std::size_t value = i; value < i + 3; ++value) {
            const double expected = reference[value];
            const double difference = std::abs(image[value] - expected);
            total.mse += difference * difference;
            total.relative_mse += difference * difference / (expected * expected + relative_offset);
            if (difference > total.maximum) {
                total.maximum = difference;
                total.maximum_value = value;
            }
        }
    }
    const std::size_t value_count = image.size() - 3 * total.not_finite;
    if (value_count > 0) {
        total.mse /= static_cast<double>(value_count);
        total.relative_mse /= static_cast<double>(value_count);
    }
    return total;
}

struct CompareOptions {
    std::string image;
    std::string reference;
    std::string layer; // empty: the main one
    std::string json;
    bool quiet = false;

    std::optional<double> mse;
    std::optional<double> relative_mse;
    std::optional<double> maximum;
};

void check_outputs(const CompareOptions &options) {
    require_distinct_files({{"the image", options.image}, {"the reference", options.reference}},
                           {{"--json", options.json}});
    check_report_file(options.json);
}

std::string size_text(const DecodedImage &image) {
    return concat(image.width, "x", image.height, " at ", image.x, ",", image.y, " of ", image.full_width, "x",
                  image.full_height);
}

const char *kind_text(const DecodedImage &image) {
    return image.is_float ? "radiance" : "numbers for a display";
}

void require_comparable(const DecodedImage &image, const DecodedImage &reference) {
    refuse_if(size_text(image) != size_text(reference),
              concat(image.path, " is ", size_text(image), ", ", reference.path, " is ", size_text(reference),
                     ": they must be equally large"));
    refuse_if(image.is_float != reference.is_float,
              concat(image.path, " holds ", kind_text(image), ", ", reference.path, " ", kind_text(reference),
                     ": they must be of one kind"));
}

struct CompareReport {
    const CompareOptions &options;
    const DecodedImage &image;
    ImageDifference difference;

    std::int64_t x() const { return image.x + static_cast<std::int64_t>(difference.maximum_value / 3 % image.width); }
    std::int64_t y() const { return image.y + static_cast<std::int64_t>(difference.maximum_value / 3 / image.width); }
    std::string channel() const { return {"RGB"[difference.maximum_value % 3]}; }

    std::vector<std::string> exceeded() const {
        std::vector<std::string> lines;
        const auto check_limit = [&](const char *name, double figure, std::optional<double> limit) {
            if (limit && !(figure <= *limit))
                lines.push_back(formatted("%s is %.6g, above the limit of %.6g", name, figure, *limit));
        };
        check_limit("mse", difference.mse, options.mse);
        check_limit("relative_mse", difference.relative_mse, options.relative_mse);
        check_limit("maximum", difference.maximum, options.maximum);
        if (difference.not_finite > 0 && (options.mse || options.relative_mse || options.maximum))
            lines.push_back(concat(difference.not_finite, " pixels are not finite"));
        return lines;
    }

    nlohmann::ordered_json json() const {
        return {{"image", options.image},
                {"reference", options.reference},
                {"layer", options.layer},
                {"width", image.width},
                {"height", image.height},
                {"mse", difference.mse},
                {"relative_mse", difference.relative_mse},
                {"maximum", difference.maximum},
                {"maximum_at", {{"x", x()}, {"y", y()}, {"channel", channel()}}},
                {"not_finite", difference.not_finite},
                {"exceeded", exceeded()}};
    }

    std::string text() const {
        std::string text = formatted("mse           %.6g\nrelative_mse  %.6g\nmaximum       %.6g", difference.mse,
                                     difference.relative_mse, difference.maximum);
        if (difference.maximum > 0.0)
            text += concat(" at ", x(), ",", y(), " in ", channel());
        if (difference.not_finite > 0)
            text += concat("\nnot finite    ", difference.not_finite, " pixels, left out above");
        return text + "\n";
    }
};

int run_compare(const CompareOptions &options) {
    check_outputs(options);
    const DecodedImage image = read_image(options.image);
    const DecodedImage reference = read_image(options.reference);
    require_comparable(image, reference);
    const std::vector<float> values = image.layer(options.layer);
    const std::vector<float> wanted = reference.layer(options.layer);

    const CompareReport report{options, image, compare_images(values, wanted)};
    write_report_file(options.json, json_text(report.json()));
    if (!options.quiet)
        print_for_people(report.text(), options.json == standard_stream);
    const std::vector<std::string> exceeded = report.exceeded();
    for (const std::string &line : exceeded)
        print_message(line);
    return static_cast<int>(exceeded.empty() ? ExitCode::done : ExitCode::images_differ);
}

constexpr const char *compare_help =
    "For values x of the image and r of the reference, mse is the mean of (x-r)^2 over pixels and\n"
    "channels, relative_mse the mean of (x-r)^2/(r^2+0.01), and maximum the largest |x-r|. Both files\n"
    "hold radiance, or both values for displays, from 0 to 1. Pixels that are not finite in either image\n"
    "are left out and counted; any limit is exceeded then.\n";

} // namespace

void add_compare_command(CLI::App &program, Run &chosen) {
    const auto [command, options] =
        add_command(program, chosen, "compare", "Compare an image with a reference", compare_help, &run_compare);
    constexpr ValueRule limit{.least = 0.0, .largest = 1e18};
    add_text(command, "IMAGE", options.image, "IMAGE", "Image (" + extensions(any_format) + ")")->required();
    add_text(command, "REFERENCE", options.reference, "REFERENCE", "Reference of the same size and kind")->required();
    add_text(command, "--layer", options.layer, "NAME",
             "Compare this layer of both files (default: the channels R, G and B)");
    add_text(command, "--json", options.json, "JSON", "Write the figures as JSON; - is standard output");
    add_quiet(command, options.quiet);
    command.option_defaults()->group("Limits");
    add_number<double>(command, "--max-mse", limit, options.mse, "Exit with 8 if mse is above X");
    add_number<double>(command, "--max-relative-mse", limit, options.relative_mse,
                       "Exit with 8 if relative_mse is above X");
    add_number<double>(command, "--max-difference", limit, options.maximum, "Exit with 8 if maximum is above X");
}

} // namespace cli
