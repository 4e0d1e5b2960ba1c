#include "cli/base/file.h"

#include "cli/base/text.h"
#include "lib/platform/process.h"

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <system_error>

namespace cli {
namespace {

bool is_temporary_name(const std::string &name) {
    int end = 0;
    std::sscanf(name.c_str(), ".pt-%*[0-9]-%*[0-9].tmp%n", &end);
    return end > 0 && static_cast<std::size_t>(end) == name.size();
}

namespace fs = std::filesystem;

fs::path folder_of(const fs::path &path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

// Returns an empty path if there is no file. Input and output may be the same terminal.
fs::path target_of(const NamedFile &file, bool is_input) {
    if (file.path != standard_stream)
        return file.path;
    if (is_input)
        return platform::regular_size(platform::standard_input) ? "/dev/stdin" : "";
    return "/dev/stdout"; // even a terminal, where two outputs would mix
}

// Whether both are one existing file, or one name in one folder.
bool is_same(const fs::path &one, const fs::path &other) {
    std::error_code error;
    if (one.empty() || other.empty() || one == other)
        return !one.empty() && one == other;
    if (fs::exists(one, error) || fs::exists(other, error))
        return fs::equivalent(one, other, error);
    const fs::path first = AtomicFile::target_of(one.string());
    const fs::path second = AtomicFile::target_of(other.string());
    return first.filename() == second.filename() && fs::equivalent(folder_of(first), folder_of(second), error);
}

} // namespace

// Short, because the target's name may have the maximum length.
std::string temporary_name(int attempt) {
    return ".pt-" + std::to_string(platform::process_number()) + "-" + std::to_string(attempt) + ".tmp";
}

void remove_abandoned(const std::filesystem::path &folder) {
    std::error_code error;
    const std::filesystem::directory_iterator files(folder.empty() ? "." : folder, error);
    if (error)
        return;
    for (auto file = begin(files); file != end(files) && !error; file.increment(error)) {
        if (is_temporary_name(file->path().filename().string()))
            platform::remove_abandoned(file->path());
    }
}

AtomicFile::AtomicFile(const std::string &path) : path_(path), target_(target_of(path)), file_(create_temporary()) {}

AtomicFile::~AtomicFile() {
    if (!file_.is_open())
        return;
    std::error_code ignored;
    file_.close(); // some systems cannot remove an open file
    fs::remove(temporary_, ignored);
}

std::filesystem::path AtomicFile::target_of(const std::string &path) {
    constexpr int most_links = 40; // Linux's limit (path_resolution(7))
    std::filesystem::path target = path;
    std::error_code error;
    for (int i = 0; i < most_links && is_symlink(fs::symlink_status(target, error)); ++i) {
        refuse_if(!platform::may_follow(target),
                  "cannot write " + path + ": the link " + target.string() +
                      " belongs to another user, and everybody may write in its folder; use a link of your own or of "
                      "the folder's owner",
                  ExitCode::file);
        target = target.parent_path() / std::filesystem::read_symlink(target, error);
    }
    return target;
}

void AtomicFile::check_writable(const std::string &path) {
    remove_abandoned(target_of(path).parent_path());
    const AtomicFile probe(path);
}

void AtomicFile::fail(int error) const {
    throw Failure(ExitCode::file, "cannot write " + path_ + ": " + std::generic_category().message(error));
}

// A rename would replace a write-protected file, or put a regular file in place of a device.
void AtomicFile::refuse_unsuitable_target() const {
    std::error_code error;
    const fs::file_status status = fs::status(target_, error);
    if (status.type() == fs::file_type::not_found)
        return;
    if (status.type() == fs::file_type::none)
        fail(error.default_error_condition().value());
    if (is_directory(status))
        fail(EISDIR);
    if (!is_regular_file(status))
        throw Failure(ExitCode::file, "cannot write " + path_ + ": not a regular file");
    if (!platform::may_write(target_))
        fail(errno);
}

platform::FileDescriptor AtomicFile::create_temporary() {
    refuse_unsuitable_target();
    for (int attempt = 0;; ++attempt) {
        temporary_ = target_.parent_path() / temporary_name(attempt);
        const int descriptor = platform::create_file(temporary_);
        if (descriptor >= 0 && platform::lock_created(descriptor))
            return platform::FileDescriptor(descriptor);
        if (descriptor >= 0)
            platform::close_file(descriptor);
        else if (errno != EEXIST)
            fail(errno);
    }
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const std::ptrdiff_t count = platform::write_some(file_.get(), bytes);
        if (count < 0)
            fail(errno);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void AtomicFile::commit() {
    if (!platform::rename_written(file_.get(), temporary_, target_))
        fail(errno);
    file_.close();
}

void require_distinct_files(const std::vector<NamedFile> &inputs, const std::vector<NamedFile> &outputs) {
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        const auto refuse_same = [&](const NamedFile &file, bool is_input) {
            refuse_if(is_same(target_of(*output, false), target_of(file, is_input)),
                      concat(output->role, " ", output->path, ": is the same file as ", file.role, " ", file.path));
        };
        for (const NamedFile &input : inputs)
            refuse_same(input, true);
        for (auto earlier = outputs.begin(); earlier != output; ++earlier)
            refuse_same(*earlier, false);
    }
}

void require_outside(const NamedFile &folder, const std::vector<NamedFile> &outputs) {
    std::error_code ignored;
    for (const NamedFile &output : outputs) {
        const bool is_file = !output.path.empty() && output.path != standard_stream;
        refuse_if(is_file && fs::equivalent(folder_of(AtomicFile::target_of(output.path)), folder.path, ignored),
                  concat(output.role, " ", output.path, ": must not be in the folder ", folder.path, " of ",
                         folder.role, ", whose files are inputs"));
    }
}

void OutputFile::write(std::span<const std::byte> bytes) {
    if (file_)
        file_->write(bytes);
    else
        std::cout.write(reinterpret_cast<const char *>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

void OutputFile::commit() {
    if (file_) {
        file_->commit();
    } else if (!std::cout.flush()) {
        std::cout.clear(); // prevents a second report at the end of the program
        throw Failure(ExitCode::file, "cannot write to standard output");
    }
}

void check_report_file(const std::string &path) {
    if (!path.empty() && path != standard_stream)
        AtomicFile::check_writable(path);
}

void write_report_file(const std::string &path, std::string_view text) {
    if (path.empty())
        return;
    OutputFile file(path);
    file.write(std::as_bytes(std::span(text)));
    file.commit();
}

void print_for_people(const std::string &lines, bool standard_output_is_taken) {
    if (standard_output_is_taken)
        print_message(lines);
    else
        std::cout << platform::printable_lines(lines) << std::flush;
}

} // namespace cli
