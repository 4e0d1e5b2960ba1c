#pragma once

#include "cli/base/context.h"
#include "cli/render/render_options.h"
#include "cli/scene/scene.h"

namespace cli {

struct RenderTask {
    RenderOptions options;
    SceneFile scene;            // load() adds the files of columns
    pt_render render;           // settings of the whole picture
    ImageWindow window;         // part to render
    std::uint32_t sample_count; // samples of each half; the maximum, if a rule may end the rendering

    // Throws Failure for an impossible crop or number of samples.
    RenderTask(RenderOptions chosen, SceneFile file);

    // Reads files of columns. Throws Failure, also if a column's file is an output.
    void load();

    // Whether the halves of a denoised image take samples in rounds, until a stopping rule is satisfied.
    bool has_rounds() const { return half_count() > 1 && options.stopping.has_any(); }

    std::uint32_t half_count() const { return options.denoiser.empty() ? 1 : 2; }
};

// Throws Failure if the images need more memory than a process on this machine can have.
void require_host_memory(const RenderTask &task);

std::uint64_t image_bytes(const RenderTask &task);

// Throws Failure and names the option, or the place in the file, that set the refused argument.
void require(const Context &context, const RenderTask &task, pt_result result);

} // namespace cli
