// What the regions of a film whose tiles have different samples say about its error, on the host. Kept from look to look: a
// region is looked at again when one of its tiles has other samples than before.
#pragma once

#include "lib/film/region_errors.h"
#include "lib/film/tile_samples.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace pt {

class UnevenErrors {
public:
    // Gives the sums of consecutive rows of the film.
    using ReadRows = std::function<PixelSums(std::uint32_t first_row, std::uint32_t row_count)>;

    // Brings it up to date with a film of this unit that has these samples.
    void update(const TileSamples &samples, double unit, const ReadRows &read);

    // Row by row.
    const std::vector<RegionErrors> &regions() const { return regions_; }

    // By tiles of the film (region_errors.h).
    std::span<const double> tile_squares() const { return tile_squares_; }

    // The film is another one.
    void forget() noexcept { regions_.clear(); }

private:
    bool has_changed(const TileSamples &samples, const Rectangle &region) const;
    RegionErrors look_at(const TileSamples &samples, double unit, const Rectangle &region, const PixelSums &rows);

    TileSamples samples_; // of the last look
    std::vector<RegionErrors> regions_;
    std::vector<double> tile_squares_;
};

} // namespace pt
