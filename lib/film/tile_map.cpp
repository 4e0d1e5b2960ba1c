#include "lib/film/tile_map.h"

#include "lib/base/error.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace pt {

namespace {

std::vector<std::uint32_t> distinct(std::vector<std::uint32_t> numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

struct RangesBefore {
    bool operator()(const SampleSet *a, const SampleSet *b) const {
        return std::ranges::lexicographical_compare(a->ranges(), b->ranges(), {}, ends, ends);
    }

    static std::pair<std::uint64_t, std::uint64_t> ends(const SampleRange &range) { return {range.first, range.end}; }
};

// Maps each tile to the first tile with equal samples, because sets of many ranges are slow to compare.
std::vector<std::size_t> first_equals(const std::vector<FilmTile> &tiles) {
    std::map<const SampleSet *, std::size_t, RangesBefore> known;
    std::vector<std::size_t> firsts;
    firsts.reserve(tiles.size());
    for (const FilmTile &tile : tiles)
        firsts.push_back(known.emplace(&tile.samples, firsts.size()).first->second);
    return firsts;
}

std::vector<TileMap::Span> runs_of(const TileMap::Band &band, const std::vector<std::size_t> &firsts) {
    std::vector<TileMap::Span> runs;
    for (const TileMap::Span &span : band.spans) {
        const std::size_t samples = firsts[span.tile];
        if (!runs.empty() && runs.back().end == span.first && runs.back().tile == samples)
            runs.back().end = span.end;
        else
            runs.push_back({span.first, span.end, samples});
    }
    return runs;
}

std::vector<TileMap::Piece> cut_rows(const std::vector<TileMap::Span> &spans, const Rectangle &rows) {
    std::vector<TileMap::Piece> pieces;
    std::uint32_t x = rows.x;
    const auto add_up_to = [&](std::uint32_t end, std::optional<std::size_t> tile) {
        if (x < end)
            pieces.push_back({{x, rows.y, end - x, rows.height}, tile});
        x = std::max(x, end);
    };
    auto span = std::ranges::upper_bound(spans, x, {}, &TileMap::Span::end);
    for (; span != spans.end() && span->first < rows.right(); ++span) {
        add_up_to(span->first, std::nullopt);
        add_up_to(std::min(span->end, rows.right()), span->tile);
    }
    add_up_to(rows.right(), std::nullopt);
    return pieces;
}

bool continue_below(std::span<const TileMap::Piece> pieces, std::span<const TileMap::Piece> below) {
    return std::ranges::equal(pieces, below, [](const TileMap::Piece &a, const TileMap::Piece &b) {
        return a.pixels.x == b.pixels.x && a.tile == b.tile;
    });
}

Rectangle shifted(const Rectangle &pixels, const Rectangle &origin) {
    return {pixels.x + origin.x, pixels.y + origin.y, pixels.width, pixels.height};
}

// Returns an empty set if no tile has the pixels. Returns no value if pixels have different samples.
std::optional<SampleSet> samples_of(const TileMap &map, const std::vector<FilmTile> &tiles, const Rectangle &pixels) {
    const SampleSet none;
    const auto samples_in = [&](const TileMap::Piece &piece) -> const SampleSet & {
        return piece.tile ? tiles[*piece.tile].samples : none;
    };
    const std::vector<TileMap::Piece> pieces = map.cut(pixels);
    const SampleSet &first = samples_in(pieces.front());
    for (const TileMap::Piece &piece : pieces)
        if (samples_in(piece) != first)
            return std::nullopt;
    return first;
}

} // namespace

TileMap::TileMap(const std::vector<FilmTile> &tiles) {
    std::vector<std::uint32_t> rows;
    for (const FilmTile &tile : tiles) {
        rows.push_back(tile.pixels.y);
        rows.push_back(tile.pixels.bottom());
    }
    rows = distinct(std::move(rows));
    for (std::size_t i = 0; i + 1 < rows.size(); ++i)
        bands_.push_back({rows[i], rows[i + 1], {}});
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const Rectangle &pixels = tiles[i].pixels;
        auto band = std::ranges::lower_bound(bands_, pixels.y, {}, &Band::first);
        for (; band != bands_.end() && band->first < pixels.bottom(); ++band)
            band->spans.push_back({pixels.x, pixels.right(), i});
    }
    std::erase_if(bands_, [](const Band &band) { return band.spans.empty(); });
    for (Band &band : bands_) {
        std::ranges::sort(band.spans, {}, &Span::first);
        for (std::size_t i = 1; i < band.spans.size(); ++i)
            if (band.spans[i].first < band.spans[i - 1].end)
                throw Error(PT_ERROR_INCOMPATIBLE, "film: its tiles overlap in row " + std::to_string(band.first) +
                                                       ", column " + std::to_string(band.spans[i].first));
    }
}

