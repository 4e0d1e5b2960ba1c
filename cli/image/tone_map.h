#pragma once

#include "cli/image/image_file.h"

#include <pt/display.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {

// display.exposure is a number, even if the exposure is automatic.
struct ToneMap {
    pt_display_info display;
    bool is_automatic = false;
};

ToneMap tone_map_for(pt_display_info display, std::span<const float> radiance);

double automatic_exposure(std::span<const float> radiance);

// Calls pt_display on all processors.
std::vector<std::uint8_t> map_to_bytes(std::span<const float> radiance, const ToneMap &map,
                                       std::span<const float> alpha = {});

nlohmann::ordered_json tone_map_json(const std::optional<ToneMap> &tone_map);

void add_tone_map(std::vector<ImageAttribute> &attributes, const ToneMap &tone_map);

std::string automatic_exposure_line(const std::optional<ToneMap> &tone_map);

// `radiance` has nonnegative R, G, B, multiplied by alpha. `alpha` has one number per pixel, or is empty. Fails as
// ImageWriter::write() does.
void write_display_image(ImageWriter &writer, const ImageTarget &target, ImageData image,
                         std::span<const float> radiance, const ToneMap &tone_map, std::span<const float> alpha = {});

} // namespace cli
