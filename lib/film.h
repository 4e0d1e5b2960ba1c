// The film: exact sums of samples on the device, in strips, and their read-out to radiance. Owned by Renderer.
#pragma once

#include "gpu_layout.h"
#include "vulkan/buffer.h"
#include "vulkan/device.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// An unsigned 128-bit fixed-point sum, words from the least significant, to double; one rounding to 53 bits.
double sum_of_words(const std::uint32_t words[gpu::FILM_SUM_WORDS]);

// Mean radiance of consecutive pixels from their film words (planes of plane_pixels words, gpu_layout.h), as R, G, B per
// pixel. Every pixel must hold expected_samples, accepted or rejected: else PT_ERROR_INTERNAL, which tells that a driver
// lost work. A pixel all of whose samples were rejected is black.
void mean_radiance(std::span<const std::uint32_t> words, std::size_t plane_pixels, double unit,
                   std::uint32_t expected_samples, std::span<float> radiance);

class Film {
public:
    // As many consecutive pixels, row by row, as fit into one binding.
    struct Strip {
        std::uint32_t first_pixel;
        std::uint32_t pixel_count;
        vulkan::Buffer words; // gpu::FILM_WORDS planes
        vulkan::Buffer pass;  // one vec4 per pixel: samples of a split pass
    };

    static constexpr std::uint64_t bytes_per_pixel = gpu::FILM_WORDS * sizeof(std::uint32_t) + sizeof(glm::vec4);

    // Zeroed. Throws PT_ERROR_OUT_OF_DEVICE_MEMORY, or PT_ERROR_UNSUPPORTED for sizes beyond the device.
    Film(vulkan::Device &device, std::uint32_t width, std::uint32_t height, std::uint32_t max_strip_pixels);

    std::uint32_t pixel_count() const { return width_ * height_; }
    std::vector<Strip> &strips() { return strips_; }

    void clear();

    // Rows lie row_floats apart.
    void read_radiance(double unit, std::uint32_t expected_samples, float *data, std::size_t row_floats);

    std::uint64_t rejected_samples();

private:
    std::uint32_t width_;
    std::uint32_t height_;
    std::vector<Strip> strips_;
};

// The largest strip that a device can bind, in pixels.
std::uint32_t max_strip_pixels(const vulkan::Limits &limits);

} // namespace pt
