// Renders parts of a picture for another program, which shares it among machines and adds their films, as pt-farm does.
#pragma once

#include "cli/render/render_context.h"
#include "cli/render/render_options.h"
#include "cli/scene/render_settings.h"
#include "cli/scene/scene_file.h"

namespace cli {

// First writes one line to standard output: an object of JSON with what decides which parts there are (width, height,
// first_sample, samples, target_error as in pt_accumulate_info, sampling as PT_SAMPLING_*) and how the picture is shown
// (exposure, a number or "auto"; tonemap; gamma, null for the sRGB curve). Then answers requests until standard input
// ends; without any, no device is looked for.
//
// A request is words of 32 bits in the machine's byte order: the first sample, the sample after the last, the number of
// tiles, and their indices (pt_accumulate_info.tile_samples), each once. Its answer is a line with two numbers, the
// kind of device (PT_DEVICE_*) and the bytes that follow: the film.
//
// Throws Failure; a request that makes no sense is ExitCode::usage.
int render_parts(const RenderOptions &options, const SceneFile &file, const RenderSettings &settings,
                 ValidationLog &log);

} // namespace cli
