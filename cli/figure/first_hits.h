// What the camera sees first, finer than the pixels of the picture: for coverage, lines and outlines with smooth edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cli {

inline constexpr std::uint32_t hits_per_side = 4; // 16 of a pixel

// A band of rows of the picture, each of which has hits_per_side rows of hits.
struct FirstHits {
    std::uint32_t width;     // of the picture, pixels
    std::uint32_t first_row; // of the picture
    std::uint32_t row_count;
    // Of these rows, from first_row on, those that are wanted; the others are there for what reaches in from beyond.
    std::uint32_t wanted_first;
    std::uint32_t wanted_count;
    std::vector<float> depths;          // INFINITY where nothing is met
    std::vector<std::uint32_t> objects; // as PT_QUANTITY_OBJECT

    bool wants(std::size_t row_of_hits) const { return row_of_hits / hits_per_side - wanted_first < wanted_count; }
    std::size_t columns() const { return std::size_t{width} * hits_per_side; }
    std::size_t rows() const { return std::size_t{row_count} * hits_per_side; }
};

} // namespace cli
