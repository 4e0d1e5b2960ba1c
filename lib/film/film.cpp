#include "lib/film/film.h"

#include "lib/base/error.h"
#include "lib/base/rules.h"
#include "lib/film/film_facts.h"
#include "lib/film/tile_map.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

namespace pt {

namespace {

// Larger tiles must be single rows, so that cut_along() copies at most 7 MB.
constexpr std::uint32_t most_tile_pixels = 1U << 16;

std::string where(const Rectangle &pixels) {
    return " in the " + std::to_string(pixels.width) + "x" + std::to_string(pixels.height) + " pixels from (" +
           std::to_string(pixels.x) + ", " + std::to_string(pixels.y) + ")";
}

PixelSums part_of(const PixelSums &sums, const Rectangle &pixels, const Rectangle &part) {
    PixelSums cut;
    cut.resize(part.pixel_count(), sums.has_coverage());
    cut.copy(part, sums, pixels);
    return cut;
}

} // namespace

Film::Film(std::span<const std::byte> bytes) {
    const FilmReader reader(bytes);
    facts_ = facts_of(reader.header().identity);
    const std::vector<FilmTile> &tiles = reader.header().tiles;
    if (tiles.empty())
        throw Error(PT_ERROR_INCOMPATIBLE, "film: it has no tile");
    bounds_ = bounds_of(tiles);
    if (bounds_.right() > facts_.width || bounds_.bottom() > facts_.height)
        throw Error(PT_ERROR_INCOMPATIBLE, "film: its tiles reach beyond the image");
    header_ = {reader.header().identity, canonical_tiles(tiles), reader.header().round, reader.header().lamps};
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const auto [x, y, width, height] = tiles[i].pixels;
        const std::uint32_t row_count = std::max(most_tile_pixels / width, 1U);
        for (std::uint32_t row = 0; row < height; row += row_count) {
            const Rectangle pixels{x, y + row, width, std::min(row_count, height - row)};
            tiles_.push_back({pixels, tiles[i].samples, {}});
            tiles_.back().sums.resize(pixels.pixel_count(), facts_.has_coverage);
            reader.read(i, std::size_t{row} * width, tiles_.back().sums);
        }
    }
}

std::vector<FilmTile> Film::list() const {
    std::vector<FilmTile> tiles;
    tiles.reserve(tiles_.size());
    for (const Tile &tile : tiles_)
        tiles.push_back({tile.pixels, tile.samples});
    return tiles;
}

// Throws PT_ERROR_INCOMPATIBLE if both films have the same sample of a pixel. `map` must be the map of `others`.
void Film::require_disjoint(const std::vector<FilmTile> &others, const TileMap &map) const {
    for (const Tile &own : tiles_)
        for (const TileMap::Piece &piece : map.cut(own.pixels))
            if (piece.tile)
                require_apart(others[*piece.tile].samples, own.samples, where(piece.pixels));
}

// Cuts each tile into pieces that are within one tile of the map or outside all its tiles.
void Film::cut_along(const TileMap &map) {
    const std::size_t count = tiles_.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::vector<TileMap::Piece> pieces = map.cut(tiles_[i].pixels);
        if (pieces.size() == 1)
            continue;
        std::vector<Tile> cut;
        cut.reserve(pieces.size());
        for (const TileMap::Piece &piece : pieces)
            cut.push_back({piece.pixels, tiles_[i].samples, part_of(tiles_[i].sums, tiles_[i].pixels, piece.pixels)});
        tiles_.insert(tiles_.end(), std::move_iterator(cut.begin() + 1), std::move_iterator(cut.end()));
        tiles_[i] = std::move(cut.front());
    }
}

std::vector<Film::Tile> Film::outside(const TileMap &map, std::vector<Tile> tiles) {
    std::vector<Tile> found;
    for (Tile &tile : tiles)
        for (const TileMap::Piece &piece : map.cut(tile.pixels)) {
            if (piece.tile)
                continue;
            const bool is_whole = piece.pixels == tile.pixels;
            found.push_back({piece.pixels, tile.samples,
                             is_whole ? std::move(tile.sums) : part_of(tile.sums, tile.pixels, piece.pixels)});
        }
    return found;
}

