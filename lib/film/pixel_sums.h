// Exact sums of samples in consecutive pixels, on the host. Read from devices (device_film.h) and bytes (film_bytes.h),
// added, and turned into radiance and its error.
#pragma once

#include "lib/film/film_header.h"
#include "lib/film/quotient.h"
#include "lib/film/sample_set.h"
#include "shaders/gpu_layout.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// A part's words, plane by plane (gpu_layout.h).
template <typename Word>
struct PartWords {
    Word *first;
    std::size_t stride; // between planes
};

// Adds one part of consecutive pixels to another.
void add_words(const PartWords<std::uint32_t> &to, const PartWords<const std::uint32_t> &from,
               std::size_t pixel_count) noexcept;

// Undoes add_words().
void subtract_words(const PartWords<std::uint32_t> &to, const PartWords<const std::uint32_t> &from,
                    std::size_t pixel_count) noexcept;

class PixelSums {
public:
    static constexpr std::size_t words_per_pixel = std::size_t{gpu::FILM_PARTS} * gpu::FILM_WORDS;

    std::size_t pixel_count() const { return pixel_count_; }

    // The sums are then undefined.
    void resize(std::size_t pixel_count) {
        words_.resize(pixel_count * words_per_pixel);
        pixel_count_ = pixel_count;
    }

    void clear() noexcept;

    // One word of every pixel: a plane of a part (gpu_layout.h).
    std::span<std::uint32_t> plane(std::uint32_t part, std::size_t index) {
        return std::span(words_).subspan((std::size_t{part} * gpu::FILM_WORDS + index) * pixel_count_, pixel_count_);
    }
    std::span<const std::uint32_t> plane(std::uint32_t part, std::size_t index) const {
        return std::span(words_).subspan((std::size_t{part} * gpu::FILM_WORDS + index) * pixel_count_, pixel_count_);
    }

    void add(const PixelSums &other) noexcept;

    // Adds one part of consecutive pixels in `from` to a part of the pixels from to_first on.
    void add_part(std::uint32_t to_part, std::size_t to_first, const PixelSums &from, std::uint32_t from_part,
                  std::size_t first, std::size_t count) noexcept;

    // Adds the other part of consecutive pixels to this one and empties it.
    void fold_into(std::uint32_t part, std::size_t first, std::size_t count) noexcept;

    // Moves these samples' sums to a larger set's split, which may put all of them on one side.
    void split_for(const SampleSet &samples, std::uint64_t split, std::size_t first, std::size_t count) noexcept;

    void copy(const PixelSums &from, std::size_t first, std::size_t count, std::size_t to_first) noexcept;

    // Copies the pixels in both rectangles of an image: `own`, this object's, and `of_from`, that `from` covers.
    void copy(const Rectangle &own, const PixelSums &from, const Rectangle &of_from) noexcept;

    // Accepted or rejected samples.
    PartCounts samples_of(std::size_t pixel) const;

    // Whether this many samples can have such sums: each accepted one is below 2^FILM_MAX_EXPONENT.
    bool holds(const PartCounts &expected) const;

    // R, G and B of each pixel. quantity: a PT_QUANTITY_* of samples. unit: of the sums, in radiance.
    std::vector<float> values(std::uint32_t quantity, double unit) const;

    bool operator==(const PixelSums &) const = default;

private:
    std::size_t pixel_count_ = 0;
    std::vector<std::uint32_t> words_;
};

struct PixelValue {
    float mean;           // 0 if all samples were rejected
    float standard_error; // error of the mean, from its parts; infinity if one is empty, as with up to 8 samples
    float lesser;         // lesser mean of the parts; 0 where the standard error is infinity
};

// Rounds as in quotient.h.
class PixelValues {
public:
    // unit: of the sums, a power of two, in radiance.
    PixelValues(const PixelSums &sums, double unit);

    std::array<float, 3> means(std::size_t pixel);
    std::array<PixelValue, 3> of(std::size_t pixel);

private:
    void show(std::uint32_t a, std::uint32_t b);

    const PixelSums &sums_;
    int exponent_;
    PartQuotients quotients_; // the previous pixel's: most have the same samples
};

// Throws PT_ERROR_INTERNAL if the samples differ: a driver lost work.
void require_samples(const PartCounts &done, const PartCounts &expected);

} // namespace pt
