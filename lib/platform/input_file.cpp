#include "lib/platform/input_file.h"

#include <cerrno>
#include <span>
#include <system_error>
#include <utility>

namespace platform {
namespace {

constexpr std::size_t block = std::size_t{1} << 16;

[[noreturn]] void fail(int error) {
    throw InputError(std::generic_category().message(error));
}

// Refuses a path with a NUL byte, where the system would end the name.
int opened(const std::filesystem::path &path) {
    if (path.native().find(std::filesystem::path::value_type{}) != std::filesystem::path::string_type::npos)
        throw InputError("the name of a file must not have a NUL byte");
    return open_to_read(path);
}

} // namespace

InputFile::InputFile(const std::filesystem::path &path) : file_(opened(path)) {
    if (!file_.is_open())
        fail(errno);
    const std::optional<std::uint64_t> size = regular_size(file_.get());
    std::error_code ignored;
    if (!size && std::filesystem::is_directory(path, ignored))
        fail(EISDIR);
    if (!size)
        throw InputError("not a regular file");
    size_ = *size;
}

std::string_view InputFile::first(std::size_t count) {
    while (bytes_.size() < count && take_block()) {
    }
    return std::string_view(bytes_).substr(0, count);
}

std::string InputFile::all() {
    bytes_.reserve(size_ + block);
    while (take_block()) {
    }
    return std::exchange(bytes_, {});
}

std::string InputFile::text() {
    for (std::size_t seen = 0; take_block() && bytes_.find('\0', seen) == std::string::npos; seen = bytes_.size())
        bytes_.reserve(size_ + block);
    return std::exchange(bytes_, {});
}

bool InputFile::take_block() {
    const std::size_t used = bytes_.size();
    bytes_.resize(used + block);
    const int descriptor = file_.is_open() ? file_.get() : standard_input;
    const std::ptrdiff_t count = read_some(descriptor, std::span(bytes_).subspan(used));
    if (count < 0)
        fail(errno);
    bytes_.resize(used + static_cast<std::size_t>(count));
    return count > 0;
}

} // namespace platform
