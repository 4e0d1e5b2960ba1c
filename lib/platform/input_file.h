#pragma once

#include "lib/platform/file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace platform {

// what() does not include the file's name.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Any function can throw InputError.
class InputFile {
public:
    // Opens only regular files, because a named pipe may wait for its writer, and a device may be endless.
    explicit InputFile(const std::filesystem::path &path);

    // Reads standard input, which may be a pipe.
    InputFile() = default;

    // 0 for standard input.
    std::uint64_t size() const { return size_; }

    // Returns the first `count` bytes, or all of a shorter file. Valid until the next call.
    std::string_view first(std::size_t count);

    std::string all();

    // Stops after a block with a NUL byte, because such a file is not text.
    std::string text();

private:
    bool take_block(); // false at the end

    FileDescriptor file_{-1}; // standard input if it is not open
    std::uint64_t size_ = 0;
    std::string bytes_; // read so far
};

} // namespace platform
