#include "lib/film/film_tiles.h"

#include "lib/film/tile_map.h"

namespace pt {

namespace {

Rectangle shifted(const Rectangle &pixels, const Rectangle &origin) {
    return {pixels.x + origin.x, pixels.y + origin.y, pixels.width, pixels.height};
}

// The samples of the pixels of a rectangle, if all have the same: none if no tile has these pixels. Nothing if they
// differ.
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
