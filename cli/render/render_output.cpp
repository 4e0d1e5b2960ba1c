#include "cli/render/render_output.h"

#include "cli/base/abandoned_files.h"
#include "cli/base/atomic_file.h"
#include "cli/base/distinct_files.h"
#include "cli/base/exit_code.h"
#include "cli/base/host_memory.h"
#include "cli/base/message.h"
#include "cli/base/report_file.h"
#include "cli/film/film_file.h"
#include "cli/image/display_image.h"
#include "cli/image/image_target.h"
#include "cli/scene/source_files.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace cli {
namespace {

void write_image(ImageWriter &writer, const ImageTarget &target, const RenderOptions &options,
                 const RenderReport &report, std::span<const float> values, std::uint32_t quantity,
                 std::span<const PictureLayer> others) {
    if (target.format == ImageFormat::exr) {
        const ImageMetadata metadata(report, quantity, nullptr);
        std::vector<pt_image_layer> layers{{"", 3, PT_LAYER_COLOUR, values.data()}};
        std::transform(others.begin(), others.end(), std::back_inserter(layers),
                       [](const PictureLayer &other) { return other.in_file(); });
        writer.write_radiance(target, report.window, layers, metadata.attributes());
    } else {
        const ToneMap &tone_map = report.tone_map.value();
        const ImageMetadata metadata(report, quantity, &tone_map);
        const auto alpha = std::find_if(others.begin(), others.end(), [](const PictureLayer &other) {
            return other.quantity == PT_QUANTITY_COVERAGE;
        });
        write_display_image(writer, target, report.window, values, tone_map, options.display.png_bits,
                            metadata.attributes(), alpha == others.end() ? std::span<const float>() : alpha->values);
    }
}

// The first image of a format, or none.
std::optional<std::string> image_of(const RenderOptions &options, ImageFormat format) {
    const auto found = std::find_if(options.outputs.begin(), options.outputs.end(), [&](const std::string &path) {
        return (path == standard_stream ? options.format : image_format(path)) == format;
    });
    return found == options.outputs.end() ? std::nullopt : std::optional(*found);
}

void refuse_if(bool is_refused, const std::string &message) {
    if (is_refused)
        throw Failure(ExitCode::usage, message);
}

void check_channels(const RenderOptions &options) {
    refuse_if(!options.layers.empty() && !image_of(options, ImageFormat::exr),
              "--layers: needs -o FILE.exr, as no other format has layers");
    const std::optional<std::string> jpeg = image_of(options, ImageFormat::jpeg);
    refuse_if(options.alpha && jpeg, "--alpha: -o " + jpeg.value_or("") + ": JPEG has no alpha; .exr and .png have");
    refuse_if(options.alpha && options.outputs.empty(),
              "--alpha: needs -o FILE.exr or FILE.png, which have the channel");
}

// What only makes sense with something else, or without it.
void check_combinations(const RenderOptions &options) {
    const bool has_checkpoint = !options.checkpoint.empty();
    refuse_if(options.outputs.empty() && options.film.empty(), "-o or --film is missing: there is nothing to write");
    refuse_if(options.sampling == PT_SAMPLING_ADAPTIVE && !options.target_error, "--sampling adaptive: needs --error");
    refuse_if(options.resume && !has_checkpoint, "--resume: needs --checkpoint, the file to go on from");
    refuse_if(options.checkpoint_seconds && !has_checkpoint, "--checkpoint-every: needs --checkpoint");
    check_channels(options);
    refuse_if(options.watch && has_checkpoint, "--checkpoint: a picture under --watch has none");
    refuse_if(options.watch && !options.film.empty(), "--film: a picture under --watch has none");
    refuse_if(options.frames && has_checkpoint,
              "--checkpoint: --frames have none; --skip-existing goes on after the frames that are done");
    refuse_if(options.frames && options.preview_seconds,
              "--preview-every: --frames have none, as --skip-existing takes a file that is there for a frame that is "
              "done");
    refuse_if(options.preview_seconds && output_count(without_standard_output(options)) == 0,
              "--preview-every: needs the name of a file, which -o gives");
}

void check_file_names(const RenderOptions &options) {
    for (const auto &[option, path] : {NamedFile{"--standard-error", options.standard_error},
                                       {"--film", options.film},
                                       {"--checkpoint", options.checkpoint}}) {
        refuse_if(path == standard_stream, option + " -: goes to a file, not to standard output; give its name");
    }
    const std::string &path = options.standard_error;
    refuse_if(!path.empty() && image_format(path) != ImageFormat::exr,
              "--standard-error " + path + ": the name must end in .exr");
}

// A checkpoint of hours is not replaced by one of seconds unless that goes on from it. One that cannot be written costs
// itself and not the rendering, which says so when it tries.
void check_checkpoint(const RenderOptions &options) {
    if (options.checkpoint.empty())
        return;
    std::error_code ignored;
    const bool is_there = std::filesystem::exists(options.checkpoint, ignored);
    if (is_there && !options.resume) {
        throw Failure(ExitCode::usage, "--checkpoint " + options.checkpoint +
                                           ": is there already; go on from it by --resume, or remove it");
    }
    remove_abandoned(AtomicFile::target_of(options.checkpoint).parent_path());
}

std::vector<NamedFile> outputs_of(const RenderOptions &options) {
    std::vector<NamedFile> outputs;
    for (const std::string &path : options.outputs)
        outputs.push_back({"-o", path});
    outputs.push_back({"--standard-error", options.standard_error});
    outputs.push_back({"--film", options.film});
    outputs.push_back({"--checkpoint", options.checkpoint});
    outputs.push_back({"--stats", options.stats});
    return outputs;
}

void check_sources_are_kept(const RenderOptions &options) {
    std::vector<NamedFile> sources{{"the scene", options.scene}};
    for (const auto &[path, contents] : read_shader_files(options.shader_dir))
        sources.push_back({"the shader", path});
    const std::vector<NamedFile> outputs = outputs_of(options);
    require_distinct_files(sources, outputs);
    if (!options.shader_dir.empty())
        require_outside({"--shader-dir", options.shader_dir}, outputs);
}

} // namespace

