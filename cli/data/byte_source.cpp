#include "cli/data/byte_source.h"

#include "cli/base/exit_code.h"
#include "cli/base/file_descriptor.h"
#include "cli/base/report_file.h"
#include "cli/data/decompression.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <limits>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace cli {
namespace {

class FileBytes : public ByteSource {
public:
    FileBytes(const std::string &path, std::uint64_t offset, std::uint64_t size) :
        name_(path == standard_stream ? "standard input" : path),
        file_(path == standard_stream ? dup(STDIN_FILENO) : open(path.c_str(), O_RDONLY | O_CLOEXEC)),
        first_(offset),
        size_(size),
        left_(size) {
        if (!file_.is_open() || (offset > 0 && lseek(file_.get(), static_cast<off_t>(offset), SEEK_SET) < 0)) {
            fail();
        }
    }

    // The first bytes, which stay to be read.
    std::string_view head() {
        while (head_size_ < head_.size()) {
            const std::size_t count = read_file_bytes(head_.data() + head_size_, head_.size() - head_size_);
            if (count == 0) {
                break;
            }
            head_size_ += count;
        }
        return {head_.data(), head_size_};
    }

    std::size_t read(char *bytes, std::size_t size) override {
        if (head_taken_ == head_size_) {
            return read_file_bytes(bytes, size);
        }
        const std::size_t count = std::min(size, head_size_ - head_taken_);
        std::memcpy(bytes, head_.data() + head_taken_, count);
        head_taken_ += count;
        return count;
    }

    std::optional<std::uint64_t> size_left() const override {
        struct stat status {};
        const off_t place = lseek(file_.get(), 0, SEEK_CUR);
        if (place < 0 || fstat(file_.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
            return std::nullopt;
        }
        const auto unread = static_cast<std::uint64_t>(std::max<off_t>(status.st_size - place, 0));
        return std::min(unread, left_) + (head_size_ - head_taken_);
    }

    bool seek(std::uint64_t offset) override {
        if (offset > size_ || lseek(file_.get(), static_cast<off_t>(first_ + offset), SEEK_SET) < 0) {
            return false;
        }
        head_taken_ = head_size_;
        left_ = size_ - offset;
        return true;
    }

private:
    [[noreturn]] void fail() const {
        throw Failure(ExitCode::file, "cannot read " + name_ + ": " + std::generic_category().message(errno));
    }

    std::size_t read_file_bytes(char *bytes, std::size_t size) {
        for (;;) {
            const ssize_t count =
                ::read(file_.get(), bytes, static_cast<std::size_t>(std::min<std::uint64_t>(size, left_)));
            if (count >= 0) {
                left_ -= static_cast<std::uint64_t>(count);
                return static_cast<std::size_t>(count);
            }
            if (errno != EINTR) {
                fail();
            }
        }
    }

    std::string name_;
    FileDescriptor file_;
    std::uint64_t first_; // byte of the file, and how many from there on belong to this
    std::uint64_t size_;
    std::uint64_t left_;
    std::array<char, 4> head_{};
    std::size_t head_size_ = 0;
    std::size_t head_taken_ = 0;
};

} // namespace

std::unique_ptr<ByteSource> open_bytes(const std::string &path) {
    auto file = std::make_unique<FileBytes>(path, 0, std::numeric_limits<std::uint64_t>::max());
    const Compression compression = compression_of(file->head());
    return compression == Compression::none ? std::move(file) : unpacked(std::move(file), compression, path);
}

std::unique_ptr<ByteSource> open_part(const std::string &path, std::uint64_t offset, std::uint64_t size) {
    return std::make_unique<FileBytes>(path, offset, size);
}

bool is_regular_file(const std::string &path) {
    std::error_code ignored;
    return path != standard_stream && std::filesystem::is_regular_file(path, ignored);
}

} // namespace cli
