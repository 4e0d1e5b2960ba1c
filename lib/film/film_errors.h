// What the tiles and regions of a film say about its error, on the host. Results are kept between looks: a tile is
// looked at again only when its samples have changed, and a region when those of one of its tiles have.
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
    // Reads the sums of whole rows of the film, from first_row on, as many pixels as rows has.
    using ReadRows = std::function<void(std::uint32_t first_row, PixelSums &rows)>;

    // For each tile of a film with this unit and these samples (own_square_of in region_errors.h).
    std::span<const double> tile_squares(const TileSamples &samples, double unit, const ReadRows &read);

    // For each region, row by row.
    std::span<const RegionErrors> regions(const TileSamples &samples, double unit, const ReadRows &read);

    // To be called when the film is replaced.
    void forget() noexcept;

private:
    // What is known about the rectangles of a film, tiles or regions: all of one size, except at the edges.
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
