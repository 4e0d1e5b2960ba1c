// Encodes PNG images by libpng, without OpenImageIO, whose module takes 0.2 s and 200 MB to load.
#pragma once

#include "cli/image/image_module.h"

#include <vector>

namespace cli {

// The whole file: image.bytes or image.words, and the attributes as text chunks. Throws std::runtime_error.
std::vector<unsigned char> encode_png(const ImageData &image);

} // namespace cli
