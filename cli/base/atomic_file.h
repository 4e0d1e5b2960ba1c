// Owns a file that appears whole or not at all: written under a temporary name beside its place, then renamed.
// Called by the image writer and the reports; also before rendering, to see that a file can be written.
#pragma once

#include "cli/base/file_descriptor.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace cli {

class AtomicFile {
public:
    // Creates the temporary file. Like the others throws Failure(ExitCode::file), which says why.
    explicit AtomicFile(const std::string &path);
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;
    ~AtomicFile(); // removes the temporary file unless committed

    void write(std::span<const std::byte> bytes);
    void commit();

    static void write_text(const std::string &path, std::string_view text) {
        AtomicFile file(path);
        file.write(std::as_bytes(std::span(text)));
        file.commit();
    }

    // All that the constructor checks, and leaves nothing behind.
    static void check_writable(const std::string &path) { const AtomicFile probe(path); }

    // The file that is written: a rename would replace a symbolic link, while users mean what it points to, be it
    // there yet or not.
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
