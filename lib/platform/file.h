// Files by their descriptors: what programs need beyond std::filesystem. Reasons of failures are in errno.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace platform {

inline constexpr int standard_input = 0;
inline constexpr int standard_output = 1;
inline constexpr int standard_error = 2;

// Names are UTF-8, whatever the process has for other texts.
inline std::filesystem::path path_of(std::string_view text) {
    return std::u8string(text.begin(), text.end());
}

void close_file(int descriptor);

class FileDescriptor {
public:
    explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
    FileDescriptor(const FileDescriptor &) = delete;
    FileDescriptor &operator=(const FileDescriptor &) = delete;
    ~FileDescriptor() { close(); }

    bool is_open() const { return descriptor_ >= 0; }
    int get() const { return descriptor_; }

    void close() {
        const int descriptor = std::exchange(descriptor_, -1);
        if (descriptor >= 0)
            close_file(descriptor);
    }

private:
    int descriptor_;
};

// These return -1 if they fail.
int open_to_read(const std::filesystem::path &path); // without waiting for the writer of a named pipe
int create_file(const std::filesystem::path &path);  // to be written; EEXIST if there is one
std::ptrdiff_t read_some(int descriptor, std::span<char> bytes);
std::ptrdiff_t write_some(int descriptor, std::span<const std::byte> bytes);

// Keeps remove_abandoned() of other processes from a file that was just created. False if it was removed in between.
// On a file system without locks it is true, and nothing is ever removed there.
bool lock_created(int descriptor);

// Removes a file unless a process has it locked.
void remove_abandoned(const std::filesystem::path &path);

// Gives a file that was created its final name, in place of a file whose permissions it takes over, once its bytes are
// on the disk: otherwise a crash could leave an empty file in that place.
bool rename_written(int descriptor, const std::filesystem::path &from, const std::filesystem::path &to);

// Nothing for what is no regular file.
std::optional<std::uint64_t> regular_size(int descriptor);

// A text that changes whenever the file is written or replaced; nothing if there is no such file.
std::optional<std::string> file_state(const std::filesystem::path &path);

bool may_write(const std::filesystem::path &path);

// Whether a symbolic link to what is to be written is followed, where others may have put it.
bool may_follow(const std::filesystem::path &link);

} // namespace platform
