// The bytes of a file, one after the other, unpacked if it is compressed by gzip or zstd.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace cli {

class ByteSource {
public:
    ByteSource() = default;
    ByteSource(const ByteSource &) = delete;
    ByteSource &operator=(const ByteSource &) = delete;
    virtual ~ByteSource() = default;

    // At least a byte and at most size (> 0) of them; returns how many, 0 at the end alone. Throws Failure:
    // ExitCode::file where the system cannot read, ExitCode::scene where what is compressed is damaged or cut short.
    virtual std::size_t read(char *bytes, std::size_t size) = 0;

    // How many are left; nothing where that is not known, as of pipes and of what is compressed.
    virtual std::optional<std::uint64_t> size_left() const { return std::nullopt; }

    // Goes on from that byte, counted from the first; false, and then nothing has changed, where only what comes next
    // can be read.
    virtual bool seek(std::uint64_t) { return false; }
};

// Throws Failure(ExitCode::file). The path - is standard input. Compression is known by the first bytes, not the name.
std::unique_ptr<ByteSource> open_bytes(const std::string &path);

// size bytes of a file as they are, from that offset on.
std::unique_ptr<ByteSource> open_part(const std::string &path, std::uint64_t offset, std::uint64_t size);

// Whether the file can be opened once more, to be read again or in another order.
bool is_regular_file(const std::string &path);

} // namespace cli
