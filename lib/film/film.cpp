#include "lib/film/film.h"

#include "lib/base/error.h"
#include "lib/base/rules.h"
#include "lib/film/film_tiles.h"
#include "lib/film/uneven_errors.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace pt {

namespace {

[[noreturn]] void refuse(const std::string &field, const std::string &value, const std::string &rule) {
    throw Error(PT_ERROR_INCOMPATIBLE, BrokenRule{.subject = "film", .member = field, .value = value, .rule = rule});
}

std::string where(const Rectangle &pixels) {
    return " in the " + std::to_string(pixels.width) + "x" + std::to_string(pixels.height) + " pixels from (" +
           std::to_string(pixels.x) + ", " + std::to_string(pixels.y) + ")";
}

// Index of a pixel of the image among those of a rectangle.
std::size_t index_in(const Rectangle &pixels, std::uint32_t x, std::uint32_t y) {
    return std::size_t{y - pixels.y} * pixels.width + (x - pixels.x);
}

PixelSums part_of(const PixelSums &sums, const Rectangle &pixels, const Rectangle &part) {
    PixelSums cut;
    cut.resize(part.pixel_count());
    for (std::uint32_t y = part.y; y < part.y + part.height; ++y)
        cut.copy(sums, index_in(pixels, part.x, y), part.width, index_in(part, part.x, y));
    return cut;
}

// Brings the sums of samples to the split of more samples, which may put all of them on one side.
void split_for(PixelSums &sums, const SampleSet &samples, const SampleSet &all) noexcept {
    const std::uint64_t own = split_of(samples.hull());
    const std::uint64_t split = split_of(all.hull());
    if (own != split)
        sums.fold_into(own < split ? older_part : newer_part);
}

} // namespace

Film::Film(std::span<const std::byte> bytes) {
    const FilmReader reader(bytes);
    facts_ = facts_of(reader.header().identity);
    const std::vector<FilmTile> &tiles = reader.header().tiles;
    if (tiles.empty())
        throw Error(PT_ERROR_INCOMPATIBLE, "film: it has no tile");
    bounds_ = bounds_of(tiles);
    if (bounds_.x + bounds_.width > facts_.width || bounds_.y + bounds_.height > facts_.height)
        throw Error(PT_ERROR_INCOMPATIBLE, "film: its tiles reach beyond the image");
    header_ = {reader.header().identity, canonical_tiles(tiles), reader.header().round};
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        tiles_.push_back({tiles[i].pixels, tiles[i].samples, {}});
        tiles_.back().sums.resize(tiles[i].pixels.pixel_count());
        reader.read(i, 0, tiles_.back().sums);
    }
}

std::vector<FilmTile> Film::list() const {
    std::vector<FilmTile> tiles;
    tiles.reserve(tiles_.size());
    for (const Tile &tile : tiles_)
        tiles.push_back({tile.pixels, tile.samples});
    return tiles;
}

std::vector<Film::Tile> Film::cut_to(const std::vector<Rectangle> &cuts) const {
    const TileMap map(list());
    std::vector<Tile> tiles;
    tiles.reserve(cuts.size());
    for (const Rectangle &cut : cuts) {
        tiles.push_back({cut, {}, {}});
        if (const TileMap::Span *span = map.find(cut.x, cut.y)) {
            const Tile &whole = tiles_[span->tile];
            tiles.back().samples = whole.samples;
            tiles.back().sums = part_of(whole.sums, whole.pixels, cut);
        } else {
            tiles.back().sums.resize(cut.pixel_count());
        }
    }
    return tiles;
}

