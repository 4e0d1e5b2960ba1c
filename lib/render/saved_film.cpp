#include "lib/render/saved_film.h"

#include "lib/base/error.h"
#include "lib/base/rules.h"
#include "lib/film/film_facts.h"
#include "lib/film/tile_map.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace pt {

namespace {

void require_within(const Rectangle &film, const Rectangle &pixels) {
    const auto text = [](const Rectangle &of) {
        return "rows [" + std::to_string(of.y) + ", " + std::to_string(std::uint64_t{of.y} + of.height) +
               "), columns [" + std::to_string(of.x) + ", " + std::to_string(std::uint64_t{of.x} + of.width) + ')';
    };
    const bool within = film.x >= pixels.x && film.y >= pixels.y && film.x + film.width <= pixels.x + pixels.width &&
                        film.y + film.height <= pixels.y + pixels.height;
    if (!within)
        refuse_film("tile", text(film), "must lie in " + text(pixels) + ", as in this context");
}

SampleSet united(const SampleSet &present, const SampleSet &added) {
    require_apart(added, present, "");
    SampleSet all = present;
    all.add(added);
    return all;
}

std::uint32_t rows_of_piece(std::uint32_t width) {
    return std::max(piece_pixels / width, 1U);
}

} // namespace

void save(std::span<DeviceFilm *const> films, const TileSamples &samples, const FilmHeader &header,
          const Rectangle &pixels, std::span<std::byte> bytes) {
    FilmWriter writer(header, bytes);
    Rectangle rows{pixels.x, pixels.y, pixels.width, 0};
    PixelSums part;
    const PixelRange all{0, films.front()->pixel_count()};
    read_films(films, samples, all, rows_of_piece(pixels.width) * pixels.width, [&](const PixelSums &sums) {
        rows.height = static_cast<std::uint32_t>(sums.pixel_count() / pixels.width);
        for (std::size_t i = 0; i < header.tiles.size(); ++i) {
            const Rectangle &tile = header.tiles[i].pixels;
            const Rectangle of_tile = common(tile, rows);
            if (of_tile.height == 0)
                continue;
            part.resize(of_tile.pixel_count(), sums.has_coverage());
            part.copy(of_tile, sums, rows);
            writer.write(i, tile.index_of(tile.x, of_tile.y), part);
        }
        rows.y += rows.height;
    });
    writer.end();
}

TileSamples samples_of_film(const FilmHeader &film, const Rectangle &pixels) {
    if (film.tiles.empty())
        throw Error(PT_ERROR_INCOMPATIBLE, "film: it has no tile");
    require_within(bounds_of(film.tiles), pixels);
    std::optional<TileSamples> samples = tile_samples(film.tiles, pixels);
    if (!samples)
        throw Error(PT_ERROR_INCOMPATIBLE, "film: its tiles must be whole ones of this context, squares of 8 pixels "
                                           "from the top left of what is rendered on");
    return std::move(*samples);
}

TileSamples united(const TileSamples &present, const TileSamples &added) {
    if (present.even() && added.even())
        return TileSamples(present.grid(), united(present.of(0), added.of(0)));
    TileSamples all(present.grid());
    for (std::size_t tile = 0; tile < present.grid().count(); ++tile)
        all.set(tile, united(present.of(tile), added.of(tile)));
    all.tidy();
    return all;
}

void add(const FilmReader &film, const TileSamples &added, std::span<DeviceFilm *const> films,
         const TileSamples &present, const TileSamples &all, const Rectangle &pixels, vulkan::Device &device) {
    const std::vector<FilmTile> &tiles = film.header().tiles;
    DeviceFilm::NewSums replaced(device, *films.front());
    PixelSums part;
    const std::uint32_t step = rows_of_piece(pixels.width);
    for (std::uint32_t row = 0; row < pixels.height; row += step) {
        const std::uint32_t row_count = std::min(step, pixels.height - row);
        PixelSums others;
        others.resize(std::size_t{row_count} * pixels.width, films.front()->has_coverage());
        const Rectangle rows{pixels.x, pixels.y + row, pixels.width, row_count};
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            const Rectangle &tile = tiles[i].pixels;
            const Rectangle of_tile = common(tile, rows);
            if (of_tile.height == 0)
                continue;
            part.resize(of_tile.pixel_count(), others.has_coverage());
            film.read(i, tile.index_of(tile.x, of_tile.y), part);
            others.copy(rows, part, of_tile);
        }
        PixelSums sums;
        sums.resize(others.pixel_count(), others.has_coverage());
        read_films(films, present, row * pixels.width, sums);
        const auto bring_together = [&](std::size_t first, std::size_t count, std::size_t tile) {
            const std::uint64_t split = split_of(all.of(tile).hull());
            sums.split_for(present.of(tile), split, first, count);
            others.split_for(added.of(tile), split, first, count);
        };
        if (present.even() && added.even())
            bring_together(0, sums.pixel_count(), 0);
        else
            all.grid().for_each_run(row * pixels.width, sums.pixel_count(), bring_together);
        sums.add(others);
        replaced.write(row * pixels.width, sums);
    }
    replaced.replace();
}

} // namespace pt
