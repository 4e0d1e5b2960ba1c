// The film in a device's memory: exact sums of samples, in strips. Owned by RenderDevice.
#pragma once

#include "lib/film/pixel_sums.h"
#include "lib/film/tile_samples.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/device.h"
#include "shaders/gpu_layout.h"

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

// Those that two ranges have in common; none, if the count is 0.
PixelRange common_pixels(const PixelRange &a, const PixelRange &b);

class DeviceFilm {
public:
    // As many consecutive pixels, row by row, as fit into one binding.
    struct Strip {
        std::uint32_t first_pixel;
        std::uint32_t pixel_count;
        vulkan::Buffer words; // gpu::FILM_WORDS planes of the older part, then of the newer

        PixelRange pixels() const { return {first_pixel, pixel_count}; }
    };

    static constexpr std::uint64_t bytes_per_pixel = PixelSums::words_per_pixel * sizeof(std::uint32_t);

    // The memory has to be cleared before it is used. Throws PT_ERROR_OUT_OF_DEVICE_MEMORY, or PT_ERROR_UNSUPPORTED for
    // sizes beyond the device.
    DeviceFilm(vulkan::Device &device, std::uint32_t width, std::uint32_t height, std::uint32_t max_strip_pixels);

    std::uint32_t width() const { return grid_.width; }
    std::uint32_t pixel_count() const { return grid_.width * grid_.height; }
    const TileGrid &grid() const { return grid_; }
    std::vector<Strip> &strips() { return strips_; }
    const std::vector<Strip> &strips() const { return strips_; }

    // Whether the host can read and write the film in place.
    bool is_host_memory() const;

    // Records commands that set all sums to 0.
    void clear(const vk::raii::CommandBuffer &commands) const;

    // Whether its strips consist of whole rows of tiles, which the kernel that estimates the error needs.
    bool has_whole_tiles() const;

    // Records commands that copy the words of consecutive pixels into a buffer: planes without gaps, one part after the
    // other.
    void copy_to(const vk::raii::CommandBuffer &commands, const PixelRange &pixels, const vulkan::Buffer &to) const;

    // Reads the sums of consecutive pixels, as many as there is room for.
    void read(std::uint32_t first_pixel, PixelSums &sums);

    // New sums for all pixels of a film, in memory of their own: if anything fails before replace(), the film is as it
    // was.
    class NewSums {
    public:
        // Throws PT_ERROR_OUT_OF_DEVICE_MEMORY.
        NewSums(vulkan::Device &device, DeviceFilm &film);

        // Sets the sums of consecutive pixels.
        void write(std::uint32_t first_pixel, const PixelSums &sums);

        // Takes the place of the film in a single submission, once all sums have been written.
        void replace();

    private:
        vulkan::Device &device_;
        DeviceFilm &film_;
        std::vector<vulkan::Buffer> words_; // of each strip
    };

    // The sum over both parts and all pixels.
    std::uint64_t rejected_samples();

private:
    TileGrid grid_;
    std::vector<Strip> strips_;
};

// Reads the sum of films of one size, which together hold these samples, piece by piece. Throws PT_ERROR_INTERNAL if a
// driver lost work.
void read_films(std::span<DeviceFilm *const> films, const TileSamples &samples, const PixelRange &pixels,
                std::uint32_t most_pixels, const std::function<void(const PixelSums &)> &receive);

// Reads the sums of consecutive pixels, as many as there is room for. Throws likewise.
void read_films(std::span<DeviceFilm *const> films, const TileSamples &samples, std::uint32_t first_pixel,
                PixelSums &sums);

// How many pixels of films are read or written at a time, so that a large image is not held twice. Not a power of two:
// planes a power of two apart would put the words of a pixel into the same set of the processor's cache.
inline constexpr std::uint32_t piece_pixels = 130'000;

// The largest strip that a device can bind, in pixels.
std::uint32_t max_strip_pixels(const vulkan::Limits &limits);

} // namespace pt
