#include "cli/base/file.h"
#include "cli/base/interrupt.h"
#include "cli/base/text.h"
#include "cli/render/render_checks.h"
#include "cli/render/render_command.h"
#include "cli/render/source_watch.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>

namespace cli {
namespace {

// A signal that comes just before a wait is noticed at most this much later.
constexpr std::chrono::milliseconds patience{200};

// Pipes can be read only once.
void require_files(const RenderOptions &options) {
    const std::vector<std::string> &images = options.output.images;
    refuse_if(options.frames.has_value(), "--watch: cannot be used with --frames");
    refuse_if(std::ranges::find(images, standard_stream) != images.end(),
              "-o -: --watch needs a file, not standard output");
    refuse_if(options.scene == standard_stream, "the scene -: --watch needs a file, not standard input");
    std::error_code ignored;
    refuse_if(std::filesystem::exists(options.scene, ignored) &&
                  !std::filesystem::is_regular_file(options.scene, ignored),
              options.scene + ": not a regular file, which --watch needs");
}

class WatchedRender {
public:
    WatchedRender(const RenderOptions &options, ValidationLog &log) :
        options_(options),
        log_(log),
        sources_(options.scene, options.shader_dir) {}

    int run() {
        for (;;) {
            sources_.begin();
            render_or_tell();
            tell_once_what_is_watched();
            do {
                if (interrupt_signal() != 0)
                    return exit_code();
            } while (!sources_.changed(patience));
            tell_changes();
        }
    }

private:
    // A signal that ends a waiting watch means success.
    int exit_code() const { return exit_code_of(outcome_, outcome_ == ExitCode::signal ? interrupt_signal() : 0); }

    // After a failure that an edit can repair, waits for the edit. Edited shaders may lose the device, so the next
    // picture gets a new context.
    void render_or_tell() {
        outcome_ = ExitCode::done;
        try {
            render();
        } catch (const Failure &failure) {
            const bool loses_work = failure.code() == ExitCode::device_lost || failure.code() == ExitCode::internal;
            const bool is_source = failure.code() == ExitCode::scene || (loses_work && !options_.shader_dir.empty());
            if (!is_source && (loses_work || is_first_))
                throw;
            print_message(failure.what());
            if (loses_work) {
                tell_suspects();
                context_.reset();
            }
        }
        is_first_ = false;
    }

    void render() {
        RenderTimes times;
        check_names(options_);
        RenderTask task(options_, read_scene_file(options_.scene, options_.overrides));
        const std::vector<std::string> columns = pt::column_paths(task.scene);
        sources_.follow({columns.begin(), columns.end()});
        task.load();
        check_outputs(task);
        times.create_start = std::chrono::steady_clock::now();
        refresh_context(task);
        const auto superseded = [this] { return sources_.changed(std::chrono::milliseconds{0}); };
        outcome_ = render_picture(*context_, task, times, superseded);
        if (outcome_ == ExitCode::done || outcome_ == ExitCode::target_missed)
            edited_.clear();
    }

    // A context takes longer than most renderings.
    void refresh_context(const RenderTask &task) {
        if (!context_) {
            context_.emplace(render_create_info(options_, log_), kernel_use(task));
        } else if (!options_.shader_dir.empty()) {
            context_->reload_shaders();
        }
    }

    void print_unless_quiet(const std::string &message) const {
        if (!options_.output.quiet)
            print_message(message);
    }

    void tell_once_what_is_watched() {
        if (!std::exchange(is_told_, true) && !options_.output.quiet) {
            const std::string data = sources_.has_data() ? " and its columns" : "";
            const std::string shaders = options_.shader_dir.empty() ? "" : " and the shaders in " + options_.shader_dir;
            print_for_people("watching " + options_.scene + data + shaders + "; Ctrl-C ends\n",
                             options_.output.stats == standard_stream);
        }
    }

    void tell_changes() {
        const std::vector<std::string> names = sources_.changed_names();
        edited_.insert(names.begin(), names.end());
        print_unless_quiet("changed: " + listed(names));
    }

    void tell_suspects() const {
        if (!edited_.empty())
            print_message("the likely cause: " + listed(edited_) + ", edited since the last picture");
    }

    const RenderOptions &options_;
    ValidationLog &log_;
    SourceWatch sources_;
    std::optional<Context> context_;
    ExitCode outcome_ = ExitCode::done;
    std::set<std::string> edited_;
    bool is_first_ = true;
    bool is_told_ = false;
};

} // namespace

int render_watched(const RenderOptions &options, ValidationLog &log) {
    require_files(options);
    catch_signals();
    return WatchedRender(options, log).run();
}

} // namespace cli
