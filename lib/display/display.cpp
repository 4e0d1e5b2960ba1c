#include "lib/display/display.h"

#include "lib/base/check_values.h"
#include "lib/base/struct_size.h"
#include "lib/display/tone_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace pt {

namespace {

constexpr double largest_exposure = 64.0;

bool has_white(const pt_display_info &info) {
    return info.white[0] != 0.0 || info.white[1] != 0.0 || info.white[2] != 0.0;
}

std::uint64_t pixel_bytes(const pt_display_info &info) {
    return (info.alpha ? 4U : 3U) * info.bits / 8U;
}

void check_numbers(const Subject &subject, const pt_display_info &info) {
    const bool is_automatic = info.automatic_exposure != 0;
    const struct {
        const char *member;
        double value;
        bool holds;
        const char *rule;
    } rules[] = {
        {"curve", static_cast<double>(info.curve), is_curve(info.curve), "must be a PT_CURVE_* of pt/display.h"},
        {"bits", static_cast<double>(info.bits), info.bits == 8 || info.bits == 16, "must be 8 or 16, or 0"},
        {"exposure", info.exposure, std::abs(info.exposure) <= (is_automatic ? 0.0 : largest_exposure),
         is_automatic ? "must be 0, since automatic_exposure is set" : "must be in [-64, 64]"},
        {"gamma", info.gamma, info.gamma == 0.0 || (info.gamma >= 0.1 && info.gamma <= 10.0),
         "must be in [0.1, 10], or 0"},
        {"pixel_count", static_cast<double>(info.pixel_count), info.pixel_count <= std::uint64_t{1} << 50,
         "must be <= 2^50"},
    };
    for (const auto &[member, value, holds, rule] : rules)
        subject.require(holds, member, value, rule);
    if (has_white(info))
        subject.check_each("white", info.white, [](double value) {
            return value >= 1e-3 && value <= 1e3 ? nullptr : "must be in [0.001, 1000], or all must be 0";
        });
}

// Without a white point all channels have exactly the same factor.
Color scale_of(const pt_display_info &info) {
    const double brightness = std::exp2(
        info.automatic_exposure != 0 ? automatic_exposure({info.radiance, 3 * info.pixel_count}) : info.exposure);
    if (!has_white(info))
        return {brightness, brightness, brightness};
    const Color white{info.white[0], info.white[1], info.white[2]};
    const double grey = luminance(white);
    return {brightness * (grey / white[0]), brightness * (grey / white[1]), brightness * (grey / white[2])};
}

float unassociated(float radiance, float alpha) {
    return alpha > 0.0F ? std::min(std::max(radiance, 0.0F) / alpha, std::numeric_limits<float>::max()) : 0.0F;
}

template <typename Component>
Component rounded(double signal) {
    return static_cast<Component>(std::lround(signal * std::numeric_limits<Component>::max()));
}

template <typename Component>
void write_pixels(const pt_display_info &info, std::byte *to) {
    const Color scale = scale_of(info);
    const std::size_t bytes = static_cast<std::size_t>(pixel_bytes(info));
    for (std::size_t pixel = 0; pixel < info.pixel_count; ++pixel, to += bytes) {
        const float alpha = info.alpha ? info.alpha[pixel] : 1.0F;
        Color light;
        for (std::size_t channel = 0; channel < 3; ++channel)
            light[channel] = unassociated(info.radiance[3 * pixel + channel], alpha) * scale[channel];
        light = apply_curve(info.curve, light);
        std::array<Component, 4> components{};
        for (std::size_t channel = 0; channel < 3; ++channel)
            components[channel] = rounded<Component>(info.gamma != 0.0 ? std::pow(light[channel], 1.0 / info.gamma)
                                                                       : encode_srgb(light[channel]));
        components[3] = rounded<Component>(alpha);
        std::memcpy(to, components.data(), bytes);
    }
}

} // namespace

pt_display_info validated_display(const pt_display_info *user) {
    pt_display_info info = copy_in(user, "display");
    info.bits = info.bits == 0 ? 8 : info.bits;
    Violations violations;
    const Subject subject(violations, "display");
    check_numbers(subject, info);
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    if (info.size_bytes < info.pixel_count * pixel_bytes(info))
        subject.refuse("size_bytes", number_text(info.size_bytes),
                       "must be >= pixel_count times 3, or 4 with alpha, times bits / 8");
    if (!info.pixels && info.pixel_count != 0)
        subject.refuse("pixels", "NULL", "must not be NULL");
    check_values(subject, "radiance", info.radiance, 3 * info.pixel_count, &finite_rule);
    if (info.alpha)
        check_values(subject, "alpha", info.alpha, info.pixel_count, &share_rule);
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    return info;
}

void check_radiance(std::span<const float> radiance) {
    Violations violations;
    check_values(Subject(violations, "display"), "radiance", radiance.data(), radiance.size(), &finite_rule);
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
}

double automatic_exposure(std::span<const float> radiance) {
    constexpr double middle_grey = 0.18;
    constexpr double black = 1.0 / 128.0; // fraction of the level
    std::vector<double> means;
    const auto light = [&](std::size_t i) { return static_cast<double>(std::max(radiance[i], 0.0F)); };
    for (std::size_t i = 0; i < radiance.size(); i += 3)
        if (const double mean = (light(i) + light(i + 1) + light(i + 2)) / 3.0; mean > 0.0)
            means.push_back(mean);
    double level = std::numeric_limits<double>::infinity();
    for (int cut = 0; cut <= 3; ++cut) {
        double sum = 0.0;
        for (const double mean : means)
            sum += std::min(mean, level);
        level = sum / static_cast<double>(means.size());
    }
    double sum = 0.0;
    double weights = 0.0;
    for (const double mean : means) {
        const double weight = mean / (mean + black * level);
        sum += weight * std::log2(mean);
        weights += weight;
    }
    const double stops = means.empty() ? 0.0 : std::log2(middle_grey) - sum / weights;
    return std::clamp(std::round(100.0 * stops) / 100.0, -largest_exposure, largest_exposure);
}

void display(const pt_display_info &info) {
    auto *to = static_cast<std::byte *>(info.pixels);
    info.bits == 16 ? write_pixels<std::uint16_t>(info, to) : write_pixels<std::uint8_t>(info, to);
}

} // namespace pt
