#include <pt/display.h>

#include "lib/api/context.h"
#include "lib/api/guard.h"
#include "lib/base/struct_size.h"
#include "lib/display/display.h"

pt_result pt_display(const pt_display_info *info) {
    return pt::guard(pt::thread_last_error, [&] { pt::display(pt::validated_display(info)); });
}

pt_result pt_automatic_exposure(const float *radiance, uint64_t pixel_count, double *exposure) {
    return pt::guard(pt::thread_last_error, [&] {
        pt::require_not_null(exposure, "exposure");
        const std::span pixels(radiance, static_cast<std::size_t>(3 * pixel_count));
        pt::check_radiance(pixels);
        *exposure = pt::automatic_exposure(pixels);
    });
}
