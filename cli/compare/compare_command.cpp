#include "cli/base/exit_code.h"
#include "cli/base/file.h"
#include "cli/base/json.h"
#include "cli/base/options.h"
#include "cli/base/text.h"
#include "cli/commands.h"
#include "cli/compare/kernels.h"
#include "cli/compare/light.h"
#include "cli/film/film.h"
#include "cli/image/image_file.h"
#include "lib/scene_file/enumerations.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cli {
namespace {

struct ImageDifference {
    // Means over the channels of pixels that are finite in both images. x is a value, and r the reference's value.
    double mse;          // mean of (x - r)^2
    double relative_mse; // mean of (x - r)^2 / (r^2 + 0.01)

    double maximum;
    std::size_t maximum_value; // index of a pixel value with this difference

    std::size_t not_finite; // pixels with an infinite or NaN channel in one of the images
};

using Values = std::span<const float>;

constexpr const char *counts_channel = "sample_count";

constexpr double relative_offset = 0.01;

bool is_finite(Values pixel) {
    return std::all_of(pixel.begin(), pixel.end(), [](float value) { return std::isfinite(value); });
}

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
    std::string layer; // empty for the main layer
    std::string json;
    std::string difference;
    KernelTask kernels; // compared instead of images if it has a shader_dir
    LightRule rule;
    bool quiet = false;

    std::optional<double> mse;
    std::optional<double> relative_mse;
    std::optional<double> maximum;
};

void check_outputs(const CompareOptions &options) {
    require_distinct_files({{"the image", options.image}, {"the reference", options.reference}},
                           {{"--json", options.json}, {"--difference", options.difference}});
    check_report_file(options.json);
    refuse_if(!options.difference.empty() && !options.difference.ends_with(".png"),
              "--difference " + options.difference + ": the name must end in .png");
    const bool has_kernels = !options.kernels.shader_dir.empty();
    refuse_if(has_kernels != options.reference.empty(),
              has_kernels ? "--shader-dir: needs a scene and no REFERENCE" : "REFERENCE is required");
}

DecodedImage read_film_image(const std::string &path) {
    const FilmHandle film(path, read_film_file(path));
    const pt_film_info info = film.info();
    DecodedImage image{};
    image.path = path;
    image.x = static_cast<std::int32_t>(info.x);
    image.y = static_cast<std::int32_t>(info.y);
    image.width = info.columns;
    image.height = info.rows;
    image.full_width = info.width;
    image.full_height = info.height;
    image.is_float = true;
    image.channels = {"R", "G", "B", counts_channel};
    const std::vector<float> radiance = film.read_image(PT_QUANTITY_RADIANCE);
    const std::vector<float> counts = film.read_image(PT_QUANTITY_SAMPLE_COUNT);
    for (std::size_t i = 0; i < radiance.size(); i += 3)
        image.values.insert(image.values.end(), {radiance[i], radiance[i + 1], radiance[i + 2], counts[i]});
    image.attributes = {{"pt.sampler", std::string(pt::samplers.name(info.sampler))},
                        {"pt.estimator", std::string(pt::estimators.name(info.estimator))}};
    return image;
}

DecodedImage read_compared(const std::string &path) {
    return path.ends_with(".ptfilm") ? read_film_image(path) : read_image(path);
}

bool has_counts(const DecodedImage &image) {
    return std::ranges::count(image.channels, counts_channel) > 0;
}

std::string attribute_of(const DecodedImage &image, std::string_view name) {
    const auto found = std::ranges::find(image.attributes, name, &ImageAttribute::name);
    return found == image.attributes.end() ? "" : attribute_text(*found);
}

TestedImage tested(const DecodedImage &image, const std::vector<float> &radiance) {
    const std::vector<float> counts = image.layer(counts_channel);
    const auto [fewest, most] = std::ranges::minmax(counts);
    return {image.window(),
            radiance,
            static_cast<std::uint32_t>(fewest),
            static_cast<std::uint32_t>(most),
            pt::samplers.find(attribute_of(image, "pt.sampler")).value_or(0),
            pt::estimators.find(attribute_of(image, "pt.estimator")).value_or(0)};
}

std::string size_text(const DecodedImage &image) {
    return concat(image.width, "x", image.height, " at ", image.x, ",", image.y, " of ", image.full_width, "x",
                  image.full_height);
}

const char *kind_text(const DecodedImage &image) {
    return image.is_float ? "radiance" : "numbers for displays";
}

void require_comparable(const DecodedImage &image, const DecodedImage &reference) {
    refuse_if(size_text(image) != size_text(reference),
              concat(image.path, " is ", size_text(image), ", ", reference.path, " is ", size_text(reference),
                     ": they must be equally large"));
    refuse_if(image.is_float != reference.is_float,
              concat(image.path, " holds ", kind_text(image), ", ", reference.path, " holds ", kind_text(reference),
                     ": both must hold the same"));
}

struct CompareReport {
    const CompareOptions &options;
    const DecodedImage &image;
    ImageDifference difference;
    std::optional<LightVerdict> verdict;

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
        nlohmann::ordered_json json = figures();
        if (verdict)
            json.update(light_json(*verdict));
        return json;
    }

    nlohmann::ordered_json figures() const {
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
            text += concat("\nnot finite    ", difference.not_finite, " pixels, not counted above");
        return text + "\n" + (verdict ? light_text(*verdict) : "");
    }
};

