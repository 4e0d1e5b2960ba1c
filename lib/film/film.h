// The film: exact sums of samples on the device, in strips, and their read-out to radiance and its error. Owned by
// RenderDevice.
#pragma once

#include "lib/film/sample_parts.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/device.h"
#include "shaders/gpu_layout.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace pt {

// What the samples say about consecutive pixels, as R, G, B per pixel.
struct PixelEstimates {
    std::vector<float> radiance;       // mean of all samples; black where all were rejected
    std::vector<float> standard_error; // of that mean, from the difference of its parts; infinity where one is empty;
                                       // nothing if it was not asked for
    std::uint64_t rejected = 0;        // samples left out of these pixels
};

// Reads the film words of consecutive pixels (both parts, planes of plane_pixels words, gpu_layout.h). A pixel that
// does not hold the expected samples, accepted or rejected, is PT_ERROR_INTERNAL, which tells that a driver lost
// work.
PixelEstimates pixel_estimates(std::span<const std::uint32_t> words, std::size_t plane_pixels, double unit,
                               const PartCounts &expected, bool with_standard_error);

class Film {
public:
    // As many consecutive pixels, row by row, as fit into one binding.
    struct Strip {
        std::uint32_t first_pixel;
        std::uint32_t pixel_count;
        vulkan::Buffer words; // gpu::FILM_WORDS planes of each part
        vulkan::Buffer pass;  // one vec4 per pixel: samples of a split pass
    };

    static constexpr std::uint64_t words_per_pixel = std::uint64_t{gpu::FILM_PARTS} * gpu::FILM_WORDS;
    static constexpr std::uint64_t bytes_per_pixel = words_per_pixel * sizeof(std::uint32_t) + sizeof(glm::vec4);

    // Holds nothing of meaning before all its pixels are cleared. Throws PT_ERROR_OUT_OF_DEVICE_MEMORY, or PT_ERROR_UNSUPPORTED for
    // sizes beyond the device.
    Film(vulkan::Device &device, std::uint32_t width, std::uint32_t height, std::uint32_t max_strip_pixels);

    std::uint32_t pixel_count() const { return width_ * height_; }
    std::vector<Strip> &strips() { return strips_; }

    // Records that pixels are emptied, all of them together before the first sample comes: of how many of them the
    // words are those of which pixel does not matter.
    void clear(const vk::raii::CommandBuffer &commands, std::uint32_t first_pixel, std::uint32_t pixel_count);

    // The samples before this one that the film has, it has in part 0. Raised when its parts are folded.
    std::uint32_t older_end() const { return older_end_; }
    void set_older_end(std::uint32_t sample) { older_end_ = sample; }

    // Reads the words of consecutive pixels, plane after plane of pixel_count words.
    void download(std::uint32_t first_pixel, std::uint32_t pixel_count, std::span<std::uint32_t> words);

    std::uint64_t rejected_samples();

private:
    std::uint32_t width_;
    std::uint32_t height_;
    std::vector<Strip> strips_;
    std::uint32_t older_end_ = min_older_samples;
};

// Reads the sum of films of one size in pieces of consecutive pixels, the first beginning with pixel 0. A film that was
// folded less than the expected counts ask for has taken none of the newest samples.
void read_films(std::span<Film *const> films, double unit, const PartCounts &expected, bool with_standard_error,
                const std::function<void(const PixelEstimates &)> &receive);

// The largest strip that a device can bind, in pixels.
std::uint32_t max_strip_pixels(const vulkan::Limits &limits);

} // namespace pt