void Film::add(Film other) {
    require_same(other.header_.identity, header_.identity, "as in the film that it is added to");
    const std::vector<FilmTile> own = list();
    const std::vector<FilmTile> others = other.list();
    const bool is_cut_alike = has_same_rectangles(own, others);
    std::vector<Tile> cut;
    if (!is_cut_alike) {
        const std::vector<Rectangle> cuts = common_cuts(TileMap(own), TileMap(others));
        cut = cut_to(cuts);
        other.tiles_ = other.cut_to(cuts);
    }
    std::vector<Tile> &tiles = is_cut_alike ? tiles_ : cut;
    std::vector<FilmTile> sum = sum_of(tiles, other.tiles_);
    FilmHeader header{header_.identity, canonical_tiles(sum), later_of(header_.round, other.header_.round)};
    // From here on nothing can fail.
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        split_for(tiles[i].sums, tiles[i].samples, sum[i].samples);
        split_for(other.tiles_[i].sums, other.tiles_[i].samples, sum[i].samples);
        tiles[i].sums.add(other.tiles_[i].sums);
        tiles[i].samples = std::move(sum[i].samples);
    }
    if (!is_cut_alike)
        tiles_ = std::move(cut);
    header_ = std::move(header);
    bounds_ = bounds_of(header_.tiles);
}

// Tiles of equal rectangles with the samples of both. Throws PT_ERROR_INCOMPATIBLE if they have one in common.
std::vector<FilmTile> Film::sum_of(const std::vector<Tile> &tiles, const std::vector<Tile> &others) {
    std::vector<FilmTile> sum;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const SampleSet &added = others[i].samples;
        if (const auto overlap = added.overlap(tiles[i].samples))
            refuse("samples", text_of(added) + where(tiles[i].pixels),
                   text_of(*overlap) + " are in the film already that it is added to");
        if (tiles[i].samples.count() + added.count() > UINT32_MAX)
            refuse("samples", text_of(added), "a pixel holds at most 2^32 - 1");
        sum.push_back({tiles[i].pixels, tiles[i].samples});
        sum.back().samples.add(added);
    }
    return sum;
}

void Film::write(std::span<std::byte> bytes) const {
    FilmWriter writer(header_, bytes);
    const TileMap written(header_.tiles);
    for (const Tile &tile : tiles_)
        write_tile(tile, written, writer);
    writer.end();
}

// A row of it lies in one tile of those that are written, which are as wide as can be.
void Film::write_tile(const Tile &tile, const TileMap &written, FilmWriter &writer) const {
    const Rectangle &pixels = tile.pixels;
    const std::size_t first = written.find(pixels.x, pixels.y)->tile;
    if (header_.tiles[first].pixels == pixels) {
        writer.write(first, 0, tile.sums);
        return;
    }
    for (std::uint32_t y = pixels.y; y < pixels.y + pixels.height; ++y) {
        const std::size_t to = written.find(pixels.x, y)->tile;
        const Rectangle row{pixels.x, y, pixels.width, 1};
        writer.write(to, index_in(header_.tiles[to].pixels, pixels.x, y), part_of(tile.sums, pixels, row));
    }
}

std::uint64_t Film::sample_count() const {
    std::uint64_t pixel_count = 0;
    std::uint64_t least = UINT64_MAX;
    for (const Tile &tile : tiles_) {
        pixel_count += tile.pixels.pixel_count();
        least = std::min(least, tile.samples.count());
    }
    return pixel_count < bounds_.pixel_count() ? 0 : least;
}

std::uint64_t Film::max_sample_count() const {
    std::uint64_t most = 0;
    for (const Tile &tile : tiles_)
        most = std::max(most, tile.samples.count());
    return most;
}

std::uint64_t Film::total_samples() const {
    std::uint64_t total = 0;
    for (const Tile &tile : tiles_)
        total += tile.samples.count() * tile.pixels.pixel_count();
    return total;
}

void Film::read(const Rectangle &pixels, bool with_standard_error,
                const std::function<void(const RowPart &)> &receive) const {
    const double unit = std::ldexp(1.0, facts_.unit_exponent);
    for (const TileMap map(list()); const TileMap::Band &band : map.bands())
        for (std::uint32_t y = std::max(band.first, pixels.y); y < std::min(band.end, pixels.y + pixels.height); ++y)
            for (const TileMap::Span &span : band.spans) {
                const std::uint32_t first = std::max(span.first, pixels.x);
                const std::uint32_t end = std::min(span.end, pixels.x + pixels.width);
                if (first >= end)
                    continue;
                const Tile &tile = tiles_[span.tile];
                const PixelSums sums = part_of(tile.sums, tile.pixels, {first, y, end - first, 1});
                receive({first, y, tile.samples.count(), sums.estimates(unit, with_standard_error)});
            }
}

