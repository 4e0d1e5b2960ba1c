#include "lib/render/saved_film.h"

#include "lib/base/rules.h"
#include "lib/film/tile_map.h"

#include <algorithm>
#include <string>

namespace pt {

namespace {

void refuse_added(const std::string &field, const std::string &value, const std::string &rule) {
    Violations violations;
    violations.add({.subject = "film", .member = field, .value = value, .rule = rule});
    violations.throw_if_any(PT_ERROR_INCOMPATIBLE);
}

// Whole rows of a film at a time.
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

// Copies the pixels of a tile's rows between them alone and the rows of the film from first_row on.
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
    read_films(films, samples, rows_of_piece(width) * width, [&](const PixelSums &sums) {
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

void require_addable(const FilmReader &film, const SampleSet &present) {
    const FilmTile &tile = film.header().tiles.front();
    if (const auto overlap = tile.samples.overlap(present))
        refuse_added("samples", text_of(tile.samples), text_of(*overlap) + " are in this context's film already");
    if (present.count() + tile.samples.count() > UINT32_MAX)
        refuse_added("samples", text_of(tile.samples), "a pixel holds at most 2^32 - 1");
}

void add(const FilmReader &film, const SampleRange &hull, vulkan::Device &device, DeviceFilm &to) {
    const std::uint64_t split = split_of(hull);
    const std::uint64_t film_split = split_of(film.header().tiles.front().samples.hull());
    DeviceFilm::NewSums all(device, to);
    PixelSums sums;
    PixelSums added;
    for_each_piece(to.pixel_count(), piece_pixels, [&](std::uint32_t first, std::uint32_t count) {
        sums.resize(count);
        added.resize(count);
        to.read(first, split, sums);
        film.read(0, first, added);
        if (film_split != split)
            added.fold_into(film_split < split ? older_part : newer_part);
        sums.add(added);
        all.write(first, sums);
    });
    PartUse parts;
    parts.extend(hull);
    all.replace(parts);
}

void require_within(const Rectangle &film, const Rectangle &pixels) {
    const auto text = [](const Rectangle &of) {
        return "rows [" + std::to_string(of.y) + ", " + std::to_string(std::uint64_t{of.y} + of.height) +
               "), columns [" + std::to_string(of.x) + ", " + std::to_string(std::uint64_t{of.x} + of.width) + ')';
    };
    const bool within = film.x >= pixels.x && film.y >= pixels.y && film.x + film.width <= pixels.x + pixels.width &&
                        film.y + film.height <= pixels.y + pixels.height;
    if (!within)
        refuse_added("tile", text(film), "must lie in " + text(pixels) + ", as in this context");
}

void replace(const Film &by, const SampleRange &hull, const Rectangle &pixels, vulkan::Device &device,
             DeviceFilm &film) {
    std::vector<std::byte> bytes(FilmLayout(by.header()).size_bytes());
    by.write(bytes);
    const FilmReader reader(bytes);
    const std::vector<FilmTile> &tiles = reader.header().tiles;
    DeviceFilm::NewSums all(device, film);
    PixelSums sums;
    PixelSums part;
    const std::uint32_t step = rows_of_piece(pixels.width);
    for (std::uint32_t row = 0; row < pixels.height; row += step) {
        const std::uint32_t row_count = std::min(step, pixels.height - row);
        sums = PixelSums();
        sums.resize(std::size_t{row_count} * pixels.width);
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            const Rectangle tile{tiles[i].pixels.x - pixels.x, tiles[i].pixels.y - pixels.y, tiles[i].pixels.width,
                                 tiles[i].pixels.height};
            const RowsInTile rows(tile, row, row_count);
            if (rows.count() == 0)
                continue;
            part.resize(std::size_t{rows.count()} * tile.width);
            reader.read(i, std::uint64_t{rows.first - tile.y} * tile.width, part);
            for_each_row(tile, rows, row, pixels.width,
                         [&](std::size_t in_film, std::size_t in_part, std::size_t count) {
                             sums.copy(part, in_part, count, in_film);
                         });
        }
        all.write(row * pixels.width, sums);
    }
    PartUse parts;
    parts.cover(hull);
    all.replace(parts);
}

} // namespace pt
