// Converged images of other renderers, and the judgement of a render against one. Used by render_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct ReferenceImage {
    std::uint32_t width;
    std::uint32_t height;
    std::vector<float> radiance; // R, G, B per pixel
};

// Reads tests/reference/<name>.exr.
ReferenceImage read_reference(const std::string &name);

// Writes an EXR of R, G, B per pixel.
void write_image(const std::string &path, std::uint32_t width, std::uint32_t height,
                 const std::vector<float> &radiance);
