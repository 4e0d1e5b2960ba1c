#pragma once

#include "lib/base/digest.h"
#include "lib/film/film_header.h"
#include "lib/film/pixel_sums.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace pt {

class FilmLayout {
public:
    explicit FilmLayout(const FilmHeader &header);

    std::uint64_t size_bytes() const { return size_bytes_; }

    // Parts without samples are not stored.
    bool has_plane(std::size_t tile, std::size_t plane) const;
    std::uint64_t plane_offset(std::size_t tile, std::size_t plane) const;
    const PartCounts &counts(std::size_t tile) const { return tiles_[tile].counts; }

private:
    struct Tile {
        std::uint64_t offset;
        std::uint64_t pixel_count;
        PartCounts counts;
    };

    std::vector<Tile> tiles_;
    bool has_coverage_;
    std::uint64_t size_bytes_;
};

// Throws PT_ERROR_INVALID_ARGUMENT if the caller's memory is too small.
void require_room(std::uint64_t size_bytes, std::uint64_t needed);

// The caller calls write() for all pixels of all tiles, then end().
class FilmWriter {
public:
    FilmWriter(const FilmHeader &header, std::span<std::byte> bytes);

    void write(std::size_t tile, std::uint64_t first_pixel, const PixelSums &sums);
    void end();

private:
    FilmLayout layout_;
    std::span<std::byte> bytes_;
};

// Passes on a film's bytes in pieces of at most a megabyte. The caller calls add() for each stored plane, tile by tile,
// then end().
class FilmStream {
public:
    using Receive = std::function<void(std::span<const std::byte>)>;

    FilmStream(const FilmHeader &header, Receive receive);

    void add(std::span<const std::uint32_t> words) { add(std::as_bytes(words)); }
    void end();

private:
    void add(std::span<const std::byte> bytes);
    void hand_on();

    Receive receive_;
    Digest digest_;
    std::vector<std::byte> piece_;
};

class FilmReader {
public:
    // Throws PT_ERROR_INCOMPATIBLE if the bytes are not a film, are damaged, or have a wrong size.
    explicit FilmReader(std::span<const std::byte> bytes);

    const FilmHeader &header() const { return header_; }

    // Throws PT_ERROR_INCOMPATIBLE if the tile's samples cannot have these sums.
    void read(std::size_t tile, std::uint64_t first_pixel, PixelSums &sums) const;

private:
    std::span<const std::byte> bytes_;
    FilmHeader header_;
    FilmLayout layout_;
};

} // namespace pt
