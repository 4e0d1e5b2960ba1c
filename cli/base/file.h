// Atomic files: outputs are written beside their target, then renamed. A lock marks temporary files in use.
#pragma once

#include "cli/base/exit_code.h"
#include "lib/platform/file.h"
#include "lib/scene_file/read_file.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// `attempt` is the number of earlier names, which already existed.
std::string temporary_name(int attempt);

void remove_abandoned(const std::filesystem::path &folder);

class AtomicFile {
public:
    // All functions throw Failure(ExitCode::file).
    explicit AtomicFile(const std::string &path);
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;
    ~AtomicFile();

    void write(std::span<const std::byte> bytes);
    void commit();

    // Does not leave a file behind.
    static void check_writable(const std::string &path);

    // Symbolic links are followed, because a rename would replace the link. Refuses another user's link in a sticky
    // folder that everybody can write, unless the folder's owner owns the link.
    static std::filesystem::path target_of(const std::string &path);

private:
    [[noreturn]] void fail(int error) const;
    void refuse_unsuitable_target() const;
    platform::FileDescriptor create_temporary();

    std::string path_;
    std::filesystem::path target_;
    std::filesystem::path temporary_;
    platform::FileDescriptor file_;
};

// `role` is the option for the file, such as "--stats".
struct NamedFile {
    std::string role;
    std::string path; // empty if there is no file; "-" for standard input or output
};

// Throws Failure(ExitCode::usage) if an output is also an input or another output, through any path or link.
void require_distinct_files(const std::vector<NamedFile> &inputs, const std::vector<NamedFile> &outputs);

// Throws Failure(ExitCode::usage) for outputs directly in the folder.
void require_outside(const NamedFile &folder, const std::vector<NamedFile> &outputs);

inline constexpr std::string_view standard_stream = "-";

class OutputFile {
public:
    // All functions throw Failure(ExitCode::file).
    explicit OutputFile(const std::string &path) {
        if (path != standard_stream)
            file_.emplace(path);
    }

    void write(std::span<const std::byte> bytes);
    void commit();

private:
    std::optional<AtomicFile> file_;
};

void check_report_file(const std::string &path);
void write_report_file(const std::string &path, std::string_view text);

void print_for_people(const std::string &lines, bool standard_output_is_taken);

// Throws Failure(ExitCode::file) if the file cannot be read.
template <typename Read>
auto read_file(const std::string &path, Read read) {
    return with_exit_code([&] { return pt::read_file(path, read); });
}

} // namespace cli
