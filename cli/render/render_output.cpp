#include "cli/render/render_output.h"

#include "cli/base/abandoned_files.h"
#include "cli/base/atomic_file.h"
#include "cli/base/distinct_files.h"
#include "cli/base/exit_code.h"
#include "cli/base/host_memory.h"
#include "cli/base/message.h"
#include "cli/base/report_file.h"
#include "cli/film/film_file.h"
#include "cli/scene/source_files.h"

#include <algorithm>
#include <filesystem>

namespace cli {
namespace {

void write_image(ImageWriter &writer, const std::string &path, const RenderReport &report,
                 std::span<const float> values, std::uint32_t quantity) {
    const auto [width, height] = std::pair(report.render.width, report.render.height);
    if (image_format(path) == ImageFormat::exr) {
        const ImageMetadata metadata(report, quantity, nullptr);
        writer.write_radiance(path, width, height, values, metadata.attributes());
    } else {
        const ToneMap &tone_map = report.tone_map.value();
        const ImageMetadata metadata(report, quantity, &tone_map);
        writer.write_bytes(path, width, height, map_to_8_bits(values, tone_map), metadata.attributes(), tone_map.gamma);
    }
}

void refuse_standard_output(const std::string &option, std::span<const std::string> paths) {
    if (std::find(paths.begin(), paths.end(), standard_stream) != paths.end()) {
        throw Failure(ExitCode::usage, option + " -: images are not written to standard output; give a file's name");
    }
}

// What only makes sense with something else, or without it.
void check_combinations(const RenderOptions &options) {
    const auto refuse_if = [](bool is_refused, const std::string &message) {
        if (is_refused) {
            throw Failure(ExitCode::usage, message);
        }
    };
    const bool has_checkpoint = !options.checkpoint.empty();
    refuse_if(options.outputs.empty() && options.film.empty(), "-o or --film is missing: there is nothing to write");
    refuse_if(options.resume && !has_checkpoint, "--resume: needs --checkpoint, the file to go on from");
    refuse_if(options.checkpoint_seconds && !has_checkpoint, "--checkpoint-every: needs --checkpoint");
    refuse_if(options.watch && has_checkpoint, "--checkpoint: a picture under --watch has none");
    refuse_if(options.watch && !options.film.empty(), "--film: a picture under --watch has none");
}

void check_extensions(const RenderOptions &options) {
    refuse_standard_output("-o", options.outputs);
    refuse_standard_output("--standard-error", {&options.standard_error, 1});
    refuse_standard_output("--film", {&options.film, 1});
    refuse_standard_output("--checkpoint", {&options.checkpoint, 1});
    for (const std::string &path : options.outputs) {
        if (!image_format(path)) {
            throw Failure(ExitCode::usage, "-o " + path + ": the name must end in .exr, .png, .jpg or .jpeg");
        }
    }
    const std::string &path = options.standard_error;
    if (!path.empty() && image_format(path) != ImageFormat::exr) {
        throw Failure(ExitCode::usage, "--standard-error " + path + ": the name must end in .exr");
    }
}

// Whether all files can be written, as far as that can be known before.
void check_files(const RenderOptions &options) {
    for (const std::string &path : options.outputs) {
        AtomicFile::check_writable(path);
    }
    for (const std::string *path : {&options.standard_error, &options.film}) {
        if (!path->empty()) {
            AtomicFile::check_writable(*path);
        }
    }
    check_report_file(options.stats);
}

// A checkpoint of hours is not replaced by one of seconds unless that goes on from it. One that cannot be written costs
// itself and not the rendering, which says so when it tries.
void check_checkpoint(const RenderOptions &options) {
    if (options.checkpoint.empty()) {
        return;
    }
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
    for (const std::string &path : options.outputs) {
        outputs.push_back({"-o", path});
    }
    outputs.push_back({"--standard-error", options.standard_error});
    outputs.push_back({"--film", options.film});
    outputs.push_back({"--checkpoint", options.checkpoint});
    outputs.push_back({"--stats", options.stats});
    return outputs;
}

void check_sources_are_kept(const RenderOptions &options) {
    std::vector<NamedFile> sources{{"the scene", options.scene}};
    for (const auto &[path, contents] : read_shader_files(options.shader_dir)) {
        sources.push_back({"the shader", path});
    }
    const std::vector<NamedFile> outputs = outputs_of(options);
    require_distinct_files(sources, outputs);
    if (!options.shader_dir.empty()) {
        require_outside({"--shader-dir", options.shader_dir}, outputs);
    }
}

} // namespace

void check_names(const RenderOptions &options) {
    check_combinations(options);
    check_extensions(options);
    check_sources_are_kept(options);
}

void check_outputs(const RenderOptions &options, const RenderSettings &settings) {
    require_host_memory(settings, options.scene, options.standard_error.empty() ? 1 : 2);
    const std::uint32_t side = std::max(settings.render.width, settings.render.height);
    for (const std::string &path : options.outputs) {
        const std::uint32_t longest = longest_side(image_format(path).value());
        if (side > longest) {
            throw Failure(ExitCode::usage, "-o " + path + ": this format holds at most " + std::to_string(longest) +
                                               " pixels a side, not " + std::to_string(side));
        }
    }
    check_files(options);
    check_checkpoint(options);
}

void check_merged_outputs(const RenderOptions &options, const std::vector<NamedFile> &sources) {
    check_extensions(options);
    require_distinct_files(sources, outputs_of(options));
    check_files(options);
}

bool write_film(const std::function<std::vector<std::byte>()> &film, const std::string &path) {
    try {
        write_film_file(path, film());
        return true;
    } catch (const Failure &failure) {
        if (failure.code() != ExitCode::file) {
            throw;
        }
        print_message(failure.what());
        return false;
    }
}

std::vector<std::string> write_images(ImageWriter &writer, const RenderOptions &options, const RenderReport &report,
                                      std::span<const float> radiance, std::span<const float> standard_error) {
    std::vector<std::string> written;
    const auto write = [&](const std::string &path, std::span<const float> values, std::uint32_t quantity) {
        try {
            write_image(writer, path, report, values, quantity);
            written.push_back(path);
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
    const auto is_png = [](const std::string &path) { return image_format(path) == ImageFormat::png; };
    return !options.standard_error.empty() || !std::all_of(options.outputs.begin(), options.outputs.end(), is_png);
}

std::size_t output_count(const RenderOptions &options) {
    return options.outputs.size() + (options.standard_error.empty() ? 0 : 1);
}

} // namespace cli
