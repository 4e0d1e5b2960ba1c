// The option --frames of `pt render`.
#include "cli/base/interrupt.h"
#include "cli/base/message.h"
#include "cli/base/text.h"
#include "cli/base/vector_width.h"
#include "cli/render/render_command.h"
#include "cli/render/render_output.h"
#include "cli/render/render_picture.h"

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

namespace cli {
namespace {

void number_name(const std::string &option, std::string &path, std::uint32_t frame) {
    const std::optional<std::string> name = numbered_name(path, frame);
    if (!name && !path.empty()) {
        throw Failure(ExitCode::usage,
                      option + " " + path + ": with --frames the name must have # signs, for the number of the frame");
    }
    path = name.value_or("");
}

RenderOptions options_of_frame(const RenderOptions &options, std::uint32_t frame) {
    RenderOptions numbered = options;
    OutputOptions &output = numbered.output;
    for (std::string &path : output.images)
        number_name("-o", path, frame);
    number_name("--standard-error", output.standard_error, frame);
    number_name("--film", output.film, frame);
    number_name("--stats", output.stats, frame);
    return numbered;
}

// Files appear whole or not at all.
bool is_done(const OutputOptions &frame) {
    for (const NamedFile &file : outputs_of(frame)) {
        std::error_code ignored;
        if (!file.path.empty() && !std::filesystem::exists(file.path, ignored))
            return false;
    }
    return true;
}

class FramesRender {
public:
    FramesRender(const RenderOptions &options, ValidationLog &log) :
        options_(options),
        log_(log),
        text_(read_scene_text(options.scene)),
        scene_(parse_scene(text_.text, text_.path, options.overrides)) {
        if (scene_.animation.empty())
            throw Failure(ExitCode::scene, scene_.path + ": has no animation, of which --frames are rendered");
    }

    int run() {
        const FrameRange frames = options_.frames.value();
        for (std::uint64_t frame = frames.first; frame <= frames.last; ++frame) {
            const auto number = static_cast<std::uint32_t>(frame);
            const RenderOptions numbered = options_of_frame(options_, number);
            if (options_.skip_existing && is_done(numbered.output))
                continue;
            const Outcome outcome = render(numbered, number);
            if (outcome == Outcome::not_all_written)
                return static_cast<int>(ExitCode::file);
            if (interrupt_signal() != 0) {
                print_message(concat("stopped by ", interrupt_name(), " in frame ", number));
                return exit_code_of_signal(interrupt_signal());
            }
            is_target_missed_ = is_target_missed_ || outcome == Outcome::target_missed;
        }
        return static_cast<int>(is_target_missed_ ? ExitCode::target_missed : ExitCode::done);
    }

    int parts() const {
        const FrameRange frames = options_.frames.value();
        if (frames.first != frames.last)
            throw Failure(ExitCode::usage, "--parts: takes --frames of one frame at a time");
        return render_parts(task_of(options_, frames.first), log_);
    }

private:
    // The seed differs from frame to frame, or all would have the same noise, which would seem to stand before the
    // picture.
    RenderTask task_of(const RenderOptions &options, std::uint32_t frame) const {
        std::vector<SceneOverride> overrides = overrides_of_frame(scene_, frame);
        overrides.insert(overrides.end(), options.overrides.begin(), options.overrides.end());
        RenderTask task(options, parse_scene(text_.text, text_.path, std::move(overrides)));
        task.load();
        task.render.seed += frame;
        return task;
    }

    Outcome render(const RenderOptions &options, std::uint32_t frame) {
        RenderTimes times;
        check_names(options);
        const RenderTask task = task_of(options, frame);
        check_outputs(task);
        times.create_start = std::chrono::steady_clock::now();
        if (!context_) {
            catch_interrupts();
            catch_picture_requests(); // which nothing answers, but which are not to end it
            choose_vector_width();
            context_.emplace(render_create_info(options_, log_));
        }
        return render_picture(*context_, task, times, [] { return interrupt_signal() != 0; });
    }

    const RenderOptions &options_;
    ValidationLog &log_;
    SceneText text_; // read once, so that all frames are of one scene
    SceneFile scene_;
    std::optional<Context> context_; // for all frames: kernels are kept
    bool is_target_missed_ = false;
};

} // namespace

int render_frames(const RenderOptions &options, ValidationLog &log) {
    FramesRender frames(options, log);
    return options.parts ? frames.parts() : frames.run();
}

} // namespace cli
