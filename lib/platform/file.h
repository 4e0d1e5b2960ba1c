// Files by descriptor, for tasks that std::filesystem lacks. errno has the reason of a failure.
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

// These four return -1 on failure.
int open_to_read(const std::filesystem::path &path); // does not wait for the writer of a named pipe
int create_file(const std::filesystem::path &path);  // opens for writing; EEXIST if the file exists
std::ptrdiff_t read_some(int descriptor, std::span<char> bytes);
std::ptrdiff_t write_some(int descriptor, std::span<const std::byte> bytes);

// Protects a new file from remove_abandoned() of other processes. Returns false if the file was already removed. On
// file systems without locks no file is removed.
bool lock_created(int descriptor);

// Removes a file unless a process has locked it.
void remove_abandoned(const std::filesystem::path &path);

// Renames a new file after its bytes are on the disk. The new file gets the permissions of a replaced file.
bool rename_written(int descriptor, const std::filesystem::path &from, const std::filesystem::path &to);

// Returns no value if the file is not regular.
std::optional<std::uint64_t> regular_size(int descriptor);

// Returns a text that changes whenever the file is written or replaced, or no value if there is no file.
std::optional<std::string> file_state(const std::filesystem::path &path);

bool may_write(const std::filesystem::path &path);

// Whether it is safe to write through this symbolic link, which other users may have created.
bool may_follow(const std::filesystem::path &link);

} // namespace platform
