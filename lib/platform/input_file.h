// Files that are read from their beginning on, as far as the reader wants.
#pragma once

#include "lib/platform/file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace platform {

// The reason alone, without the file's name.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// All functions throw InputError.
class InputFile {
public:
    // Opens a regular file. Everything else is refused at once: a named pipe may wait for its writer, and a device have
    // no end.
    explicit InputFile(const std::filesystem::path &path);

    // Standard input, whatever it is.
    InputFile() = default;

    // In bytes; 0 for standard input.
    std::uint64_t size() const { return size_; }

    // The first `count` bytes; all of a shorter file. Valid until the next call.
    std::string_view first(std::size_t count);

    std::string all();

    // All of a text. Anything with a NUL byte is none, and is read up to the block with that byte.
    std::string text();

private:
    bool take_block(); // false at the end

    FileDescriptor file_{-1}; // closed: standard input
    std::uint64_t size_ = 0;
    std::string bytes_; // so far
};

} // namespace platform
