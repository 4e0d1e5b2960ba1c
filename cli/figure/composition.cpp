#include "cli/figure/composition.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cli {
namespace {

constexpr double line_light = 0.09;    // a dark grey of 33% in sRGB
constexpr double outline_light = 0.01; // nearly black

Colour shown(const ToneMap &map, std::span<const float> radiance, std::size_t first) {
    const double scale = std::exp2(map.exposure);
    return apply_curve(map.curve, {radiance[first] * scale, radiance[first + 1] * scale, radiance[first + 2] * scale});
}

// A pixel, multiplied by its alpha.
struct Layer {
    Colour light;
    double alpha;
};

// Something of one grey that covers a share of the pixel.
void lay_over(Layer &pixel, double grey, double share) {
    for (double &component : pixel.light) {
        component = std::lerp(component, grey, share);
    }
    pixel.alpha = std::lerp(pixel.alpha, 1.0, share);
}

Layer over_white(const Colour &light, const Colour &stage, double particles) {
    Layer pixel{{}, 1.0};
    for (std::size_t i = 0; i < light.size(); ++i) {
        pixel.light[i] = std::clamp(light[i] + (1.0 - particles) * (1.0 - stage[i]), 0.0, 1.0);
    }
    return pixel;
}

// Takes the white from behind a pixel.
void remove_white(Layer &pixel, double particles) {
    const double darkest = *std::min_element(pixel.light.begin(), pixel.light.end());
    pixel.alpha = std::max(particles, 1.0 - darkest);
    for (double &component : pixel.light) {
        component = std::max(component - (1.0 - pixel.alpha), 0.0);
    }
}

} // namespace

std::optional<FigureBackground> find_figure_background(std::string_view name) {
    const auto found = std::find(figure_background_names.begin(), figure_background_names.end(), name);
    return found == figure_background_names.end()
               ? std::nullopt
               : std::optional(static_cast<FigureBackground>(found - figure_background_names.begin()));
}

ComposedFigure compose(std::span<const float> radiance, std::span<const float> stage, const Overlay &overlay,
                       const ToneMap &tone_map, FigureBackground background) {
    const std::size_t pixel_count = radiance.size() / 3;
    ComposedFigure figure;
    figure.light.resize(radiance.size());
    figure.alpha.resize(background == FigureBackground::transparent ? pixel_count : 0);
    const Colour same_stage = shown(tone_map, stage, 0);
    for (std::size_t i = 0; i < pixel_count; ++i) {
        const Colour behind = stage.size() == 3 ? same_stage : shown(tone_map, stage, 3 * i);
        const double particles = std::min(overlay.particles[i], 1.0F);
        Layer pixel = over_white(shown(tone_map, radiance, 3 * i), behind, particles);
        if (!figure.alpha.empty()) {
            remove_white(pixel, particles);
        }
        lay_over(pixel, outline_light, std::min(overlay.outlines[i], 1.0F));
        lay_over(pixel, line_light, std::min(overlay.lines[i], 1.0F));
        for (std::size_t channel = 0; channel < 3; ++channel) {
            figure.light[3 * i + channel] = static_cast<float>(pixel.light[channel]);
        }
        if (!figure.alpha.empty()) {
            figure.alpha[i] = static_cast<float>(pixel.alpha);
        }
    }
    return figure;
}

} // namespace cli
