// Writes pictures to files, and checks these files beforehand.
#pragma once

#include "cli/base/file.h"
#include "cli/picture/output_options.h"
#include "cli/picture/picture_layer.h"
#include "cli/picture/render_report.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace cli {

std::vector<NamedFile> outputs_of(const OutputOptions &options, const std::string &checkpoint = "");

// Throws Failure(ExitCode::usage) for options that contradict each other, unknown formats, and outputs that are also
// sources or other outputs.
void check_names(const OutputOptions &options, const std::vector<NamedFile> &sources);

// Throws Failure if an image is too large for its format, or if an output file cannot be written.
void check_files(const OutputOptions &options, const ImageWindow &window);

// Reports failures on stderr. Returns the written paths.
std::vector<std::string> write_images(ImageWriter &writer, const OutputOptions &options, const RenderReport &report,
                                      const RenderedImage &image);

bool write_film(const std::string &path, std::span<const std::byte> film);

bool needs_module(const OutputOptions &options);
bool needs_tone_map(const OutputOptions &options);

OutputOptions without_standard_output(OutputOptions options);

} // namespace cli
