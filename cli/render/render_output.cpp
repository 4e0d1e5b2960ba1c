#include "cli/render/render_output.h"

#include "cli/base/atomic_file.h"
#include "cli/base/distinct_files.h"
#include "cli/base/exit_code.h"
#include "cli/base/host_memory.h"
#include "cli/base/message.h"
#include "cli/base/report_file.h"
#include "cli/image/display_image.h"
#include "cli/image/image_target.h"
#include "cli/scene/source_files.h"

#include <algorithm>

namespace cli {
namespace {

void write_image(ImageWriter &writer, const ImageTarget &target, const RenderOptions &options,
                 const RenderReport &report, std::span<const float> values, std::uint32_t quantity) {
    if (target.format == ImageFormat::exr) {
        const ImageMetadata metadata(report, quantity, nullptr);
        const pt_image_layer layer{"", 3, 0, values.data()};
        writer.write_radiance(target, report.window, {&layer, 1}, metadata.attributes());
    } else {
        const ToneMap &tone_map = report.tone_map.value();
        const ImageMetadata metadata(report, quantity, &tone_map);
        write_display_image(writer, target, report.window, values, tone_map, options.display.png_bits,
                            metadata.attributes());
    }
}

void check_standard_error_name(const std::string &path) {
    if (path == standard_stream) {
        throw Failure(ExitCode::usage, "--standard-error -: goes to a file, whose name ends in .exr");
    }
    if (!path.empty() && image_format(path) != ImageFormat::exr) {
        throw Failure(ExitCode::usage, "--standard-error " + path + ": the name must end in .exr");
    }
}

void check_sources_are_kept(const RenderOptions &options) {
    std::vector<NamedFile> sources{{"the scene", options.scene}};
    for (const auto &[path, contents] : read_shader_files(options.shader_dir)) {
        sources.push_back({"the shader", path});
    }
    std::vector<NamedFile> outputs;
    for (const std::string &path : options.outputs) {
        outputs.push_back({"-o", path});
    }
    outputs.push_back({"--standard-error", options.standard_error});
    outputs.push_back({"--stats", options.stats});
    require_distinct_files(sources, outputs);
    if (!options.shader_dir.empty()) {
        require_outside({"--shader-dir", options.shader_dir}, outputs);
    }
}

} // namespace

SceneFile read_scene(const RenderOptions &options) {
    const SceneText scene = read_scene_text(options.scene);
    return parse_scene(scene.text, scene.path, options.overrides);
}

void check_names(const RenderOptions &options) {
    check_image_names(options.outputs, options.format);
    check_standard_error_name(options.standard_error);
    check_sources_are_kept(options);
}

void check_outputs(const RenderOptions &options, const RenderSettings &settings) {
    require_host_memory(settings, options.scene, options.standard_error.empty() ? 1 : 2);
    for (const std::string &path : options.outputs) {
        check_image_target(image_target(path, options.format), settings.window);
    }
    if (!options.standard_error.empty()) {
        AtomicFile::check_writable(options.standard_error);
    }
    check_report_file(options.stats);
}

std::vector<std::string> write_images(ImageWriter &writer, const RenderOptions &options, const RenderReport &report,
                                      std::span<const float> radiance, std::span<const float> standard_error) {
    std::vector<std::string> written;
    const auto write = [&](const std::string &path, std::span<const float> values, std::uint32_t quantity) {
        try {
            write_image(writer, image_target(path, options.format), options, report, values, quantity);
            written.push_back(path == standard_stream ? "standard output" : path);
        } catch (const Failure &failure) {
            print_message(failure.what());
        }
    };
    for (const std::string &path : options.outputs) {
        write(path, radiance, PT_QUANTITY_RADIANCE);
    }
    if (!options.standard_error.empty()) {
        write(options.standard_error, standard_error, PT_QUANTITY_STANDARD_ERROR);
    }
    return written;
}

bool needs_module(const RenderOptions &options) {
    const auto is_png = [&](const std::string &path) {
        return image_target(path, options.format).format == ImageFormat::png;
    };
    return !options.standard_error.empty() || !std::all_of(options.outputs.begin(), options.outputs.end(), is_png);
}

bool needs_tone_map(const RenderOptions &options) {
    return std::any_of(options.outputs.begin(), options.outputs.end(), [&](const std::string &path) {
        return image_target(path, options.format).format != ImageFormat::exr;
    });
}

bool takes_standard_output(const RenderOptions &options) {
    return options.stats == standard_stream ||
           std::find(options.outputs.begin(), options.outputs.end(), standard_stream) != options.outputs.end();
}

std::size_t output_count(const RenderOptions &options) {
    return options.outputs.size() + (options.standard_error.empty() ? 0 : 1);
}

} // namespace cli
