#pragma once

#include "lib/code/shader_source.h"
#include "lib/film/film_header.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"
#include "lib/view/prepared_scene.h"

#include <pt/devices.h>

#include <vector>

namespace pt {

// Must be increased with every change of the bits of samples, or of the number of samples for a target error.
inline constexpr std::uint32_t estimator_version = 10;

// Returns everything that decides the bits of samples.
FilmIdentity identity_of(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings,
                         const KernelCode &code, const std::vector<pt_device_info> &devices);

} // namespace pt
