#include "lib/render/saved_film.h"

#include "lib/base/rules.h"

#include <string>

namespace pt {

namespace {

void refuse(const std::string &field, const std::string &value, const std::string &rule) {
    Violations violations;
    violations.add({.subject = "film", .member = field, .value = value, .rule = rule});
    violations.throw_if_any(PT_ERROR_INCOMPATIBLE);
}

std::string text_of(const Rectangle &pixels) {
    return "rows [" + std::to_string(pixels.y) + ", " + std::to_string(std::uint64_t{pixels.y} + pixels.height) +
           "), columns [" + std::to_string(pixels.x) + ", " + std::to_string(std::uint64_t{pixels.x} + pixels.width) +
           ')';
}

} // namespace

void save(std::span<DeviceFilm *const> films, const FilmHeader &header, std::span<std::byte> bytes) {
    FilmWriter writer(header, bytes);
    std::uint64_t first_pixel = 0;
    read_films(films, header.tiles.front().samples, piece_pixels, [&](const PixelSums &sums) {
        writer.write(0, first_pixel, sums);
        first_pixel += sums.pixel_count();
    });
    writer.end();
}

void require_addable(const FilmReader &film, const Rectangle &pixels, const SampleSet &present) {
    const std::vector<FilmTile> &tiles = film.header().tiles;
    if (tiles.size() != 1)
        refuse("tiles", std::to_string(tiles.size()), "must be one");
    const FilmTile &tile = tiles.front();
    if (tile.pixels != pixels)
        refuse("tile", text_of(tile.pixels), "must be " + text_of(pixels) + ", as in this context");
    if (const auto overlap = tile.samples.overlap(present))
        refuse("samples", text_of(tile.samples), text_of(*overlap) + " are in this context's film already");
    if (present.count() + tile.samples.count() > UINT32_MAX)
        refuse("samples", text_of(tile.samples), "a pixel holds at most 2^32 - 1");
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

} // namespace pt
