// Packs texts as gzip and zstd do, through their libraries.
#pragma once

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace packed {

inline std::string gzip(const std::string &text) {
    z_stream stream{};
    constexpr int gzip_window = 16 + MAX_WBITS;
    if (deflateInit2(&stream, 1, Z_DEFLATED, gzip_window, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("no gzip");
    std::string bytes(deflateBound(&stream, text.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef *>(bytes.data());
    stream.avail_out = static_cast<uInt>(bytes.size());
    if (deflate(&stream, Z_FINISH) != Z_STREAM_END)
        throw std::runtime_error("gzip does not end");
    bytes.resize(stream.total_out);
    deflateEnd(&stream);
    return bytes;
}

inline std::string zstd(const std::string &text) {
    std::string bytes(ZSTD_compressBound(text.size()), '\0');
    bytes.resize(ZSTD_compress(bytes.data(), bytes.size(), text.data(), text.size(), 1));
    return bytes;
}

// One after the other, each by itself.
inline std::string in_pieces(std::string (*pack)(const std::string &), const std::string &text, std::size_t size) {
    std::string bytes;
    for (std::size_t first = 0; first < text.size(); first += size)
        bytes += pack(text.substr(first, size));
    return bytes;
}

} // namespace packed
