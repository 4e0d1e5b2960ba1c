// A film on the host: its header, and its tiles' exact sums. It needs no device. Behind pt_film.
#pragma once

#include "lib/film/adaptive_rule.h"
#include "lib/film/error_estimate.h"
#include "lib/film/film_bytes.h"
#include "lib/film/film_facts.h"
#include "lib/film/pixel_sums.h"
#include "lib/film/tile_errors.h"
#include "lib/film/tile_map.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace pt {

class Film {
public:
    // Throws PT_ERROR_INCOMPATIBLE if the bytes are no film, damaged, or of an impossible picture.
    explicit Film(std::span<const std::byte> bytes);

    const FilmFacts &facts() const { return facts_; }

    // Tiles are in canonical form.
    const FilmHeader &header() const { return header_; }

    // The smallest rectangle of the image with all of the film's pixels.
    const Rectangle &bounds() const { return bounds_; }

    // Adds another film in place, with little more memory. Throws PT_ERROR_INCOMPATIBLE for another picture, or if a
    // pixel has a sample in both. After an exception nothing has changed.
    void add(Film other);

    // bytes: of the size of header()'s layout.
    void write(std::span<std::byte> bytes) const;

    // Hands out the same bytes in pieces.
    void stream(const FilmStream::Receive &receive) const;

    // Fewest of any pixel within the bounds, perhaps 0.
    std::uint64_t sample_count() const;
    std::uint64_t max_sample_count() const;
    std::uint64_t total_samples() const; // summed over pixels

    // Calls receive(x, y, values) for runs of pixels within rows, in order. pixels: of the image. quantity: as for
    // PixelSums::values().
    using ReceiveRow = std::function<void(std::uint32_t x, std::uint32_t y, const std::vector<float> &values)>;
    void read(const Rectangle &pixels, std::uint32_t quantity, const ReceiveRow &receive) const;

    // Within the bounds.
    ErrorEstimate error() const;

    // Summed over pixels.
    std::uint64_t rejected_samples() const;

    // By tile of a grid over the bounds. Throws PT_ERROR_INCOMPATIBLE if the film's tiles cut the grid's.
    TileSamples samples_by_tile() const;

    // Samples of a pixel that meet all lamps in view smaller than a pixel; 0: no such lamps.
    std::uint32_t samples_for_lamps() const;

    // The next samples of tiles (adaptive_rule.h). Begins the next round when one is over.
    std::optional<TileStep> plan(const TileSamples &samples, double target_error, std::uint64_t most);

    // Tiles of the grid over the bounds.
    std::size_t tile_count() const { return TileGrid{bounds_.width, bounds_.height}.count(); }

private:
    struct Tile {
        Rectangle pixels;
        SampleSet samples;
        PixelSums sums;
    };

    ErrorEstimate error(const TileSamples &samples, FilmErrors &errors) const;
    std::vector<double> own_squares(const TileSamples &samples) const;
    std::vector<std::uint64_t> samples_for_lamps(const TileGrid &grid) const;
    std::span<const TileErrors> look_at(const TileSamples &samples, FilmErrors &errors) const;
    double unit() const { return std::ldexp(1.0, facts_.unit_exponent); }
    void read_rows_from(std::uint32_t first_row, PixelSums &sums) const; // fills sums with rows of the bounds
    std::vector<FilmTile> list() const;
    void require_disjoint(const std::vector<FilmTile> &others, const TileMap &map) const;
    void cut_along(const TileMap &map);
    static std::vector<Tile> outside(const TileMap &map, std::vector<Tile> tiles);
    static void add_to(Tile &tile, const Tile &other, SampleSet samples) noexcept;
    void stream_plane(const std::vector<TileMap::Piece> &pieces, std::uint32_t part, std::size_t plane,
                      FilmStream &stream) const;

    FilmFacts facts_;
    std::vector<Tile> tiles_;
    FilmHeader header_; // describes the tiles
    Rectangle bounds_;
    mutable FilmErrors errors_; // earlier checks' errors, so that the next reads only changed tiles
};

} // namespace pt
