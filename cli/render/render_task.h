// The task of `pt render`: options, scene, and what follows from both.
#pragma once

#include "cli/base/context.h"
#include "cli/render/render_options.h"
#include "cli/scene/scene_file.h"

#include <functional>

namespace cli {

struct RenderTask {
    RenderOptions options;
    SceneFile scene;            // before load(), without the columns in files
    pt_render render;           // of the whole picture
    ImageWindow window;         // the part to be rendered
    std::uint32_t sample_count; // of each half; if a rule may end the rendering, the most

    // Throws Failure for an impossible crop or impossible samples.
    RenderTask(RenderOptions chosen, SceneFile file);

    // Reads the files of columns. Throws Failure, also if one of them is an output.
    void load();

    // Whether denoised halves grow until a rule ends the rendering.
    bool has_rounds() const { return half_count() > 1 && options.stopping.has_any(); }

    // A picture is denoised from two halves with independent seeds.
    std::uint32_t half_count() const { return options.denoiser.empty() ? 1 : 2; }
};

// Throws Failure, blaming the source of the size, if images need more memory than the process can ever have.
void require_host_memory(const RenderTask &task);

// Memory of the images, in bytes.
std::uint64_t image_bytes(const RenderTask &task);

// These functions throw Failure. The library's refusals are blamed on the source of the value, an option or a place in
// a file, and explained in its words.
//
// Checks the result of a call whose arguments come from the task.
void require(const Context &context, const RenderTask &task, pt_result result);

// A pt_progress_fn. user: a std::function<bool(double)>, which receives the share and returns whether to go on.
std::int32_t call_listener(void *user, double share);

// Sets scene and camera. goes_on receives the share of pt_set_scene that is done; if it returns false, so does this,
// and the context is unchanged.
bool describe_scene(const Context &context, const SceneFile &file, const std::function<bool(double)> &goes_on);

} // namespace cli
