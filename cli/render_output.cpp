// Owns the outputs of a rendering: the checks before it, the images and the statistics after it.
// Called by render_command.
#include "render_output.h"

#include "atomic_file.h"
#include "exit_code.h"
#include "message.h"

#include <algorithm>

namespace cli {
namespace {

void write_image(ImageWriter &writer, const std::string &path, const ToneMap &tone_map, const RenderReport &report,
                 std::span<const float> radiance, const ImageMetadata &metadata) {
    const auto [width, height] = std::pair(report.render.width, report.render.height);
    if (image_format(path) == ImageFormat::exr) {
        writer.write_radiance(path, width, height, radiance, metadata.attributes());
    } else {
        writer.write_bytes(path, width, height, map_to_8_bits(radiance, tone_map), metadata.attributes());
    }
}

} // namespace

void check_extensions(const RenderOptions &options) {
    for (const std::string &path : options.outputs) {
        if (!image_format(path)) {
            throw Failure(ExitCode::usage, "-o " + path + ": the name must end in .exr, .png, .jpg or .jpeg");
        }
    }
}

void check_outputs(const RenderOptions &options, const RenderSettings &settings) {
    const std::uint32_t side = std::max(settings.render.width, settings.render.height);
    for (const std::string &path : options.outputs) {
        const std::uint32_t longest = longest_side(image_format(path).value());
        if (side > longest) {
            throw Failure(ExitCode::usage, "-o " + path + ": this format holds at most " + std::to_string(longest) +
                                               " pixels a side, not " + std::to_string(side));
        }
        AtomicFile::check_writable(path);
    }
    if (!options.stats.empty()) {
        AtomicFile::check_writable(options.stats);
    }
}

std::vector<std::string> write_images(ImageWriter &writer, const RenderOptions &options, const RenderReport &report,
                                      std::span<const float> radiance) {
    const ImageMetadata metadata(report);
    std::vector<std::string> written;
    for (const std::string &path : options.outputs) {
        try {
            write_image(writer, path, options.tone_map, report, radiance, metadata);
            written.push_back(path);
        } catch (const Failure &failure) {
            print_message(failure.what());
        }
    }
    return written;
}

void write_stats(const std::string &path, const RenderReport &report) {
    AtomicFile::write_text(path, stats_json(report).dump(2) + "\n");
}

} // namespace cli
