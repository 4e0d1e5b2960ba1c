// The film in a device's memory: exact sums of samples, in strips. Owned by RenderDevice.
#pragma once

#include "lib/film/pixel_sums.h"
#include "lib/film/tile_samples.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/device.h"
#include "shaders/gpu_layout.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace pt {

// Consecutive pixels of a film.
struct PixelRange {
    std::uint32_t first;
    std::uint32_t count;
};

class DeviceFilm {
public:
    // As many consecutive pixels, row by row, as fit into one binding.
    struct Strip {
        std::uint32_t first_pixel;
        std::uint32_t pixel_count;
        vulkan::Buffer words; // gpu::FILM_WORDS planes of the older part, then of the newer
    };

    static constexpr std::uint64_t bytes_per_pixel = PixelSums::words_per_pixel * sizeof(std::uint32_t);

    // Its memory has to be cleared before it is used. Throws PT_ERROR_OUT_OF_DEVICE_MEMORY, or PT_ERROR_UNSUPPORTED for
    // sizes beyond the device.
    DeviceFilm(vulkan::Device &device, std::uint32_t width, std::uint32_t height, std::uint32_t max_strip_pixels);

    std::uint32_t width() const { return width_; }
    std::uint32_t pixel_count() const { return width_ * height_; }
    TileGrid grid() const { return {width_, height_}; }
    std::vector<Strip> &strips() { return strips_; }
    const std::vector<Strip> &strips() const { return strips_; }

    // Whether the host sees its memory, in place.
    bool is_host_memory() const;

    // Records that all sums become 0.
    void clear(const vk::raii::CommandBuffer &commands) const;

    // Whether its strips are whole rows of regions, as estimates of its error want them (gpu_layout.h).
    bool has_whole_regions() const;

    // Records that the words of consecutive pixels become those of a buffer: planes without gaps, part by part.
    void copy_to(const vk::raii::CommandBuffer &commands, const PixelRange &pixels, const vulkan::Buffer &to) const;

    // Sets the sums of its first pixels.
    void write(const PixelSums &sums);

    // Receives the sums of as many consecutive pixels.
    void read(std::uint32_t first_pixel, PixelSums &sums);

    // Sums of all pixels that are to replace those of a film: in memory of their own, so that whatever fails before
    // leaves the film as it was.
    class NewSums {
    public:
        // Throws PT_ERROR_OUT_OF_DEVICE_MEMORY.
        NewSums(vulkan::Device &device, DeviceFilm &film);

        // Sets those of consecutive pixels.
        void write(std::uint32_t first_pixel, const PixelSums &sums);

        // In a single submission, once all have been written.
        void replace();

    private:
        vulkan::Device &device_;
        DeviceFilm &film_;
        std::vector<vulkan::Buffer> words_; // of each strip
    };

    // Over both parts and all pixels.
    std::uint64_t rejected_samples();

private:
    std::uint32_t width_;
    std::uint32_t height_;
    std::vector<Strip> strips_;
};

// Reads the sum of films of one size, which together hold these samples, in pieces of so many consecutive pixels of a
// range. Throws PT_ERROR_INTERNAL if a driver lost work.
void read_films(std::span<DeviceFilm *const> films, const TileSamples &samples, const PixelRange &pixels,
                std::uint32_t most_pixels, const std::function<void(const PixelSums &)> &receive);

// Likewise, sets the sums of as many consecutive pixels.
void read_films(std::span<DeviceFilm *const> films, const TileSamples &samples, std::uint32_t first_pixel,
                PixelSums &sums);

// Pixels of the pieces in which films are read and written, so that a large image is not held twice. Were planes a
// power of two apart, the words of a pixel would contend for one set of the processor's cache.
inline constexpr std::uint32_t piece_pixels = 130'000;

// Calls function(first pixel, number of pixels) for consecutive pieces.
void for_each_piece(std::uint32_t pixel_count, std::uint32_t most_pixels,
                    const std::function<void(std::uint32_t, std::uint32_t)> &function);

// The largest strip that a device can bind, in pixels.
std::uint32_t max_strip_pixels(const vulkan::Limits &limits);

} // namespace pt
