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

// A setting that decides the bits of samples. Only films with equal facts can be added.
struct FilmFact {
    std::string name;
    std::string value;

    bool operator==(const FilmFact &) const = default;
};
using FilmIdentity = std::vector<FilmFact>;

// Coordinates begin at the image's top left corner.
struct Rectangle {
    std::uint32_t x, y, width, height;

    std::uint64_t pixel_count() const { return std::uint64_t{width} * height; }
    std::uint32_t right() const { return x + width; }
    std::uint32_t bottom() const { return y + height; }

    std::size_t index_of(std::uint32_t column, std::uint32_t row) const {
        return std::size_t{row - y} * width + (column - x);
    }

    bool operator==(const Rectangle &) const = default;
};

inline Rectangle common(const Rectangle &a, const Rectangle &b) {
    const std::uint32_t x = std::max(a.x, b.x);
    const std::uint32_t y = std::max(a.y, b.y);
    return {x, y, std::max(std::min(a.right(), b.right()), x) - x, std::max(std::min(a.bottom(), b.bottom()), y) - y};
}

struct FilmTile {
    Rectangle pixels;
    SampleSet samples;

    bool operator==(const FilmTile &) const = default;
};

struct AdaptiveRound {
    static constexpr std::int32_t none = std::numeric_limits<std::int32_t>::min();

    std::int32_t number = none; // the bound of gains is 2^(-number / 2)
    std::uint64_t floor = 0;    // minimum samples per pixel

    bool operator==(const AdaptiveRound &) const = default;
};

inline AdaptiveRound later_of(const AdaptiveRound &a, const AdaptiveRound &b) {
    return {std::max(a.number, b.number), std::max(a.floor, b.floor)};
}

// A square of lamp_square x lamp_square pixels with lamps smaller than a pixel.
struct LampSquare {
    std::uint32_t x;
    std::uint32_t y;
    std::uint32_t samples; // samples per pixel, enough to hit the smallest lamp

    bool operator==(const LampSquare &) const = default;
};

inline constexpr std::uint32_t lamp_square = 8;

bool has_coverage(const FilmIdentity &identity);

// Sorts by rows, and keeps the largest `samples` of equal squares.
std::vector<LampSquare> united(std::vector<LampSquare> lamps);

struct FilmHeader {
    FilmIdentity identity;
    std::vector<FilmTile> tiles;
    AdaptiveRound round{};
    std::vector<LampSquare> lamps{};

    bool operator==(const FilmHeader &) const = default;
};

std::string text_of(const FilmHeader &header);

// The inverse of text_of(). Throws PT_ERROR_INCOMPATIBLE for any other text or version.
FilmHeader parsed_film_header(std::string_view text);

} // namespace pt
