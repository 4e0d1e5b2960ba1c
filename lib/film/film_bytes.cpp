#include "lib/film/film_bytes.h"

#include "lib/base/error.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>
#include <utility>

namespace pt {

namespace {

static_assert(std::endian::native == std::endian::little, "the bytes of a film are little-endian");

constexpr std::size_t most_piece_bytes = 1U << 20;

constexpr std::uint64_t checksum_bytes = sizeof(std::uint64_t);

std::string_view header_text(std::span<const std::byte> bytes) {
    const std::string_view all(reinterpret_cast<const char *>(bytes.data()), bytes.size());
    const std::size_t end = all.find("\n\n");
    return end == std::string_view::npos ? all : all.substr(0, end + 2);
}

std::uint64_t stored_checksum(std::span<const std::byte> bytes) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.last(checksum_bytes).data(), checksum_bytes);
    return value;
}

} // namespace

FilmLayout::FilmLayout(const FilmHeader &header) : has_coverage_(pt::has_coverage(header.identity)) {
    std::uint64_t offset = text_of(header).size();
    for (const FilmTile &tile : header.tiles) {
        tiles_.push_back({offset, tile.pixels.pixel_count(), part_counts(tile.samples)});
        offset = plane_offset(tiles_.size() - 1, film_planes(has_coverage_));
    }
    size_bytes_ = offset + checksum_bytes;
}

bool FilmLayout::has_plane(std::size_t tile, std::size_t plane) const {
    return plane == gpu::FILM_COVERED ? has_coverage_ : tiles_[tile].counts[plane / gpu::FILM_WORDS] > 0;
}

std::uint64_t FilmLayout::plane_offset(std::size_t tile, std::size_t plane) const {
    const Tile &of = tiles_[tile];
    std::uint64_t stored = 0;
    for (std::size_t before = 0; before < plane; ++before)
        stored += has_plane(tile, before) ? 1 : 0;
    return of.offset + stored * of.pixel_count * sizeof(std::uint32_t);
}

void require_room(std::uint64_t size_bytes, std::uint64_t needed) {
    if (size_bytes < needed)
        refuse_argument("film", "size_bytes", std::to_string(size_bytes), "must be >= " + std::to_string(needed));
}

FilmWriter::FilmWriter(const FilmHeader &header, std::span<std::byte> bytes) : layout_(header), bytes_(bytes) {
    const std::string text = text_of(header);
    std::memcpy(bytes.data(), text.data(), text.size());
}

void FilmWriter::write(std::size_t tile, std::uint64_t first_pixel, const PixelSums &sums) {
    for (std::size_t plane = 0; plane < sums.plane_count(); ++plane) {
        if (!layout_.has_plane(tile, plane))
            continue;
        const auto words = std::as_bytes(sums.plane(plane));
        const std::uint64_t offset = layout_.plane_offset(tile, plane) + first_pixel * sizeof(std::uint32_t);
        std::memcpy(bytes_.subspan(offset, words.size()).data(), words.data(), words.size());
    }
}

void FilmWriter::end() {
    const std::uint64_t value = checksum(bytes_.first(layout_.size_bytes() - checksum_bytes));
    std::memcpy(bytes_.subspan(layout_.size_bytes() - checksum_bytes).data(), &value, checksum_bytes);
}

FilmStream::FilmStream(const FilmHeader &header, Receive receive) : receive_(std::move(receive)) {
    piece_.reserve(most_piece_bytes);
    const std::string text = text_of(header);
    add(std::as_bytes(std::span(text)));
}

void FilmStream::add(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const auto taken = bytes.first(std::min(bytes.size(), most_piece_bytes - piece_.size()));
        piece_.insert(piece_.end(), taken.begin(), taken.end());
        bytes = bytes.subspan(taken.size());
        if (piece_.size() == most_piece_bytes)
            hand_on();
    }
}

void FilmStream::hand_on() {
    digest_.add_bytes(piece_);
    receive_(piece_);
    piece_.clear();
}

void FilmStream::end() {
    hand_on();
    const std::uint64_t value = digest_.checksum();
    receive_(std::as_bytes(std::span(&value, 1)));
}

FilmReader::FilmReader(std::span<const std::byte> bytes) :
    bytes_(bytes),
    header_(parsed_film_header(header_text(bytes))),
    layout_(header_) {
    if (bytes.size() != layout_.size_bytes())
        throw Error(PT_ERROR_INCOMPATIBLE,
                    "film: it has " + std::to_string(bytes.size()) + " bytes, but its header describes " +
                        std::to_string(layout_.size_bytes()) + ": it is truncated, or other bytes follow");
    if (stored_checksum(bytes) != checksum(bytes.first(bytes.size() - checksum_bytes)))
        throw Error(PT_ERROR_INCOMPATIBLE, "film: its checksum does not match its bytes, which are damaged");
}

void FilmReader::read(std::size_t tile, std::uint64_t first_pixel, PixelSums &sums) const {
    for (std::size_t plane = 0; plane < sums.plane_count(); ++plane) {
        const auto words = std::as_writable_bytes(sums.plane(plane));
        if (!layout_.has_plane(tile, plane)) {
            std::ranges::fill(words, std::byte{0});
            continue;
        }
        const std::uint64_t offset = layout_.plane_offset(tile, plane) + first_pixel * sizeof(std::uint32_t);
        std::memcpy(words.data(), bytes_.subspan(offset, words.size()).data(), words.size());
    }
    if (!sums.holds(layout_.counts(tile)))
        throw Error(PT_ERROR_INCOMPATIBLE, "film: its sums cannot come from its samples");
}

} // namespace pt
