#include "cli/film/film_file.h"

#include "cli/base/atomic_file.h"
#include "cli/base/exit_code.h"
#include "cli/base/text_file.h"

#include <zstd.h>

#include <cstdint>
#include <memory>

namespace cli {
namespace {

// Of the lowest levels the sums of 1920x1080 pixels take a seventh of their size at 1.2 GB/s a processor with 1, at 2.9
// GB/s with -1, which makes files 6% larger: cli/README.md says how that was measured.
constexpr int compression_level = -1;

// A block of at most 128 KiB takes 4 bytes at the least (RFC 8878, 3.1.1.2): what claims more is damaged.
constexpr std::uint64_t most_ratio = 32768;

[[noreturn]] void refuse(const std::string &path, const std::string &reason) {
    throw Failure(ExitCode::usage, path + ": " + reason);
}

bool is_packed(std::span<const std::byte> bytes) {
    std::uint32_t magic = 0;
    for (std::size_t i = 0; i < sizeof magic && i < bytes.size(); ++i)
        magic |= std::to_integer<std::uint32_t>(bytes[i]) << (8 * i);
    return magic == ZSTD_MAGICNUMBER;
}

std::vector<std::byte> unpacked(const std::string &path, std::span<const std::byte> bytes) {
    const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
    if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR || size / most_ratio > bytes.size())
        refuse(path, "damaged or cut short: the head of its zstd frame is no film's");
    std::vector<std::byte> film(size);
    const std::size_t count = ZSTD_decompress(film.data(), film.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(count) != 0 || count != film.size()) {
        refuse(path, std::string("damaged or cut short: ") +
                         (ZSTD_isError(count) != 0 ? ZSTD_getErrorName(count) : "its zstd frame is too short"));
    }
    return film;
}

} // namespace

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

std::vector<std::byte> read_film_file(const std::string &path) {
    const std::string text = read_file(path);
    const auto bytes = std::as_bytes(std::span(text));
    return is_packed(bytes) ? unpacked(path, bytes) : std::vector<std::byte>(bytes.begin(), bytes.end());
}

} // namespace cli
