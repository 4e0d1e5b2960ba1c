#include "cli/compare/compare_report.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

namespace cli {
namespace {

std::string number_text(double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", number);
    return text.data();
}

// Where a value is, in the picture.
struct Place {
    std::int64_t x;
    std::int64_t y;
    std::string channel;
};

Place place_of(const DecodedImage &image, std::size_t value) {
    const std::size_t pixel = value / 3;
    return {image.x + static_cast<std::int64_t>(pixel % image.width),
            image.y + static_cast<std::int64_t>(pixel / image.width), std::string(1, "RGB"[value % 3])};
}

void check_limit(std::vector<std::string> &lines, const std::string &name, double figure, std::optional<double> limit) {
    if (limit && !(figure <= *limit))
        lines.push_back(name + " is " + number_text(figure) + ", above the limit of " + number_text(*limit));
}

} // namespace

std::vector<std::string> CompareReport::exceeded() const {
    std::vector<std::string> lines;
    check_limit(lines, "mse", difference.mse, options.mse);
    check_limit(lines, "relative_mse", difference.relative_mse, options.relative_mse);
    check_limit(lines, "maximum", difference.maximum, options.maximum);
    if (difference.not_finite > 0 && (options.mse || options.relative_mse || options.maximum))
        lines.push_back(std::to_string(difference.not_finite) + " pixels are not finite");
    return lines;
}

nlohmann::ordered_json CompareReport::json() const {
    const auto [x, y, channel] = place_of(image, difference.maximum_value);
    return {{"image", options.image},
            {"reference", options.reference},
            {"layer", options.layer},
            {"width", image.width},
            {"height", image.height},
            {"mse", difference.mse},
            {"relative_mse", difference.relative_mse},
            {"maximum", difference.maximum},
            {"maximum_at", {{"x", x}, {"y", y}, {"channel", channel}}},
            {"not_finite", difference.not_finite},
            {"exceeded", exceeded()}};
}

std::string CompareReport::text() const {
    const auto [x, y, channel] = place_of(image, difference.maximum_value);
    std::string text = "mse           " + number_text(difference.mse) + "\nrelative_mse  " +
                       number_text(difference.relative_mse) + "\nmaximum       " + number_text(difference.maximum);
    if (difference.maximum > 0.0)
        text += " at " + std::to_string(x) + "," + std::to_string(y) + " in " + channel;
    if (difference.not_finite > 0)
        text += "\nnot finite    " + std::to_string(difference.not_finite) + " pixels, left out above";
    return text + "\n";
}

} // namespace cli
