// Exact sums of samples in consecutive pixels, on the host: a value. Read from devices (device_film.h) and from bytes
// (film_bytes.h), added, and turned into radiance and its error.
#pragma once

#include "lib/film/film_parts.h"
#include "shaders/gpu_layout.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// What the samples say about consecutive pixels, as R, G, B per pixel.
struct PixelEstimates {
    std::vector<float> radiance;       // mean of all samples; black where all were rejected
    std::vector<float> standard_error; // of that mean, from the difference of its parts; infinity where one is empty
                                       // and with up to 8 samples; nothing if it was not asked for
};

// A rectangle within consecutive pixels.
struct PixelRows {
    std::size_t first;
    std::size_t width;
    std::size_t height;
    std::size_t stride; // from a row to the next
};

// Where estimates of pixels go, in planes: R of all pixels, then G, then B.
struct EstimatePlanes {
    float *radiance;       // of the first pixel
    float *standard_error; // likewise; nullptr: neither this nor the lesser
    float *lesser;         // likewise: the smaller of the means of a pixel's parts, with the standard error
    std::size_t stride;    // from a plane to the next
    std::size_t row_stride;
};

class PixelSums {
public:
    static constexpr std::size_t words_per_pixel = std::size_t{gpu::FILM_PARTS} * gpu::FILM_WORDS;

    std::size_t pixel_count() const { return pixel_count_; }

    // Afterwards the sums are undefined until they are set.
    void resize(std::size_t pixel_count) {
        words_.resize(pixel_count * words_per_pixel);
        pixel_count_ = pixel_count;
    }

    void clear() noexcept;

    // One word of every pixel: a plane of a part, as in gpu_layout.h.
    std::span<std::uint32_t> plane(std::uint32_t part, std::size_t index) {
        return std::span(words_).subspan((std::size_t{part} * gpu::FILM_WORDS + index) * pixel_count_, pixel_count_);
    }
    std::span<const std::uint32_t> plane(std::uint32_t part, std::size_t index) const {
        return std::span(words_).subspan((std::size_t{part} * gpu::FILM_WORDS + index) * pixel_count_, pixel_count_);
    }

    void add(const PixelSums &other) noexcept;

    // Adds one part of consecutive pixels of another object to a part of the pixels from to_first on.
    void add_part(std::uint32_t to_part, std::size_t to_first, const PixelSums &from, std::uint32_t from_part,
                  std::size_t first, std::size_t count) noexcept;

    // Adds the other part to this one and empties it, in all pixels or in consecutive ones.
    void fold_into(std::uint32_t part) noexcept { fold_into(part, 0, pixel_count_); }
    void fold_into(std::uint32_t part, std::size_t first, std::size_t count) noexcept;

    // Copies consecutive pixels of another object.
    void copy(const PixelSums &from, std::size_t first, std::size_t count, std::size_t to_first) noexcept;

    // Samples of a pixel in each part, accepted or rejected.
    PartCounts samples_of(std::size_t pixel) const;

    // Whether this many samples can have such sums: each accepted sample is below 2^FILM_MAX_EXPONENT.
    bool holds(const PartCounts &expected) const;

    // The mean radiance, in units of a power of two, rounded as quotient.h says.
    PixelEstimates estimates(double unit, bool with_standard_error) const;

    // The same for some pixels; returns the samples left out of them.
    std::uint64_t estimate(const PixelRows &pixels, double unit, const EstimatePlanes &to) const;

    // The number of samples of each pixel, as R, G, B.
    std::vector<float> sample_counts() const;

    bool operator==(const PixelSums &) const = default;

private:
    std::size_t pixel_count_ = 0;
    std::vector<std::uint32_t> words_;
};

// Throws PT_ERROR_INTERNAL if a pixel does not hold the expected samples: a driver lost work.
void require_samples(const PartCounts &done, const PartCounts &expected);

} // namespace pt
