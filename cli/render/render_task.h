#pragma once

#include "cli/base/context.h"
#include "cli/render/render_options.h"
#include "cli/scene/scene_file.h"

#include <functional>

namespace cli {

struct RenderTask {
    RenderOptions options;
    SceneFile scene;            // before load() without files of columns
    pt_render render;           // settings of the whole picture
    ImageWindow window;         // the part to be rendered
    std::uint32_t sample_count; // samples of each half; the most if a rule may end the rendering

    // Throws Failure for an impossible crop or impossible samples.
    RenderTask(RenderOptions chosen, SceneFile file);

    // Reads files of columns. Throws Failure, also if one is an output.
    void load();

    // Whether denoised halves grow until a rule is met.
    bool has_rounds() const { return half_count() > 1 && options.stopping.has_any(); }

    std::uint32_t half_count() const { return options.denoiser.empty() ? 1 : 2; }
};

// Throws Failure if the images exceed the memory of any process here.
void require_host_memory(const RenderTask &task);

// Bytes of the images in memory.
std::uint64_t image_bytes(const RenderTask &task);

// Throws the library's refusal of an argument, blaming the option or the place in the file that set it.
void require(const Context &context, const RenderTask &task, pt_result result);

// A pt_progress_fn whose user is a std::function<bool(double)>.
std::int32_t call_listener(void *user, double share);

// Sets scene and camera. Returns false, with the context unchanged, once goes_on(share) does. Throws Failure.
bool describe_scene(const Context &context, const SceneFile &file, const std::function<bool(double)> &goes_on);

} // namespace cli