// Prints the reason unless the light is the same.
ExitCode exit_code_of(const LightVerdict &verdict) {
    if (verdict.is_decided() && !verdict.is_different())
        return ExitCode::done;
    print_message(verdict.comparison.summary);
    return verdict.is_different() ? ExitCode::images_differ : ExitCode::undecided;
}

int run_kernels(const CompareOptions &options) {
    KernelTask task = options.kernels;
    task.scene = options.image;
    task.rule = options.rule;
    task.rule.min_change = options.rule.min_change.value_or(0.01);
    const auto tell = [&](std::uint32_t samples, const LightVerdict &verdict) {
        if (!options.quiet)
            print_for_people(concat(counted(samples, "sample"), ": ", light_text(verdict)),
                             options.json == standard_stream);
    };
    const LightVerdict verdict = compare_kernels(task, tell);
    write_report_file(options.json, json_text(light_json(verdict)));
    if (!options.difference.empty())
        write_difference(options.difference, verdict);
    return static_cast<int>(exit_code_of(verdict));
}

std::optional<LightVerdict> verdict_of(const CompareOptions &options, const DecodedImage &image,
                                       const DecodedImage &reference, const std::vector<float> &values,
                                       const std::vector<float> &wanted) {
    const bool is_tested = options.layer.empty() && has_counts(image) && has_counts(reference);
    refuse_if(!is_tested && (options.rule.rate || options.rule.min_change || !options.difference.empty()),
              "--rate, --min-change, --difference: need two films, or two .exr with the layer sample-count");
    return is_tested ? std::optional(test_light(tested(image, values), tested(reference, wanted), options.rule))
                     : std::nullopt;
}

int run_compare(const CompareOptions &options) {
    check_outputs(options);
    if (!options.kernels.shader_dir.empty())
        return run_kernels(options);
    const DecodedImage image = read_compared(options.image);
    const DecodedImage reference = read_compared(options.reference);
    require_comparable(image, reference);
    const std::vector<float> values = image.layer(options.layer);
    const std::vector<float> wanted = reference.layer(options.layer);

    const CompareReport report{options, image, compare_images(values, wanted),
                               verdict_of(options, image, reference, values, wanted)};
    write_report_file(options.json, json_text(report.json()));
    if (!options.difference.empty())
        write_difference(options.difference, *report.verdict);
    if (!options.quiet)
        print_for_people(report.text(), options.json == standard_stream);
    const std::vector<std::string> exceeded = report.exceeded();
    for (const std::string &line : exceeded)
        print_message(line);
    if (!exceeded.empty())
        return static_cast<int>(ExitCode::images_differ);
    return static_cast<int>(report.verdict ? exit_code_of(*report.verdict) : ExitCode::done);
}

constexpr const char *compare_help =
    "For values x of the image and r of the reference, mse is the mean of (x-r)^2 over pixels and\n"
    "channels, relative_mse the mean of (x-r)^2/(r^2+0.01), and maximum the largest |x-r|. Both files\n"
    "hold radiance, or both hold values for displays, from 0 to 1. Pixels that are not finite in either\n"
    "image are left out and counted, and exceed any limit.\n"
    "Two films, or two .exr with the layer sample-count, are also tested for the same light. The exit code\n"
    "is 0 if no difference exceeds the noise, 8 if one does, and 9 if a change of --min-change may be missed.\n"
    "With --shader-dir the kernels in a folder and the library's kernels render SCENE until the test decides.\n";

} // namespace

void add_compare_command(CLI::App &program, Run &chosen) {
    const auto [command, options] =
        add_command(program, chosen, "compare", "Compare an image with a reference", compare_help, &run_compare);
    constexpr ValueRule limit{.least = 0.0, .largest = 1e18};
    add_text(command, "IMAGE", options.image, "IMAGE",
             "Image (" + extensions(any_format) + "), film (.ptfilm), or scene")
        ->required();
    add_text(command, "REFERENCE", options.reference, "REFERENCE", "Reference of the same size and kind");
    add_text(command, "--layer", options.layer, "NAME",
             "Compare this layer of both files (default: the channels R, G and B)");
    add_text(command, "--json", options.json, "JSON", "Write the figures as JSON; - is standard output");
    add_text(command, "--difference", options.difference, "PNG",
             "Write the tiles' differences in standard deviations: brighter is red, darker is blue, saturated at 8");
    add_quiet(command, options.quiet);
    command.option_defaults()->group("Test of the light");
    add_number<double>(command, "--rate", {.least = 1e-12, .largest = 0.5}, options.rule.rate,
                       "Probability of calling equal light different (default: 1e-6)");
    const auto read_change = [&options = options](const std::string &text) {
        options.rule.min_change = parse_share(text);
        if (!(options.rule.min_change > 0.0 && options.rule.min_change <= 1.0))
            refuse_option("--min-change", "must be above 0 and at most 1, like 0.01 or 1%", text);
    };
    command
        .add_option_function<std::string>("--min-change", read_change,
                                          "Exit with 9 if a change of all light by this much may be missed, like 1% "
                                          "(default: 100%, with --shader-dir 1%)")
        ->type_name("SHARE");
    add_shader_dir(command, options.kernels.shader_dir);
    add_device(command, options.kernels.device);
    add_set(command, options.kernels.overrides);
    command.option_defaults()->group("Limits");
    add_number<double>(command, "--max-mse", limit, options.mse, "Exit with 8 if mse is above X");
    add_number<double>(command, "--max-relative-mse", limit, options.relative_mse,
                       "Exit with 8 if relative_mse is above X");
    add_number<double>(command, "--max-difference", limit, options.maximum, "Exit with 8 if maximum is above X");
}

} // namespace cli
