// The outputs of a rendering: checks before, files after.
#pragma once

#include "cli/base/file.h"
#include "cli/image/image_file.h"
#include "cli/render/picture_layer.h"
#include "cli/render/render_options.h"
#include "cli/render/render_report.h"
#include "cli/render/render_task.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace cli {

// The files to be written, with the options that name them.
std::vector<NamedFile> outputs_of(const OutputOptions &options, const std::string &checkpoint = "");

// Throws Failure(ExitCode::usage) if options contradict each other, an output's name has no known format, or an output
// is also another output or a source.
void check_names(const RenderOptions &options);

// For images made from other files, which must not be overwritten.
void check_names(const OutputOptions &options, const std::vector<NamedFile> &sources);

// Throws Failure if an image is too large for its format (ExitCode::usage) or, as far as can be known now, a file
// cannot be written (ExitCode::file). window: of the images.
void check_files(const OutputOptions &options, const ImageWindow &window);

// Checks all that can be known about the outputs before rendering.
void check_outputs(const RenderTask &task);

// Writes every image that can be written, and reports the others on stderr. Returns the paths written.
std::vector<std::string> write_images(ImageWriter &writer, const OutputOptions &options, const RenderReport &report,
                                      const RenderedImage &image);

// On failure prints a message on stderr and returns false.
bool write_film(const std::string &path, std::span<const std::byte> film);

// Whether an output needs the image module to encode it, and whether one is for displays.
bool needs_module(const OutputOptions &options);
bool needs_tone_map(const OutputOptions &options);

// Keeps only images that go to files.
OutputOptions without_standard_output(OutputOptions options);

} // namespace cli
