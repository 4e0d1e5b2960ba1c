// What the tiles of a film say about its error, on the host. Kept between looks: a tile is looked at again only when
// its samples have changed.
#pragma once

#include "lib/film/pixel_sums.h"
#include "lib/film/tile_errors.h"
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

    // By tile, of a film with this unit and these samples.
    std::span<const TileErrors> of(const TileSamples &samples, double unit, const ReadRows &read);

    // To be called when the film is replaced.
    void forget() noexcept { tiles_.clear(); }

private:
    TileSamples samples_; // of the last look
    std::vector<TileErrors> tiles_;
};

} // namespace pt
