// Exact sums of the samples of consecutive pixels, on the host.
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

constexpr std::size_t film_planes(bool has_coverage) {
    return std::size_t{gpu::FILM_COVERED} + (has_coverage ? 1 : 0);
}

class PixelSums {
public:
    std::size_t pixel_count() const { return pixel_count_; }
    std::size_t plane_count() const { return film_planes(has_coverage_); }
    bool has_coverage() const { return has_coverage_; }

    void resize(std::size_t pixel_count, bool has_coverage = false) {
        words_.resize(pixel_count * film_planes(has_coverage));
        pixel_count_ = pixel_count;
        has_coverage_ = has_coverage;
    }

    void clear() noexcept;

    std::span<std::uint32_t> plane(std::size_t index) {
        return std::span(words_).subspan(index * pixel_count_, pixel_count_);
    }
    std::span<const std::uint32_t> plane(std::size_t index) const {
        return std::span(words_).subspan(index * pixel_count_, pixel_count_);
    }
    std::span<std::uint32_t> plane(std::uint32_t part, std::size_t index) {
        return plane(std::size_t{part} * gpu::FILM_WORDS + index);
    }
    std::span<const std::uint32_t> plane(std::uint32_t part, std::size_t index) const {
        return plane(std::size_t{part} * gpu::FILM_WORDS + index);
    }

    void add(const PixelSums &other) noexcept;

    // Adds part from_part of the pixels [first, first + count) of `from`.
    void add_part(std::uint32_t to_part, std::size_t to_first, const PixelSums &from, std::uint32_t from_part,
                  std::size_t first, std::size_t count) noexcept;

    // Adds the coverage of the same pixels, if both objects have it.
    void add_coverage(std::size_t to_first, const PixelSums &from, std::size_t first, std::size_t count) noexcept;

    // Adds the other part to this part and clears the other part.
    void fold_into(std::uint32_t part, std::size_t first, std::size_t count) noexcept;

    // `split` is the index that divides a set including `samples`. Moves all sums into one part if `samples` alone
    // would be divided at another index.
    void split_for(const SampleSet &samples, std::uint64_t split, std::size_t first, std::size_t count) noexcept;

    // Copies the planes that both objects have.
    void copy(const PixelSums &from, std::size_t first, std::size_t count, std::size_t to_first) noexcept;

    // Copies the common pixels of two rectangles of an image: `own` for this object and `of_from` for `from`.
    void copy(const Rectangle &own, const PixelSums &from, const Rectangle &of_from) noexcept;

    PartCounts samples_of(std::size_t pixel) const;

    // Whether the sums are possible for these numbers of samples.
    bool holds(const PartCounts &expected) const;

    // Returns R, G and B of each pixel. `quantity` is a PT_QUANTITY_* that comes from samples. PT_QUANTITY_COVERAGE
    // requires has_coverage(). `unit` is the radiance of one unit.
    std::vector<float> values(std::uint32_t quantity, double unit) const;

    bool operator==(const PixelSums &) const = default;

private:
    std::size_t pixel_count_ = 0;
    bool has_coverage_ = false;
    std::vector<std::uint32_t> words_;
};

struct PixelValue {
    float mean;           // 0 if all samples were rejected
    float standard_error; // infinity if a part has no samples
    float lesser;         // smaller of the two parts' means; 0 if a part has no samples
};

// Rounds as in quotient.h.
class PixelValues {
public:
    // `unit` is the radiance of one unit, a power of two.
    PixelValues(const PixelSums &sums, double unit);

    std::array<float, 3> means(std::size_t pixel);
    std::array<PixelValue, 3> of(std::size_t pixel);

private:
    void show(std::uint32_t a, std::uint32_t b);

    const PixelSums &sums_;
    int exponent_;
    PartQuotients quotients_; // kept between pixels, because most have equal counts
};

// Throws PT_ERROR_INTERNAL if the counts differ, which means that a driver lost work.
void require_samples(const PartCounts &done, const PartCounts &expected);

} // namespace pt
