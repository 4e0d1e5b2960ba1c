#include "cli/film/film_handle.h"

#include "cli/base/exit_code.h"
#include "cli/film/film_words.h"

namespace cli {
namespace {

// Of calls whose arguments are not the user's.
void require(pt_result result) {
    if (result < 0)
        throw Failure(exit_code_of(result), pt_last_error(nullptr));
}

template <typename Struct>
Struct sized() {
    Struct value{};
    value.struct_size = sizeof(Struct);
    return value;
}

} // namespace

FilmHandle::FilmHandle(const std::string &path, std::span<const std::byte> bytes) {
    const pt_result result = pt_open_film(bytes.data(), bytes.size(), &film_);
    if (result < 0)
        throw Failure(exit_code_of(result), film_words(path, last_error(nullptr)));
}

void FilmHandle::merge(const std::string &path, std::span<const std::byte> bytes) {
    const pt_result result = pt_merge_film(film_, bytes.data(), bytes.size());
    if (result < 0)
        throw Failure(exit_code_of(result), film_words(path, last_error(nullptr)));
}

pt_film_info FilmHandle::info() const {
    auto info = sized<pt_film_info>();
    require(pt_get_film_info(film_, &info));
    return info;
}

pt_stats FilmHandle::stats() const {
    auto stats = sized<pt_stats>();
    require(pt_get_film_stats(film_, &stats));
    return stats;
}

std::vector<pt_film_tile> FilmHandle::tiles() const {
    std::vector<pt_film_tile> tiles(info().tile_count, sized<pt_film_tile>());
    for (std::uint32_t i = 0; i < tiles.size(); ++i)
        require(pt_get_film_tile(film_, i, &tiles[i]));
    return tiles;
}

std::vector<pt_sample_range> FilmHandle::ranges(std::uint32_t tile) const {
    std::uint32_t count = 0;
    require(pt_get_film_ranges(film_, tile, nullptr, &count));
    std::vector<pt_sample_range> ranges(count);
    require(pt_get_film_ranges(film_, tile, ranges.data(), &count));
    return ranges;
}

std::vector<float> FilmHandle::read_image(std::uint32_t quantity) const {
    const pt_film_info film = info();
    std::vector<float> values(std::size_t{3} * film.columns * film.rows);
    auto image = sized<pt_image>();
    image.quantity = quantity;
    image.data = values.data();
    image.size_bytes = values.size() * sizeof(float);
    require(pt_read_film(film_, &image));
    return values;
}

std::vector<std::byte> FilmHandle::bytes() const {
    std::uint64_t size = 0;
    require(pt_write_film(film_, nullptr, &size));
    std::vector<std::byte> bytes(size);
    require(pt_write_film(film_, bytes.data(), &size));
    return bytes;
}

} // namespace cli
