// From linear radiance to a file for a display: tone map, encoding, bits of a channel, metadata. One way for pictures
// that are rendered and for those made of a file of radiance, so that both have the same bits.
#pragma once

#include "cli/image/image_attributes.h"
#include "cli/image/image_file.h"
#include "cli/image/tone_map.h"

#include <cstdint>
#include <span>

namespace cli {

// What is done to the radiance, for the metadata.
void add_tone_map(ImageAttributes &attributes, const ToneMap &tone_map);

// "exposure -3.13 EV (auto)" and the end of the line.
std::string automatic_exposure_line(const ToneMap &tone_map);

// radiance: R, G, B triples of the window's part, >= 0. png_bits: of a channel, 8 or 16; JPEG has 8. alpha: of each
// pixel, by which its radiance is multiplied already; empty for none, and for JPEG. Throws Failure(ExitCode::file), and
// leaves an existing file as it was.
void write_display_image(ImageWriter &writer, const ImageTarget &target, const ImageWindow &window,
                         std::span<const float> radiance, const ToneMap &tone_map, std::uint32_t png_bits,
                         std::span<const pt_image_attribute> attributes, std::span<const float> alpha = {});

} // namespace cli
