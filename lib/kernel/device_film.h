// A film in a device's memory. It is divided into strips, because buffers have a limited size.
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

struct PixelRange {
    std::uint32_t first;
    std::uint32_t count;
};

PixelRange common_pixels(const PixelRange &a, const PixelRange &b);

class DeviceFilm {
public:
    struct Strip {
        std::uint32_t first_pixel;
        std::uint32_t pixel_count;
        vulkan::Buffer words; // the planes of PixelSums

        PixelRange pixels() const { return {first_pixel, pixel_count}; }
    };

    static constexpr std::uint64_t bytes_per_pixel(bool has_coverage) {
        return film_planes(has_coverage) * sizeof(std::uint32_t);
    }

    // The film must be cleared before use. Throws PT_ERROR_OUT_OF_DEVICE_MEMORY or PT_ERROR_UNSUPPORTED.
    DeviceFilm(vulkan::Device &device, std::uint32_t width, std::uint32_t height, std::uint32_t max_strip_pixels,
               bool has_coverage = false);

    bool has_coverage() const { return has_coverage_; }
    std::uint64_t bytes_per_pixel() const { return bytes_per_pixel(has_coverage_); }

    std::uint32_t width() const { return grid_.width; }
    std::uint32_t pixel_count() const { return grid_.width * grid_.height; }
    const TileGrid &grid() const { return grid_; }
    std::vector<Strip> &strips() { return strips_; }
    const std::vector<Strip> &strips() const { return strips_; }

    void clear(const vk::raii::CommandBuffer &commands) const;

    bool has_whole_tiles() const;

    // The copy has all planes, without gaps between them.
    void copy_to(const vk::raii::CommandBuffer &commands, const PixelRange &pixels, const vulkan::Buffer &to) const;

    // Reads the planes that `sums` has.
    void read(std::uint32_t first_pixel, PixelSums &sums);

    // New sums for the whole film, which replace() puts in place.
    class NewSums {
    public:
        NewSums(vulkan::Device &device, DeviceFilm &film);

        void write(std::uint32_t first_pixel, const PixelSums &sums);

        void replace();

    private:
        vulkan::Device &device_;
        DeviceFilm &film_;
        std::vector<vulkan::Buffer> words_;
    };

    std::uint64_t rejected_samples();

private:
    TileGrid grid_;
    bool has_coverage_;
    std::vector<Strip> strips_;
};

// Reads the sum of films of equal size, in pieces. Throws PT_ERROR_INTERNAL if the films lack samples.
void read_films(std::span<DeviceFilm *const> films, const TileSamples &samples, const PixelRange &pixels,
                std::uint32_t most_pixels, const std::function<void(const PixelSums &)> &receive);

void read_films(std::span<DeviceFilm *const> films, const TileSamples &samples, std::uint32_t first_pixel,
                PixelSums &sums);

// Not a power of two, because all planes would then be in the same cache sets.
inline constexpr std::uint32_t piece_pixels = 130'000;

std::uint32_t max_strip_pixels(const vulkan::Limits &limits, bool has_coverage = false);

} // namespace pt
