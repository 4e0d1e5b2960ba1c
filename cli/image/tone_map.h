// From linear radiance to pixels of 8 or 16 bits: exposure, tone curve, display encoding, rounding.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace cli {

using Color = std::array<double, 3>; // linear, Rec. 709 primaries

enum class ToneCurve {
    none,     // clamp to [0, 1]
    reinhard, // Reinhard et al. 2002
    aces,     // Narkowicz's fit of ACES, 2015
    agx,      // Sobotka's AgX base
    neutral   // Khronos PBR Neutral, 2024
};

inline constexpr std::array<std::string_view, 5> tone_curve_names{"none", "reinhard", "aces", "agx", "neutral"};

std::optional<ToneCurve> find_tone_curve(std::string_view name);

struct ToneMap {
    double exposure = 0.0; // stops: radiance is multiplied by 2^exposure
    ToneCurve curve = ToneCurve::none;
    std::optional<double> gamma; // encode with the power 1 / gamma in place of the sRGB curve
};

// Radiance >= 0 to light of the display, each component in [0, 1].
Color apply_curve(ToneCurve curve, const Color &radiance);

// Light of the display in [0, 1] to the signal in [0, 1]: IEC 61966-2-1.
double encode_srgb(double light);

// R, G, B triples of radiance >= 0 in, as many bytes or words out: 255 or 65535 times the signal, rounded, halves up.
std::vector<std::uint8_t> map_to_8_bits(std::span<const float> radiance, const ToneMap &map);
std::vector<std::uint16_t> map_to_16_bits(std::span<const float> radiance, const ToneMap &map);

class ByteEncoder {
public:
    // encode: light of the display in [0, 1] to the signal in [0, 1], from 0 to 1 and never falling.
    explicit ByteEncoder(const std::function<double(double)> &encode);

    // The byte of light in [0, 1]: 255 times the signal, rounded, halves up.
    std::uint8_t operator()(double light) const {
        const auto cell = static_cast<std::size_t>(light * cell_count);
        const double *const first = least_light_.data() + cell_bytes_[cell];
        const double *const last = least_light_.data() + cell_bytes_[cell + 1];
        return static_cast<std::uint8_t>(std::upper_bound(first + 1, last + 1, light) - 1 - least_light_.data());
    }

private:
    static constexpr std::size_t cell_count = 4096; // of [0, 1): most of them have one byte or two

    std::array<double, 256> least_light_;                 // of each byte
    std::array<std::uint8_t, cell_count + 2> cell_bytes_; // where a cell begins, 1 being a cell too
};

} // namespace cli
