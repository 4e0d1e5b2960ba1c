// How a scene file wants its picture to be shown.
#pragma once

#include "lib/scene_file/names.h"

#include <optional>

namespace pt {

enum class ToneCurve {
    none, // clamps only
    reinhard,
    aces,
    agx,
    neutral
};

inline constexpr ValueNames<5, ToneCurve> tone_curves({{"none", ToneCurve::none},
                                                       {"reinhard", ToneCurve::reinhard},
                                                       {"aces", ToneCurve::aces},
                                                       {"agx", ToneCurve::agx},
                                                       {"neutral", ToneCurve::neutral}});

inline constexpr double largest_exposure = 64.0;

struct Display {
    std::optional<double> exposure; // stops; empty: automatic
    ToneCurve curve = ToneCurve::none;
    std::optional<double> gamma; // empty: the sRGB curve
};

} // namespace pt
