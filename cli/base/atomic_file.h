// A file that appears whole or not at all: it is written under a temporary name beside its place, then renamed. A lock
// tells a temporary file in use from one that a killed program has left.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace cli {

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
            ::close(descriptor);
    }

private:
    int descriptor_;
};

// A name in which nobody else's files are mistaken for ours; attempt: counts the names that are taken already.
std::string temporary_name(int attempt);

// Locks a temporary file that was just created. False if it was removed in between, as an abandoned one. On a file
// system without locks it is true, and nothing is ever removed there.
bool lock_temporary(int descriptor);

// Removes temporary files of that folder which nobody has locked: their programs were killed. What cannot be removed
// stays.
void remove_abandoned(const std::filesystem::path &folder);

class AtomicFile {
public:
    // Creates the temporary file. This and all functions below throw Failure(ExitCode::file) with the reason.
    explicit AtomicFile(const std::string &path);
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;
    ~AtomicFile(); // removes the temporary file unless committed

    void write(std::span<const std::byte> bytes);
    void commit();

    // Checks all that the constructor checks, and leaves no file behind: nor those of programs that were killed while
    // they wrote in that folder.
    static void check_writable(const std::string &path);

    // The file that is written. Symbolic links are followed, whether or not their target exists yet: a rename would
    // replace the link itself. Those of other users in sticky folders where everybody may write are refused by
    // Failure(ExitCode::file), unless they belong to the folder's owner.
    static std::filesystem::path target_of(const std::string &path);

private:
    [[noreturn]] void fail(int error) const;
    void refuse_unsuitable_target() const;
    FileDescriptor create_temporary();

    std::string path_; // as the user wrote it, for messages
    std::filesystem::path target_;
    std::filesystem::path temporary_;
    FileDescriptor file_;
};

} // namespace cli
