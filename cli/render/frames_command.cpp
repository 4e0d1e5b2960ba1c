#include "cli/render/frames_command.h"

#include "cli/base/context.h"
#include "cli/base/exit_code.h"
#include "cli/base/interrupt.h"
#include "cli/base/message.h"
#include "cli/base/vector_width.h"
#include "cli/render/parts_command.h"
#include "cli/render/render_output.h"
#include "cli/render/render_picture.h"
#include "cli/scene/animation_section.h"
#include "cli/scene/render_settings.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <vector>

namespace cli {
namespace {

std::string name_of_frame(const std::string &option, const std::string &pattern, std::uint32_t frame) {
    const std::optional<std::string> name = numbered_name(pattern, frame);
    if (!name && !pattern.empty()) {
        throw Failure(ExitCode::usage, option + " " + pattern +
                                           ": with --frames the name must have # signs, for the number of the frame");
    }
    return name.value_or("");
}

RenderOptions options_of_frame(const RenderOptions &options, std::uint32_t frame) {
    RenderOptions numbered = options;
    for (std::string &path : numbered.outputs)
        path = name_of_frame("-o", path, frame);
    numbered.standard_error = name_of_frame("--standard-error", options.standard_error, frame);
    numbered.film = name_of_frame("--film", options.film, frame);
    numbered.stats = name_of_frame("--stats", options.stats, frame);
    return numbered;
}

// Files appear whole or not at all.
bool is_done(const RenderOptions &frame) {
    const auto exists = [](const std::string &path) {
        std::error_code ignored;
        return path.empty() || std::filesystem::exists(path, ignored);
    };
    return std::all_of(frame.outputs.begin(), frame.outputs.end(), exists) && exists(frame.standard_error) &&
           exists(frame.film) && exists(frame.stats);
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
            if (options_.skip_existing && is_done(numbered))
                continue;
            const Outcome outcome = render(numbered, number);
            if (outcome == Outcome::not_all_written)
                return static_cast<int>(ExitCode::file);
            if (interrupt_signal() != 0) {
                print_message("stopped by " + interrupt_name() + " in frame " + std::to_string(number));
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
        SceneFile file = scene_of(frames.first);
        complete_scene(options_, file);
        return render_parts(options_, file, settings_of(options_, file, frames.first), log_);
    }

private:
    SceneFile scene_of(std::uint32_t frame) const {
        std::vector<SceneOverride> overrides = overrides_of_frame(scene_, frame);
        overrides.insert(overrides.end(), options_.overrides.begin(), options_.overrides.end());
        return parse_scene(text_.text, text_.path, overrides);
    }

    // The seed differs from frame to frame, or all would have the same noise, which would seem to stand before the
    // picture.
    static RenderSettings settings_of(const RenderOptions &options, const SceneFile &file, std::uint32_t frame) {
        RenderSettings settings = merge_settings(options, file);
        settings.render.seed += frame;
        return settings;
    }

    Outcome render(const RenderOptions &options, std::uint32_t frame) {
        RenderTimes times{};
        times.start = std::chrono::steady_clock::now();
        check_names(options);
        SceneFile file = scene_of(frame);
        complete_scene(options, file);
        const RenderSettings settings = settings_of(options, file, frame);
        check_outputs(options, settings);
        times.create_start = std::chrono::steady_clock::now();
        if (!context_) {
            catch_interrupts();
            catch_picture_requests(); // which nothing answers, but which are not to end it
            choose_vector_width();
            context_ = std::make_unique<Context>(render_create_info(options_, log_));
        }
        return render_picture(*context_, options, file, settings, times, [] { return interrupt_signal() != 0; });
    }

    const RenderOptions &options_;
    ValidationLog &log_;
    SceneText text_; // read once, so that all frames are of one scene
    SceneFile scene_;
    std::unique_ptr<Context> context_; // for all frames: kernels are kept
    bool is_target_missed_ = false;
};

} // namespace

int render_frames(const RenderOptions &options, ValidationLog &log) {
    FramesRender frames(options, log);
    return options.parts ? frames.parts() : frames.run();
}

} // namespace cli
