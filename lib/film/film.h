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
    // Throws PT_ERROR_INCOMPATIBLE if the bytes are not a film, are damaged, or describe an impossible picture.
    explicit Film(std::span<const std::byte> bytes);

    const FilmFacts &facts() const { return facts_; }

    const FilmHeader &header() const { return header_; }

    const Rectangle &bounds() const { return bounds_; }

    // Throws PT_ERROR_INCOMPATIBLE if the films are of different pictures or have the same sample of a pixel. After an
    // exception this film is unchanged.
    void add(Film other);

    // `bytes` must have the size that the layout of header() gives.
    void write(std::span<std::byte> bytes) const;

    void stream(const FilmStream::Receive &receive) const;

    std::uint64_t sample_count() const;
    std::uint64_t max_sample_count() const;
    std::uint64_t total_samples() const;

    // Calls receive(x, y, values) for runs of pixels within rows, in order. `quantity` is a PT_QUANTITY_* that comes
    // from samples.
    using ReceiveRow = std::function<void(std::uint32_t x, std::uint32_t y, const std::vector<float> &values)>;
    void read(const Rectangle &pixels, std::uint32_t quantity, const ReceiveRow &receive) const;

    ErrorEstimate error() const;

    std::uint64_t rejected_samples() const;

    // Throws PT_ERROR_INCOMPATIBLE if pixels of one tile of the grid have different samples.
    TileSamples samples_by_tile() const;

    // Returns how many samples per pixel are enough for all small lamps in view; 0 without such lamps.
    std::uint32_t samples_for_lamps() const;

    std::optional<TileStep> plan(const TileSamples &samples, double target_error, std::uint64_t most);

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
    void read_rows_from(std::uint32_t first_row, PixelSums &sums) const;
    std::vector<FilmTile> list() const;
    void require_disjoint(const std::vector<FilmTile> &others, const TileMap &map) const;
    void cut_along(const TileMap &map);
    static std::vector<Tile> outside(const TileMap &map, std::vector<Tile> tiles);
    static void add_to(Tile &tile, const Tile &other, SampleSet samples) noexcept;
    void stream_plane(const std::vector<TileMap::Piece> &pieces, std::size_t plane, FilmStream &stream) const;

    FilmFacts facts_;
    std::vector<Tile> tiles_;
    FilmHeader header_;
    Rectangle bounds_;
    mutable FilmErrors errors_;
};

} // namespace pt
