#include "cli/film/film.h"

#include "cli/base/file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string_view>
#include <zstd.h>

namespace cli {
namespace {

constexpr std::array<std::string_view, 3> digests{"scene", "camera", "kernel"};

std::string words_of(const std::string &path, const BrokenRule &rule) {
    if (std::find(digests.begin(), digests.end(), rule.member) != digests.end())
        return path + ": was made with another " + rule.member + " (" + rule.value + ": " + rule.rule + ")";
    const std::string text = rule.text(path + ": " + rule.member);
    return rule.member == "device" ? text + "; choose that model of device by --device, or begin anew" : text;
}

std::string without_subject(const std::string &message) {
    constexpr std::string_view subject = "film: ";
    return message.starts_with(subject) ? message.substr(subject.size()) : message;
}

// A line for each difference, such as "part.ptfilm: seed = 7: must be 8, as in this context".
std::string film_words(const std::string &path, const LibraryError &error) {
    if (error.rules.empty())
        return path + ": " + without_subject(error.message);
    return error.in_words([&](const BrokenRule &rule) { return words_of(path, rule); });
}

void require_film(pt_result result, const std::string &path, const pt_context *context = nullptr) {
    if (result < 0)
        throw Failure(exit_code_of(result), film_words(path, last_error(context)));
}

// Fast, with slightly larger files.
constexpr int compression_level = -1;

// A block of at most 128 KiB takes at least 4 bytes (RFC 8878, 3.1.1.2), so files with a higher ratio are damaged.
constexpr std::uint64_t most_ratio = 32768;

[[noreturn]] void refuse(const std::string &path, const std::string &reason) {
    throw Failure(ExitCode::usage, path + ": " + reason);
}

std::size_t unpacked_size(platform::InputFile &file, const std::string &path) {
    constexpr std::size_t longest_head = 18; // RFC 8878, 3.1.1.1
    const std::string_view head = file.first(longest_head);
    const unsigned long long size = ZSTD_getFrameContentSize(head.data(), head.size());
    if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR || size / most_ratio > file.size())
        refuse(path, "damaged or cut short: the header of its zstd frame is not a film's");
    return size;
}

std::vector<std::byte> unpacked(platform::InputFile &file, const std::string &path) {
    std::vector<std::byte> film(unpacked_size(file, path));
    const std::string bytes = file.all();
    const std::size_t count = ZSTD_decompress(film.data(), film.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(count) != 0 || count != film.size()) {
        refuse(path, std::string("damaged or cut short: ") +
                         (ZSTD_isError(count) != 0 ? ZSTD_getErrorName(count) : "its zstd frame is too short"));
    }
    return film;
}

} // namespace

FilmHandle::FilmHandle(const std::string &path, std::span<const std::byte> bytes) {
    require_film(pt_open_film(bytes.data(), bytes.size(), &film_), path);
}

void FilmHandle::merge(const std::string &path, std::span<const std::byte> bytes) {
    require_film(pt_merge_film(film_, bytes.data(), bytes.size()), path);
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

pt_error_estimate FilmHandle::error_estimate() const {
    auto error = sized<pt_error_estimate>();
    require(pt_get_film_error_estimate(film_, &error));
    return error;
}

std::vector<pt_sample_range> FilmHandle::ranges(std::uint32_t tile) const {
    return elements_of<pt_sample_range>(
        [&](auto *to, auto *count) { require(pt_get_film_ranges(film_, tile, to, count)); });
}

pt_sample_range FilmHandle::hull() const {
    pt_sample_range hull{std::numeric_limits<std::uint64_t>::max(), 0};
    for (std::uint32_t tile = 0; tile < info().tile_count; ++tile) {
        const std::vector<pt_sample_range> of_tile = ranges(tile);
        hull.first = std::min(hull.first, of_tile.front().first);
        hull.end = std::max(hull.end, of_tile.back().end);
    }
    return hull;
}

// Calls the library's merge, which refuses other seeds and lists all differences.
void FilmHandle::require_same_picture(const std::string &path, std::span<const std::byte> bytes) {
    constexpr std::array<std::string_view, 4> allowed{"seed", "estimator_version", "kernel", "device"};
    const pt_result result = pt_merge_film(film_, bytes.data(), bytes.size());
    LibraryError error = last_error(nullptr);
    std::erase_if(error.rules, [&](const BrokenRule &rule) { return std::ranges::count(allowed, rule.member) > 0; });
    if (!error.rules.empty())
        throw Failure(exit_code_of(result), film_words(path, error));
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
    return elements_of<std::byte, std::uint64_t>(
        [&](auto *to, auto *size) { require(pt_write_film(film_, to, size)); });
}

void save_film(const Context &context, std::vector<std::byte> &bytes) {
    std::uint64_t size = 0;
    context.require(pt_save_film(context.get(), nullptr, &size));
    bytes.resize(size);
    context.require(pt_save_film(context.get(), bytes.data(), &size));
}

void add_film(const Context &context, const std::string &path, std::span<const std::byte> bytes) {
    require_film(pt_add_film(context.get(), bytes.data(), bytes.size()), path, context.get());
}

std::string ranges_text(const std::vector<pt_sample_range> &ranges) {
    std::string text;
    for (const pt_sample_range &range : ranges)
        text += (text.empty() ? "[" : ", [") + std::to_string(range.first) + ", " + std::to_string(range.end) + ")";
    return text.empty() ? "none" : text;
}

std::uint64_t sample_count_of(const std::vector<pt_sample_range> &ranges) {
    std::uint64_t count = 0;
    for (const pt_sample_range &range : ranges)
        count += range.end - range.first;
    return count;
}

std::vector<pt_sample_range> missing_of(const pt_sample_range &wanted, const std::vector<pt_sample_range> &there) {
    std::vector<pt_sample_range> missing;
    std::uint64_t next = wanted.first;
    for (const pt_sample_range &range : there) {
        if (next < std::min(range.first, wanted.end))
            missing.push_back({next, std::min(range.first, wanted.end)});
        next = std::max(next, range.end);
    }
    if (next < wanted.end)
        missing.push_back({next, wanted.end});
    return missing;
}

void write_film_file(const std::string &path, std::span<const std::byte> film) {
    const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
    std::vector<std::byte> piece(ZSTD_CStreamOutSize());
    if (!context)
        throw std::bad_alloc();
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, compression_level);
    ZSTD_CCtx_setPledgedSrcSize(context.get(), film.size());
    ZSTD_inBuffer input{film.data(), film.size(), 0};
    AtomicFile file(path);
    for (std::size_t left = 1; left != 0;) {
        ZSTD_outBuffer output{piece.data(), piece.size(), 0};
        left = ZSTD_compressStream2(context.get(), &output, &input, ZSTD_e_end);
        if (ZSTD_isError(left) != 0)
            throw Failure(ExitCode::internal, path + ": zstd: " + ZSTD_getErrorName(left));
        file.write(std::span(piece).first(output.pos));
    }
    file.commit();
}

// Reads only the first bytes of a file that is not a film.
std::vector<std::byte> read_film_file(const std::string &path) {
    return read_file(path, [&](platform::InputFile &file) {
        constexpr std::string_view packed = "\x28\xb5\x2f\xfd";
        constexpr std::string_view plain = "pt film ";
        if (file.first(packed.size()) == packed)
            return unpacked(file, path);
        const std::string text = file.first(plain.size()) == plain ? file.all() : std::string(file.first(plain.size()));
        const auto bytes = std::as_bytes(std::span(text));
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    });
}

} // namespace cli