const TileMap::Span *TileMap::find(std::uint32_t x, std::uint32_t y) const {
    const auto band = std::ranges::upper_bound(bands_, y, {}, &Band::end);
    if (band == bands_.end() || band->first > y)
        return nullptr;
    const auto span = std::ranges::upper_bound(band->spans, x, {}, &Span::end);
    return span == band->spans.end() || span->first > x ? nullptr : &*span;
}

std::vector<TileMap::Piece> TileMap::cut(const Rectangle &pixels) const {
    std::vector<Piece> pieces;
    std::size_t above = 0;
    auto band = std::ranges::upper_bound(bands_, pixels.y, {}, &Band::end);
    for (std::uint32_t y = pixels.y; y < pixels.bottom();) {
        const bool is_free = band == bands_.end() || band->first > y;
        const std::uint32_t next = band == bands_.end() ? pixels.bottom() : is_free ? band->first : band->end;
        const std::uint32_t end = std::min(next, pixels.bottom());
        const std::vector<Piece> rows =
            cut_rows(is_free ? std::vector<Span>() : band->spans, {pixels.x, y, pixels.width, end - y});
        if (continue_below(std::span(pieces).subspan(above), rows)) {
            for (Piece &piece : std::span(pieces).subspan(above))
                piece.pixels.height += end - y;
        } else {
            above = pieces.size();
            pieces.insert(pieces.end(), rows.begin(), rows.end());
        }
        if (!is_free)
            ++band;
        y = end;
    }
    return pieces;
}

Rectangle bounds_of(const std::vector<FilmTile> &tiles) {
    Rectangle bounds = tiles.front().pixels;
    for (const FilmTile &tile : tiles) {
        const std::uint32_t right = std::max(bounds.right(), tile.pixels.right());
        const std::uint32_t bottom = std::max(bounds.bottom(), tile.pixels.bottom());
        bounds.x = std::min(bounds.x, tile.pixels.x);
        bounds.y = std::min(bounds.y, tile.pixels.y);
        bounds.width = right - bounds.x;
        bounds.height = bottom - bounds.y;
    }
    return bounds;
}

std::vector<FilmTile> canonical_tiles(const std::vector<FilmTile> &tiles) {
    const std::vector<std::size_t> firsts = first_equals(tiles);
    std::vector<FilmTile> all;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::size_t, std::size_t>>
        above; // samples and tile of each run
    std::uint32_t bottom = 0;
    for (const TileMap map(tiles); const TileMap::Band &band : map.bands()) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::size_t, std::size_t>> here;
        for (const auto &[first, end, samples] : runs_of(band, firsts)) {
            const auto found = above.find({first, end});
            if (found != above.end() && band.first == bottom && found->second.first == samples) {
                all[found->second.second].pixels.height += band.end - band.first;
                here.insert(*found);
                continue;
            }
            here.insert({{first, end}, {samples, all.size()}});
            all.push_back({{first, band.first, end - first, band.end - band.first}, tiles[samples].samples});
        }
        above = std::move(here);
        bottom = band.end;
    }
    return all;
}

std::vector<FilmTile> film_tiles(const TileSamples &samples, const Rectangle &pixels) {
    if (samples.even())
        return {{pixels, samples.of(0)}};
    std::vector<FilmTile> tiles;
    for (std::size_t tile = 0; tile < samples.grid().count(); ++tile)
        if (!samples.of(tile).empty())
            tiles.push_back({shifted(samples.grid().pixels(tile), pixels), samples.of(tile)});
    return canonical_tiles(tiles);
}

std::optional<TileSamples> tile_samples(const std::vector<FilmTile> &tiles, const Rectangle &pixels) {
    TileSamples samples({pixels.width, pixels.height});
    const TileMap map(tiles);
    for (std::size_t tile = 0; tile < samples.grid().count(); ++tile) {
        const std::optional<SampleSet> set = samples_of(map, tiles, shifted(samples.grid().pixels(tile), pixels));
        if (!set)
            return std::nullopt;
        samples.set(tile, *set);
    }
    samples.tidy();
    return samples;
}

} // namespace pt
