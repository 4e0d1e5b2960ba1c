// What `pt render` is to render: the options, the scene, and what follows from both.
#pragma once

#include "cli/base/context.h"
#include "cli/render/render_options.h"
#include "cli/scene/scene_file.h"

#include <functional>

namespace cli {

struct RenderTask {
    RenderOptions options;
    SceneFile scene;            // without the columns of files, before load()
    pt_render render;           // of the whole picture
    ImageWindow window;         // the part of it that is wanted
    std::uint32_t sample_count; // the most, if something else may stop it

    // Throws Failure for a crop or samples that do not exist.
    RenderTask(RenderOptions chosen, SceneFile file);

    // Reads the files of the columns, none of which may be an output. Throws Failure.
    void load();

    bool has_target() const { return options.target_error > 0.0; }
};

// Throws Failure if its images take more memory than this process can ever have, and blames who gave the size.
void require_host_memory(const RenderTask &task);

// How much memory its images take.
std::uint64_t image_bytes(const RenderTask &task);

// All throw Failure. What the library refuses is explained in the words of whoever gave the value, whose fault it is.
//
// Of a call whose arguments come from the task.
void require(const Context &context, const RenderTask &task, pt_result result);

// A progress callback of the library's, whose user is a std::function<bool(double)>, which is told the share that is
// done and returns whether it goes on.
std::int32_t call_listener(void *user, double share);

// Hands scene and camera over. goes_on is told the share of the scene that is taken over, and may end that by returning
// false: then false is returned, and the context is as it was.
bool describe_scene(const Context &context, const SceneFile &file, const std::function<bool(double)> &goes_on);

} // namespace cli
