// A film's header: its picture, and the samples of its pixels. Text, a line per fact (FORMAT.md).
#pragma once

#include "lib/film/sample_set.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace pt {

// Facts decide the samples' bits. Films can be added only if all are equal.
struct FilmFact {
    std::string name;
    std::string value;

    bool operator==(const FilmFact &) const = default;
};
using FilmIdentity = std::vector<FilmFact>;

// In pixels from the image's top left corner.
struct Rectangle {
    std::uint32_t x, y, width, height;

    std::uint64_t pixel_count() const { return std::uint64_t{width} * height; }
    std::uint32_t right() const { return x + width; }
    std::uint32_t bottom() const { return y + height; }

    // Index of an image's pixel within the rectangle, row by row.
    std::size_t index_of(std::uint32_t column, std::uint32_t row) const {
        return std::size_t{row - y} * width + (column - x);
    }

    bool operator==(const Rectangle &) const = default;
};

// The intersection; width or height 0 if empty.
inline Rectangle common(const Rectangle &a, const Rectangle &b) {
    const std::uint32_t x = std::max(a.x, b.x);
    const std::uint32_t y = std::max(a.y, b.y);
    return {x, y, std::max(std::min(a.right(), b.right()), x) - x, std::max(std::min(a.bottom(), b.bottom()), y) - y};
}

// Pixels with the same samples.
struct FilmTile {
    Rectangle pixels;
    SampleSet samples;

    bool operator==(const FilmTile &) const = default;
};

// Progress towards a target error, by adaptive_rule.h.
struct AdaptiveRound {
    static constexpr std::int32_t none = std::numeric_limits<std::int32_t>::min();

    std::int32_t number = none; // bound: 2^(-number / 2), of squared relative error per sample and pixel
    std::uint64_t floor = 0;    // samples that every pixel is to have

    bool operator==(const AdaptiveRound &) const = default;
};

// The round of two films' sum.
inline AdaptiveRound later_of(const AdaptiveRound &a, const AdaptiveRound &b) {
    return {std::max(a.number, b.number), std::max(a.floor, b.floor)};
}

// The lamps smaller than a pixel in a square of the image, lamp_square pixels a side. x, y: its corner, multiples of
// lamp_square. samples: of a pixel, enough to meet the least lamp.
struct LampSquare {
    std::uint32_t x;
    std::uint32_t y;
    std::uint32_t samples;

    bool operator==(const LampSquare &) const = default;
};

inline constexpr std::uint32_t lamp_square = 8;

// Ordered by rows, each square once, with the most samples needed.
std::vector<LampSquare> united(std::vector<LampSquare> lamps);

struct FilmHeader {
    FilmIdentity identity;
    std::vector<FilmTile> tiles; // their sums follow in this order
    AdaptiveRound round{};       // towards a target error, if any
    std::vector<LampSquare> lamps{};

    bool operator==(const FilmHeader &) const = default;
};

// Ends with an empty line.
std::string text_of(const FilmHeader &header);

// Inverse of text_of(). Throws PT_ERROR_INCOMPATIBLE for any other text or version.
FilmHeader parsed_film_header(std::string_view text);

} // namespace pt
