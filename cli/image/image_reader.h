// Reads images by the module of image_module.h.
#pragma once

#include "cli/image/image_attributes.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cli {

// What a file holds.
struct DecodedImage {
    std::string path;
    std::int32_t x; // where the pixels begin in the picture; may lie outside of it
    std::int32_t y;
    std::uint32_t width; // of the pixels
    std::uint32_t height;
    std::uint32_t full_width; // of the picture
    std::uint32_t full_height;
    bool is_float;                     // otherwise whole numbers, as displays take them, scaled to [0, 1]
    std::vector<std::string> channels; // their names
    std::vector<float> values;         // channel by channel of a pixel, row by row from the top
    std::unique_ptr<ImageAttributes> attributes;

    // Three values a pixel: the channels R, G and B of a layer, or X, Y and Z, or three times its only one. The main
    // layer has no name. Throws Failure(ExitCode::file) if there is none of that name.
    std::vector<float> layer(const std::string &name) const;
};

// Throws Failure: ExitCode::file if it cannot be read, or without the module.
DecodedImage read_image(const std::string &path);

struct RadianceImage {
    std::uint32_t width;
    std::uint32_t height;
    std::vector<float> radiance; // R, G, B of each pixel, row by row from the top
};

// The main layer. Throws Failure like read_image.
RadianceImage read_radiance(const std::string &path);

} // namespace cli
