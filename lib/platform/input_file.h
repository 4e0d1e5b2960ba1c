// Reads files from their beginning, as far as wanted.
#pragma once

#include "lib/platform/file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace platform {

// The reason, without the file's name.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// All functions throw InputError.
class InputFile {
public:
    // Opens regular files only: a named pipe may wait for its writer, a device may have no end.
    explicit InputFile(const std::filesystem::path &path);

    // Standard input, of any kind.
    InputFile() = default;

    // Bytes; 0 for standard input.
    std::uint64_t size() const { return size_; }

    // The first `count` bytes, or all of a shorter file. Valid until the next call.
    std::string_view first(std::size_t count);

    std::string all();

    // A file with a NUL byte is no text, and is read only up to that block.
    std::string text();

private:
    bool take_block(); // false at the end

    FileDescriptor file_{-1}; // closed: standard input
    std::uint64_t size_ = 0;
    std::string bytes_; // so far
};

} // namespace platform
