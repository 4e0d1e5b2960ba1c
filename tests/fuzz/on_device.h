#pragma once

#include "tests/fuzz/require.h"
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"

#include <pt/pt.h>
#include <pt/stats.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>

namespace fuzz {

inline void complain(void *, std::int32_t level, const char *line) {
    require(level == PT_LOG_INFO, line);
}

inline pt_context *context() {
    static const std::unique_ptr<pt_context, decltype(&pt_destroy)> created = [] {
        auto info = sized<pt_create_info>();
        info.flags = std::getenv("PT_TEST_NO_VALIDATION") ? 0 : PT_CREATE_VALIDATION;
        info.device = std::getenv("PT_TEST_DEVICE");
        info.log = complain;
        pt_context *context = nullptr;
        require(pt_create(&info, &context) == PT_OK, pt_last_error(nullptr));
        return std::unique_ptr<pt_context, decltype(&pt_destroy)>(context, &pt_destroy);
    }();
    return created.get();
}

inline void require_done(pt_result result) {
    require(result == PT_OK, std::string(pt_result_name(result)) + ": " + pt_last_error(context()));
}

inline void take_samples(std::uint32_t count) {
    const pt_accumulate_info info = accumulate_info(count);
    require_done(pt_accumulate(context(), &info));
}

constexpr std::uint32_t most_pixels = 64;
using Pixels = std::array<float, 3 * most_pixels>;

inline Pixels read_pixels(std::uint32_t quantity) {
    Pixels pixels{};
    const pt_image image = image_target(pixels, quantity);
    require_done(pt_readback(context(), &image));
    return pixels;
}

inline Pixels read_radiance() {
    const Pixels radiance = read_pixels(PT_QUANTITY_RADIANCE);
    for (const float x : radiance)
        require(x >= 0.0F && std::isfinite(x), "radiance is finite and not negative");
    return radiance;
}

inline pt_stats stats() {
    auto stats = sized<pt_stats>();
    require_done(pt_get_stats(context(), &stats));
    return stats;
}

} // namespace fuzz
