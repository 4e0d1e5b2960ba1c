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
    if (const auto overlap = added.overlap(present))
        refuse_film("samples", text_of(added), text_of(*overlap) + " are in this context's film already");
    if (present.count() + added.count() > UINT32_MAX)
        refuse_film("samples", text_of(added), "a pixel holds at most 2^32 - 1");
    SampleSet all = present;
    all.add(added);
    return all;
}

// How many whole rows of a film are handled at a time.
std::uint32_t rows_of_piece(std::uint32_t width) {
    return std::max(piece_pixels / width, 1U);
}

// The rows of a tile that lie in consecutive rows of its film.
struct RowsInTile {
    std::uint32_t first; // of the film
    std::uint32_t end;

    RowsInTile(const Rectangle &tile, std::uint32_t first_row, std::uint32_t row_count) :
        first(std::max(tile.y, first_row)),
        end(std::max(std::min(tile.y + tile.height, first_row + row_count), first)) {}

    std::uint32_t count() const { return end - first; }
};

// Copies the pixels of a tile's rows between memory that holds them alone and the rows of the film from first_row on.
template <typename Copy>
void for_each_row(const Rectangle &tile, const RowsInTile &rows, std::uint32_t first_row, std::uint32_t width,
                  const Copy &copy) {
    for (std::uint32_t y = rows.first; y < rows.end; ++y)
        copy(std::size_t{y - first_row} * width + tile.x, std::size_t{y - rows.first} * tile.width, tile.width);
}

} // namespace

void save(std::span<DeviceFilm *const> films, const TileSamples &samples, const FilmHeader &header,
          const Rectangle &origin, std::span<std::byte> bytes) {
    FilmWriter writer(header, bytes);
    const std::uint32_t width = samples.grid().width;
    std::uint32_t row = 0;
    PixelSums part;
    const PixelRange all{0, films.front()->pixel_count()};
    read_films(films, samples, all, rows_of_piece(width) * width, [&](const PixelSums &sums) {
        const auto row_count = static_cast<std::uint32_t>(sums.pixel_count() / width);
        for (std::size_t i = 0; i < header.tiles.size(); ++i) {
            const Rectangle &pixels = header.tiles[i].pixels;
            const Rectangle tile{pixels.x - origin.x, pixels.y - origin.y, pixels.width, pixels.height};
            const RowsInTile rows(tile, row, row_count);
            if (rows.count() == 0)
                continue;
            part.resize(std::size_t{rows.count()} * tile.width);
            for_each_row(tile, rows, row, width, [&](std::size_t in_film, std::size_t in_part, std::size_t count) {
                part.copy(sums, in_film, count, in_part);
            });
            writer.write(i, std::uint64_t{rows.first - tile.y} * tile.width, part);
        }
        row += row_count;
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
        others.resize(std::size_t{row_count} * pixels.width);
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            const Rectangle tile{tiles[i].pixels.x - pixels.x, tiles[i].pixels.y - pixels.y, tiles[i].pixels.width,
                                 tiles[i].pixels.height};
            const RowsInTile rows(tile, row, row_count);
            if (rows.count() == 0)
                continue;
            part.resize(std::size_t{rows.count()} * tile.width);
            film.read(i, std::uint64_t{rows.first - tile.y} * tile.width, part);
            for_each_row(tile, rows, row, pixels.width,
                         [&](std::size_t in_film, std::size_t in_part, std::size_t count) {
                             others.copy(part, in_part, count, in_film);
                         });
        }
        PixelSums sums;
        sums.resize(others.pixel_count());
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