// Adds the pixels that both tiles have. `samples` is the union of their samples. If a tile's split differs from the
// union's, all samples of the tile are on one side of the union's split.
void Film::add_to(Tile &tile, const Tile &other, SampleSet samples) noexcept {
    const std::uint64_t split = split_of(samples.hull());
    const std::uint64_t others_split = split_of(other.samples.hull());
    tile.sums.split_for(tile.samples, split, 0, tile.sums.pixel_count());
    const Rectangle &pixels = tile.pixels;
    const bool has_whole_rows = pixels.width == other.pixels.width;
    const std::size_t row_count = has_whole_rows ? 1 : pixels.height;
    const std::size_t run = has_whole_rows ? pixels.pixel_count() : pixels.width;
    for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part) {
        if (part_counts(other.samples)[part] == 0)
            continue;
        const std::uint32_t to_part = others_split == split ? part : others_split < split ? older_part : newer_part;
        for (std::size_t row = 0; row < row_count; ++row)
            tile.sums.add_part(to_part, row * run, other.sums, part,
                               other.pixels.index_of(pixels.x, pixels.y) + row * other.pixels.width, run);
    }
    for (std::size_t row = 0; row < row_count; ++row)
        tile.sums.add_coverage(row * run, other.sums,
                               other.pixels.index_of(pixels.x, pixels.y) + row * other.pixels.width, run);
    tile.samples = std::move(samples);
}

void Film::add(Film other) {
    require_same(other.header_.identity, header_.identity, "as in the film that it is added to");
    const std::vector<FilmTile> others = other.list();
    const TileMap theirs(others);
    require_disjoint(others, theirs);
    cut_along(theirs);
    std::vector<FilmTile> sum = list();
    const TileMap own(sum);
    std::vector<std::pair<std::size_t, std::size_t>> overlaps;
    for (std::size_t i = 0; i < tiles_.size(); ++i)
        if (const TileMap::Span *const span = theirs.find(tiles_[i].pixels.x, tiles_[i].pixels.y)) {
            overlaps.emplace_back(i, span->tile);
            sum[i].samples.add(others[span->tile].samples);
        }
    std::vector<Tile> added = outside(own, other.tiles_);
    for (const Tile &tile : added)
        sum.push_back({tile.pixels, tile.samples});
    std::vector<LampSquare> lamps = header_.lamps;
    lamps.insert(lamps.end(), other.header_.lamps.begin(), other.header_.lamps.end());
    FilmHeader header{header_.identity, canonical_tiles(sum), later_of(header_.round, other.header_.round),
                      united(std::move(lamps))};
    const Rectangle bounds = bounds_of(header.tiles);
    tiles_.reserve(tiles_.size() + added.size());
    // Nothing below may throw.
    for (const auto &[tile, others_tile] : overlaps)
        add_to(tiles_[tile], other.tiles_[others_tile], std::move(sum[tile].samples));
    std::ranges::move(added, std::back_inserter(tiles_));
    header_ = std::move(header);
    bounds_ = bounds;
}

void Film::write(std::span<std::byte> bytes) const {
    stream([&](std::span<const std::byte> piece) {
        std::ranges::copy(piece, bytes.begin());
        bytes = bytes.subspan(piece.size());
    });
}

void Film::stream(const FilmStream::Receive &receive) const {
    FilmStream stream(header_, receive);
    const TileMap own(list());
    const FilmLayout layout(header_);
    for (std::size_t i = 0; i < header_.tiles.size(); ++i) {
        const std::vector<TileMap::Piece> pieces = own.cut(header_.tiles[i].pixels);
        for (std::size_t plane = 0; plane < film_planes(facts_.has_coverage); ++plane)
            if (layout.has_plane(i, plane))
                stream_plane(pieces, plane, stream);
    }
    stream.end();
}

