// What decides the bits of a picture's samples.
#pragma once

#include "lib/film/film_header.h"
#include "lib/kernel/prepared_scene.h"
#include "lib/kernel/shader_source.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"

#include <pt/devices.h>

#include <vector>

namespace pt {

// To be raised whenever a change affects the bits of any sample, in the kernel or in what the host prepares for it, or
// which samples a target error takes.
inline constexpr std::uint32_t estimator_version = 7;

// What changes no bit is not part of a film's identity: rows, ranges, submissions, the number of equal devices, and
// whether kernels have the numbers of the scene as constants (trace_pipelines.h).
FilmIdentity identity_of(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings,
                         const KernelCode &code, const std::vector<pt_device_info> &devices);

} // namespace pt
