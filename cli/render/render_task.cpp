#include "cli/render/render_task.h"

#include "cli/base/devices.h"
#include "cli/base/text.h"
#include "cli/picture/picture_output.h"
#include "lib/platform/process.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace cli {
namespace {

// Sample indices have 32 bits. A larger count is reduced if it is an upper limit, else refused.
std::uint32_t limited_samples(std::uint32_t count, std::uint32_t first, bool is_upper_limit) {
    const std::uint64_t left = (std::uint64_t{1} << 32) - first;
    refuse_if(count > left && !is_upper_limit,
              concat("--first-sample ", first, ": ", counted(count, "sample"),
                     " from there on would pass the last index, ", std::numeric_limits<std::uint32_t>::max()));
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(count, left));
}

ImageWindow chosen_window(const std::optional<Rectangle> &crop, const pt_render &render) {
    ImageWindow window = whole_window(render.width, render.height);
    if (!crop)
        return window;
    const bool is_inside = crop->x < render.width && crop->width <= render.width - crop->x && crop->y < render.height &&
                           crop->height <= render.height - crop->y;
    refuse_if(!is_inside || crop->pixel_count() == 0,
              concat("--crop ", crop->x, ",", crop->y, ",", crop->width, ",", crop->height,
                     ": must be a part of the picture of ", window_text(window), " pixels, with at least one pixel"));
    window.part = *crop;
    return window;
}

std::uint32_t image_count(const RenderOptions &options) {
    // Denoising needs the second half, two filtered halves, the result, and the filter's inputs and outputs.
    const std::uint32_t of_denoising = options.denoiser.empty() ? 0 : 8;
    return 1 + static_cast<std::uint32_t>(options.wanted_layers().size()) + of_denoising;
}

} // namespace

RenderTask::RenderTask(RenderOptions chosen, SceneFile file) :
    options(std::move(chosen)),
    scene(std::move(file)),
    render(scene.render) {
    render.first_sample = options.first_sample;
    render.flags = options.output.alpha ? PT_RENDER_COVERAGE : 0;
    sample_count = limited_samples(scene.sample_count.value_or(options.stopping.usual_samples()), render.first_sample,
                                   options.stopping.has_any());
    sample_count = std::max(sample_count / half_count(), 1U);
    window = chosen_window(options.crop, render);
}

void RenderTask::load() {
    std::vector<NamedFile> sources;
    for (const std::string &path : pt::column_paths(scene))
        sources.push_back({"a column of spheres", path});
    require_distinct_files(sources, outputs_of(options.output, options.checkpoint));
    load_columns(scene);
}

std::uint64_t image_bytes(const RenderTask &task) {
    constexpr std::uint64_t pixel_bytes = 3 * sizeof(float);
    return pixel_bytes * task.window.part.width * task.window.part.height * image_count(task.options);
}

void require_host_memory(const RenderTask &task) {
    const std::uint64_t needed = image_bytes(task);
    const std::uint64_t most = platform::most_bytes();
    if (needed <= most)
        return;
    const ExitCode code = blame(task.scene, BrokenRule{.subject = "render", .member = "width"});
    const std::uint32_t count = image_count(task.options);
    throw Failure(code, concat(code == ExitCode::scene ? task.options.scene + ": film of " : "--size ",
                               window_text(task.window), ": ",
                               count == 1 ? "the image takes " : concat(count, " images take "), memory_text(needed),
                               " of memory, more than the ", memory_text(most), " that this process can have"));
}

void require(const Context &context, const RenderTask &task, pt_result result) {
    const LibraryError error = result < 0 ? context.last_error() : LibraryError{};
    if (!error.rules.empty())
        throw Failure(blame(task.scene, error), explain(task.scene, error));
    context.require(result);
}

} // namespace cli