SceneFile read_scene(const RenderOptions &options) {
    const SceneText scene = read_scene_text(options.scene);
    return parse_scene(scene.text, scene.path, options.overrides);
}

void complete_scene(const RenderOptions &options, SceneFile &scene) {
    std::vector<NamedFile> sources;
    for (const std::string &path : column_paths(scene))
        sources.push_back({"a column of spheres", path});
    require_distinct_files(sources, outputs_of(options));
    load_columns(scene);
}

void check_names(const RenderOptions &options) {
    check_combinations(options);
    check_image_names(options.outputs, options.format);
    check_file_names(options);
    check_sources_are_kept(options);
}

void check_merged_names(const RenderOptions &options, const std::vector<NamedFile> &sources) {
    check_image_names(options.outputs, options.format);
    check_file_names(options);
    require_distinct_files(sources, outputs_of(options));
}

void check_files(const RenderOptions &options, const ImageWindow &window) {
    for (const std::string &path : options.outputs)
        check_image_target(image_target(path, options.format), window);
    for (const std::string *path : {&options.standard_error, &options.film})
        if (!path->empty())
            AtomicFile::check_writable(*path);
    check_report_file(options.stats);
}

void check_outputs(const RenderOptions &options, const RenderSettings &settings) {
    require_host_memory(settings, options.scene, image_count(options));
    check_files(options, settings.window);
    check_checkpoint(options);
}

std::uint32_t image_count(const RenderOptions &options) {
    return 1 + (options.standard_error.empty() ? 0 : 1) + static_cast<std::uint32_t>(wanted_layers(options).size());
}

std::vector<std::uint32_t> wanted_layers(const RenderOptions &options) {
    std::vector<std::uint32_t> layers = options.layers;
    if (options.alpha)
        layers.push_back(PT_QUANTITY_COVERAGE);
    return layers;
}

RenderOptions without_standard_output(RenderOptions options) {
    std::erase(options.outputs, standard_stream);
    return options;
}

bool write_film(const std::function<std::vector<std::byte>()> &film, const std::string &path) {
    try {
        write_film_file(path, film());
        return true;
    } catch (const Failure &failure) {
        if (failure.code() != ExitCode::file)
            throw;
        print_message(failure.what());
        return false;
    }
}

std::vector<std::string> write_images(ImageWriter &writer, const RenderOptions &options, const RenderReport &report,
                                      const PictureImages &images) {
    std::vector<std::string> written;
    const auto write = [&](const std::string &path, std::span<const float> values, std::uint32_t quantity,
                           std::span<const PictureLayer> layers) {
        try {
            write_image(writer, image_target(path, options.format), options, report, values, quantity, layers);
            written.push_back(path == standard_stream ? "standard output" : path);
        } catch (const Failure &failure) {
            print_message(failure.what());
        }
    };
    for (const std::string &path : options.outputs)
        write(path, images.radiance, PT_QUANTITY_RADIANCE, images.layers);
    if (!options.standard_error.empty())
        write(options.standard_error, images.standard_error, PT_QUANTITY_STANDARD_ERROR, {});
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
