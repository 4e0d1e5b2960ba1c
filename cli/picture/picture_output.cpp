#include "cli/picture/picture_output.h"

#include "cli/base/text.h"
#include "cli/film/film.h"
#include "cli/image/tone_map.h"

#include <algorithm>

namespace cli {
namespace {

void write_image(ImageWriter &writer, const ImageTarget &target, const RenderReport &report,
                 const RenderedImage &rendered) {
    const ToneMap *tone_map = target.format.is_radiance ? nullptr : &report.tone_map.value();
    const std::vector<ImageAttribute> attributes = image_metadata(report, tone_map);
    ImageData image{.window = report.window, .attributes = attributes};
    if (tone_map == nullptr) {
        std::vector<ImageLayer> layers{{"", LayerKind::color, 3, rendered.radiance}};
        if (!rendered.raw.empty())
            layers.push_back({"raw", LayerKind::color, 3, rendered.raw});
        for (const PictureLayer &other : rendered.layers)
            layers.push_back(other.in_file());
        image.layers = layers;
        writer.write(target, image);
    } else {
        const auto alpha =
            std::ranges::find(rendered.layers, std::uint32_t{PT_QUANTITY_COVERAGE}, &PictureLayer::quantity);
        write_display_image(writer, target, image, rendered.radiance, *tone_map,
                            alpha == rendered.layers.end() ? std::span<const float>() : alpha->values);
    }
}

bool succeeds(const std::function<void()> &write) {
    try {
        write();
        return true;
    } catch (const Failure &failure) {
        print_message(failure.what());
        return false;
    }
}

template <typename Predicate>
bool has_format(const OutputOptions &options, Predicate holds) {
    return std::ranges::any_of(options.targets(), holds, &ImageTarget::format);
}

void check_alpha(const OutputOptions &options) {
    for (const ImageTarget &target : options.targets())
        refuse_if(options.alpha && !target.format.has_alpha,
                  concat("--alpha: -o ", target.path, ": .", target.format.name, " has no alpha; ",
                         extensions(&ImageFormat::has_alpha, " and "), " have"));
    refuse_if(options.alpha && options.images.empty() && options.film.empty(),
              "--alpha: needs --film, or -o and a name in " + extensions(&ImageFormat::has_alpha, " or ") +
                  ", which have an alpha channel");
}

} // namespace

std::vector<NamedFile> outputs_of(const OutputOptions &options, const std::string &checkpoint) {
    std::vector<NamedFile> outputs{{"--checkpoint", checkpoint}};
    for_each_output(options, [&](const char *option, const std::string &path) { outputs.push_back({option, path}); });
    return outputs;
}

void check_names(const OutputOptions &options, const std::vector<NamedFile> &sources) {
    check_image_names(options.images, options.format);
    refuse_if(options.film == standard_stream, "--film -: goes to a file, not to standard output; give its name");
    refuse_if(!options.layers.empty() && !has_format(options, &ImageFormat::is_radiance),
              "--layers: needs -o and a name in " + extensions(&ImageFormat::is_radiance, " or ") +
                  ", because no other format has layers");
    check_alpha(options);
    require_distinct_files(sources, outputs_of(options));
}

void check_files(const OutputOptions &options, const ImageWindow &window) {
    for (const ImageTarget &target : options.targets())
        check_image_target(target, window);
    if (!options.film.empty())
        AtomicFile::check_writable(options.film);
    check_report_file(options.stats);
}

OutputOptions without_standard_output(OutputOptions options) {
    std::erase(options.images, standard_stream);
    return options;
}

bool write_film(const std::string &path, std::span<const std::byte> film) {
    return succeeds([&] { write_film_file(path, film); });
}

std::vector<std::string> write_images(ImageWriter &writer, const OutputOptions &options, const RenderReport &report,
                                      const RenderedImage &image) {
    std::vector<std::string> written;
    for (const ImageTarget &target : options.targets())
        if (succeeds([&] { write_image(writer, target, report, image); }))
            written.push_back(target.path == standard_stream ? "standard output" : target.path);
    return written;
}

bool needs_module(const OutputOptions &options) {
    return has_format(options, &ImageFormat::needs_module);
}

bool needs_tone_map(const OutputOptions &options) {
    return has_format(options, is_for_displays);
}

} // namespace cli
