// What the tiles and the regions of a film say about its error, on the host. Kept from look to look: a tile is looked
// at again when it has other samples than before, and a region when one of its tiles has.
#pragma once

#include "lib/film/pixel_sums.h"
#include "lib/film/region_errors.h"
#include "lib/film/tile_samples.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace pt {

class FilmErrors {
public:
    // Sets the sums of as many pixels, which are whole rows of the film from this one on.
    using ReadRows = std::function<void(std::uint32_t first_row, PixelSums &rows)>;

    // Of a film of this unit that has these samples, by tile (own_square_of in region_errors.h).
    std::span<const double> tile_squares(const TileSamples &samples, double unit, const ReadRows &read);

    // Row by row.
    std::span<const RegionErrors> regions(const TileSamples &samples, double unit, const ReadRows &read);

    // The film is another one.
    void forget() noexcept;

private:
    // What is known of rectangles of a film, each of one size but at its edges: tiles, or regions.
    template <typename Fact>
    struct Known {
        TileSamples samples; // of the last look
        std::vector<Fact> facts;
    };

    template <typename Fact>
    static void update(Known<Fact> &known, std::uint32_t side, const TileSamples &samples, double unit,
                       const ReadRows &read, Fact (*fact_of)(const RegionPixels &));

    Known<double> squares_;
    Known<RegionErrors> regions_;
};

} // namespace pt
