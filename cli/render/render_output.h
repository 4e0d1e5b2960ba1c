// The outputs of a rendering: checks before it, images after it.
#pragma once

#include "cli/base/distinct_files.h"
#include "cli/image/image_file.h"
#include "cli/render/picture_layer.h"
#include "cli/render/render_options.h"
#include "cli/render/render_report.h"
#include "cli/scene/render_settings.h"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace cli {

// With the values that --set gives in place of its own, but without the columns of files. Throws Failure.
SceneFile read_scene(const RenderOptions &options);

// Reads the files of columns, which no output may be. Throws Failure.
void complete_scene(const RenderOptions &options, SceneFile &scene);

// Throws Failure(ExitCode::usage) if an output's name tells no known format, or the output is another one or a source.
void check_names(const RenderOptions &options);

// The same for images that are not rendered but come from other files, which are to be kept.
void check_merged_names(const RenderOptions &options, const std::vector<NamedFile> &sources);

// Throws Failure if an image is too large for its format (ExitCode::usage), or a file cannot be written, as far as that
// can be known before (ExitCode::file). window: of the images.
void check_files(const RenderOptions &options, const ImageWindow &window);

// These files, and all else that can go wrong with the outputs and can be known before an hour of rendering.
void check_outputs(const RenderOptions &options, const RenderSettings &settings);

// What the files are made of.
struct PictureImages {
    std::span<const float> radiance;
    std::span<const float> standard_error; // may be empty if no file of it is wanted
    std::span<const PictureLayer> layers;  // that each .exr of radiance has too; .png takes the alpha of them
};

// How many there are.
std::uint32_t image_count(const RenderOptions &options);

// The layers that have to be read, that of alpha among them: PT_QUANTITY_*.
std::vector<std::uint32_t> wanted_layers(const RenderOptions &options);

// Writes every image that can be written even if another cannot, and says on stderr which could not. Returns the paths
// of those written, output_count() if all were.
std::vector<std::string> write_images(ImageWriter &writer, const RenderOptions &options, const RenderReport &report,
                                      const PictureImages &images);

// Writes a film. False if that is not possible, which is said on stderr.
bool write_film(const std::function<std::vector<std::byte>()> &film, const std::string &path);

// Whether any output is in a format that the image module encodes.
bool needs_module(const RenderOptions &options);

// Whether any is for a display.
bool needs_tone_map(const RenderOptions &options);

// Whether an image or the report goes there, so that lines for people do not.
bool takes_standard_output(const RenderOptions &options);

// With those images alone that go to files.
RenderOptions without_standard_output(RenderOptions options);

std::size_t output_count(const RenderOptions &options);

} // namespace cli