// Each piece must be within one tile.
void Film::stream_plane(const std::vector<TileMap::Piece> &pieces, std::size_t plane, FilmStream &stream) const {
    for (auto first = pieces.begin(); first != pieces.end();) {
        const auto [x, top, width, height] = first->pixels;
        const auto end =
            std::find_if(first, pieces.end(), [y = top](const auto &piece) { return piece.pixels.y != y; });
        for (std::uint32_t y = top; y < top + height; ++y)
            for (auto piece = first; piece != end; ++piece) {
                const Tile &tile = tiles_[*piece->tile];
                stream.add(
                    tile.sums.plane(plane).subspan(tile.pixels.index_of(piece->pixels.x, y), piece->pixels.width));
            }
        first = end;
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
    for (const FilmTile &tile : header_.tiles)
        most = std::max(most, tile.samples.count());
    return most;
}

std::uint64_t Film::total_samples() const {
    std::uint64_t total = 0;
    for (const Tile &tile : tiles_)
        total += tile.samples.count() * tile.pixels.pixel_count();
    return total;
}

void Film::read(const Rectangle &pixels, std::uint32_t quantity, const ReceiveRow &receive) const {
    for (const TileMap map(list()); const TileMap::Band &band : map.bands())
        for (std::uint32_t y = std::max(band.first, pixels.y); y < std::min(band.end, pixels.bottom()); ++y)
            for (const TileMap::Span &span : band.spans) {
                const std::uint32_t first = std::max(span.first, pixels.x);
                const std::uint32_t end = std::min(span.end, pixels.right());
                if (first >= end)
                    continue;
                const Tile &tile = tiles_[span.tile];
                const PixelSums sums = part_of(tile.sums, tile.pixels, {first, y, end - first, 1});
                receive(first, y, sums.values(quantity, unit()));
            }
}

void Film::read_rows_from(std::uint32_t first_row, PixelSums &sums) const {
    sums.clear(); // 0 outside all tiles
    const Rectangle rows{bounds_.x, bounds_.y + first_row, bounds_.width,
                         static_cast<std::uint32_t>(sums.pixel_count() / bounds_.width)};
    for (const Tile &tile : tiles_)
        sums.copy(rows, tile.sums, tile.pixels);
}

// If pixels of a tile have different samples, the estimate assumes the smallest number and caches no errors.
ErrorEstimate Film::error() const {
    if (const std::optional<TileSamples> samples = tile_samples(header_.tiles, bounds_))
        return error(*samples, errors_);
    FilmErrors errors;
    return error(TileSamples({bounds_.width, bounds_.height}, SampleSet({0, sample_count()})), errors);
}

ErrorEstimate Film::error(const TileSamples &samples, FilmErrors &errors) const {
    if (samples.least() < min_estimate_samples)
        return unknown_error();
    // A film has no scene, so the sizes of lamps are unknown.
    const bool by_chance = finds_lamps_by_chance(facts_.estimator, facts_.max_path_length);
    ErrorEstimator estimator({facts_.sampler, by_chance, by_chance});
    for (const TileErrors &tile : look_at(samples, errors))
        estimator.add(tile);
    return hides_error(estimator.rejected(), total_samples()) ? unknown_error() : estimator.result();
}

std::span<const TileErrors> Film::look_at(const TileSamples &samples, FilmErrors &errors) const {
    return errors.of(samples, unit(), [this](std::uint32_t row, PixelSums &sums) { read_rows_from(row, sums); });
}

TileSamples Film::samples_by_tile() const {
    std::optional<TileSamples> samples = tile_samples(header_.tiles, bounds_);
    if (!samples)
        throw Error(PT_ERROR_INCOMPATIBLE,
                    "film: its tiles must consist of whole squares of 8x8 pixels, counted from its top left");
    return std::move(*samples);
}

std::vector<double> Film::own_squares(const TileSamples &samples) const {
    std::vector<double> squares;
    for (const TileErrors &tile : look_at(samples, errors_))
        squares.push_back(tile.own_square());
    return squares;
}

std::vector<std::uint64_t> Film::samples_for_lamps(const TileGrid &grid) const {
    std::vector<std::uint64_t> needed(grid.count());
    for (const LampSquare &lamps : header_.lamps)
        if (lamps.x >= bounds_.x && lamps.x < bounds_.right() && lamps.y >= bounds_.y && lamps.y < bounds_.bottom())
            needed[grid.tile_at(lamps.x - bounds_.x, lamps.y - bounds_.y)] = lamps.samples;
    return needed;
}

std::optional<TileStep> Film::plan(const TileSamples &samples, double target_error, std::uint64_t most) {
    pt_stopping rules{};
    rules.target_error = target_error;
    const AdaptivePlan plan({rules}, {most, most},
                            {[&] { return error(samples, errors_); }, [&] { return own_squares(samples); },
                             [&] { return samples_for_lamps(samples.grid()); }});
    return plan.next(samples, header_.round);
}

std::uint32_t Film::samples_for_lamps() const {
    std::uint32_t most = 0;
    for (const LampSquare &lamps : header_.lamps)
        most = std::max(most, lamps.samples);
    return most;
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
