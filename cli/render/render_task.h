// What `pt render` is to do: the options, the scene, and what follows from both.
#pragma once

#include "cli/base/context.h"
#include "cli/render/render_options.h"
#include "cli/scene/scene_file.h"

#include <functional>

namespace cli {

struct RenderTask {
    RenderOptions options;
    SceneFile scene;            // before load(), without the columns that are in files
    pt_render render;           // settings of the whole picture
    ImageWindow window;         // the part of the picture that is wanted
    std::uint32_t sample_count; // of each half; if something else may end the rendering, the most

    // Throws Failure for a crop or samples that do not exist.
    RenderTask(RenderOptions chosen, SceneFile file);

    // Reads the files with columns. Throws Failure, also if one of them is an output.
    void load();

    // Whether the halves grow until a rule ends it.
    bool has_rounds() const { return half_count() > 1 && options.stopping.has_any(); }

    // A picture is denoised from two halves of its samples, which other seeds make independent.
    std::uint32_t half_count() const { return options.denoiser.empty() ? 1 : 2; }
};

// Throws Failure if the images take more memory than this process can ever have; it blames whatever gave the size.
void require_host_memory(const RenderTask &task);

// How much memory the images take, in bytes.
std::uint64_t image_bytes(const RenderTask &task);

// The following functions throw Failure. What the library refuses is blamed on whatever gave the value, an option or a
// place in a file, and explained in its words.
//
// Checks the result of a call whose arguments come from the task.
void require(const Context &context, const RenderTask &task, pt_result result);

// A pt_progress_fn. user is a std::function<bool(double)>, which receives the share that is done and returns whether to
// go on.
std::int32_t call_listener(void *user, double share);

// Sets scene and camera. goes_on receives the share of pt_set_scene that is done, and may end it by returning false:
// then this returns false, and the context is as it was.
bool describe_scene(const Context &context, const SceneFile &file, const std::function<bool(double)> &goes_on);

} // namespace cli