PixelSums Film::rows(std::uint32_t first_row, std::uint32_t row_count) const {
    PixelSums sums;
    sums.resize(std::size_t{row_count} * bounds_.width);
    const Rectangle rows{bounds_.x, bounds_.y + first_row, bounds_.width, row_count};
    for (const Tile &tile : tiles_)
        for (std::uint32_t y = std::max(tile.pixels.y, rows.y);
             y < std::min(tile.pixels.y + tile.pixels.height, rows.y + rows.height); ++y)
            sums.copy(tile.sums, index_in(tile.pixels, tile.pixels.x, y), tile.pixels.width,
                      index_in(rows, tile.pixels.x, y));
    return sums;
}

// As a context states it for a film with these samples; of one whose tiles no context has, as if all pixels had the
// fewest.
ErrorEstimate Film::error(bool may_miss_lamps) const {
    const std::uint64_t samples = sample_count();
    if (samples < min_estimate_samples)
        return unknown_error();
    const std::optional<TileSamples> tiles = tile_samples(header_.tiles, bounds_);
    ErrorEstimator estimator({bounds_.width, samples, facts_.sampler, may_miss_lamps});
    if (tiles && !tiles->even()) {
        UnevenErrors errors;
        const auto read_rows = [&](std::uint32_t first_row, std::uint32_t row_count) {
            return rows(first_row, row_count);
        };
        for (const RegionErrors &region : errors.regions(*tiles, std::ldexp(1.0, facts_.unit_exponent), read_rows))
            estimator.add(region);
    } else {
        read(bounds_, true, [&](const RowPart &row) { estimator.add(row.estimates); });
    }
    return hides_error(estimator.rejected(), total_samples()) ? unknown_error() : estimator.result();
}

TileSamples Film::samples_by_tile() const {
    std::optional<TileSamples> samples = tile_samples(header_.tiles, bounds_);
    if (!samples)
        throw Error(PT_ERROR_INCOMPATIBLE, "film: its tiles cut squares of 8 pixels from its top left on");
    return std::move(*samples);
}

// Region by region, also where all tiles have the same samples, as a context looks that may tell them apart.
std::optional<TileStep> Film::plan(const TileSamples &samples, double target_error, std::uint64_t most,
                                   bool may_miss_lamps) {
    const double unit = std::ldexp(1.0, facts_.unit_exponent);
    UnevenErrors errors;
    const auto read_rows = [&](std::uint32_t first_row, std::uint32_t row_count) { return rows(first_row, row_count); };
    const auto look_at_tiles = [&] { return errors.tile_squares(samples, unit, read_rows); };
    const auto look = [&]() -> AdaptivePlan::Error {
        ErrorEstimate error = unknown_error();
        if (samples.least() >= min_estimate_samples) {
            ErrorEstimator estimator({bounds_.width, samples.least(), facts_.sampler, may_miss_lamps});
            for (const RegionErrors &region : errors.regions(samples, unit, read_rows))
                estimator.add(region);
            if (!hides_error(estimator.rejected(), samples.total()))
                error = estimator.result();
        }
        return {error.relative_rmse.high, (error.uncertain & PT_UNCERTAIN_UNSEEN) != 0};
    };
    return AdaptivePlan(target_error, most, look, look_at_tiles).next(samples, header_.round);
}

std::uint64_t Film::rejected_samples() const {
    std::uint64_t rejected = 0;
    for (const Tile &tile : tiles_)
        for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part)
            for (const std::uint32_t count : tile.sums.plane(part, gpu::FILM_REJECTED))
                rejected += count;
    return rejected;
}

} // namespace pt
