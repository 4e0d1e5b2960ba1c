#include "cli/data/zip_file.h"

#include "cli/base/exit_code.h"
#include "cli/data/decompression.h"

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

namespace cli {
namespace {

[[noreturn]] void refuse_zip(const std::string &path, const std::string &reason) {
    throw Failure(ExitCode::scene, path + ": " + reason);
}

// Numbers at places of a record, the lowest byte first.
std::uint64_t number_at(std::string_view record, std::size_t place, std::size_t size) {
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < size; ++i) {
        number |= std::uint64_t{static_cast<unsigned char>(record[place + i])} << (8 * i);
    }
    return number;
}

std::string read_part(const std::string &path, std::uint64_t offset, std::uint64_t size) {
    const auto file = open_part(path, offset, size);
    std::string bytes(size, '\0');
    for (std::size_t used = 0; used < bytes.size();) {
        const std::size_t count = file->read(bytes.data() + used, bytes.size() - used);
        if (count == 0) {
            refuse_zip(path, "cut short: byte " + std::to_string(offset + used) + " is not there");
        }
        used += count;
    }
    return bytes;
}

struct Directory {
    std::uint64_t offset;
    std::uint64_t size;
    std::uint64_t count;
};

// Of the record at the end of the file (section 4.3.16), or of that for large files (4.3.14), whose place stands before
// it (4.3.15).
Directory find_directory(const std::string &path, std::uint64_t file_size) {
    using namespace std::string_view_literals;
    constexpr std::uint64_t end_size = 22;
    constexpr std::uint64_t longest_comment = 65535;
    const std::uint64_t tail_size = std::min(file_size, end_size + longest_comment);
    const std::string tail = read_part(path, file_size - tail_size, tail_size);
    const std::size_t place = tail.rfind("PK\5\6"sv);
    if (place == std::string::npos || tail.size() - place < end_size) {
        refuse_zip(path, "has no directory at its end: it is no zip file, or was cut short");
    }
    const std::string_view end = std::string_view(tail).substr(place);
    const Directory directory{number_at(end, 16, 4), number_at(end, 12, 4), number_at(end, 10, 2)};
    constexpr std::size_t locator_size = 20;
    constexpr std::size_t large_end_size = 56;
    if (place < locator_size || !std::string_view(tail).substr(place - locator_size).starts_with("PK\6\7"sv)) {
        return directory;
    }
    const std::uint64_t offset = number_at(std::string_view(tail).substr(place - locator_size), 8, 8);
    if (offset > file_size - std::min<std::uint64_t>(file_size, large_end_size)) {
        refuse_zip(path, "damaged: its directory is not within the file");
    }
    const std::string large = read_part(path, offset, large_end_size);
    if (!large.starts_with("PK\6\6"sv)) {
        refuse_zip(path, "damaged: byte " + std::to_string(offset) + " begins no directory");
    }
    return {number_at(large, 48, 8), number_at(large, 40, 8), number_at(large, 32, 8)};
}

// What does not fit 32 bits stands in an extra field instead, in this order (section 4.5.3).
void read_large_sizes(std::string_view extra, ZipMember &member) {
    constexpr std::uint64_t elsewhere = std::numeric_limits<std::uint32_t>::max();
    constexpr std::uint64_t large_sizes = 1;
    while (extra.size() >= 4) {
        const std::uint64_t kind = number_at(extra, 0, 2);
        const std::size_t size = std::min<std::size_t>(number_at(extra, 2, 2), extra.size() - 4);
        std::string_view field = extra.substr(4, size);
        extra.remove_prefix(4 + size);
        for (std::uint64_t *value : {&member.size, &member.packed_size, &member.offset}) {
            if (kind == large_sizes && *value == elsewhere && field.size() >= 8) {
                *value = number_at(field, 0, 8);
                field.remove_prefix(8);
            }
        }
    }
}

// The members of a directory (section 4.3.12).
class ZipDirectoryReader {
public:
    ZipDirectoryReader(const std::string &path, std::string_view directory) : path_(path), rest_(directory) {}

    bool at_end() const { return rest_.empty(); }

    ZipMember next() {
        constexpr std::size_t head_size = 46;
        if (rest_.size() < head_size || !rest_.starts_with("PK\1\2")) {
            refuse_zip(path_, "damaged: its directory has no member where one must be");
        }
        ZipMember member{{},
                         static_cast<std::uint16_t>(number_at(rest_, 10, 2)),
                         static_cast<std::uint32_t>(number_at(rest_, 16, 4)),
                         number_at(rest_, 20, 4),
                         number_at(rest_, 24, 4),
                         number_at(rest_, 42, 4)};
        const bool is_encrypted = (number_at(rest_, 8, 2) & 1U) != 0;
        const std::size_t name_size = number_at(rest_, 28, 2);
        const std::size_t extra_size = number_at(rest_, 30, 2);
        const std::size_t size = head_size + name_size + extra_size + number_at(rest_, 32, 2);
        if (size > rest_.size()) {
            refuse_zip(path_, "damaged: a member of its directory is cut short");
        }
        member.name = rest_.substr(head_size, name_size);
        read_large_sizes(rest_.substr(head_size + name_size, extra_size), member);
        rest_.remove_prefix(size);
        if (is_encrypted || (member.method != 0 && member.method != 8)) {
            refuse_zip(path_, member.name + ": must be stored or deflated, and not encrypted");
        }
        return member;
    }

private:
    const std::string &path_;
    std::string_view rest_;
};

class CheckedMember : public ByteSource {
public:
    CheckedMember(const std::string &path, const ZipMember &member, std::unique_ptr<ByteSource> bytes) :
        name_(path + ": " + member.name),
        size_(member.size),
        expected_(member.checksum),
        bytes_(std::move(bytes)) {}

    std::size_t read(char *bytes, std::size_t size) override {
        const std::size_t count = bytes_->read(bytes, size);
        if (count == 0 && done_ < size_) {
            refuse_zip(name_, "cut short: has " + std::to_string(done_) + " of " + std::to_string(size_) + " bytes");
        }
        done_ += count;
        checksum_ = static_cast<std::uint32_t>(crc32_z(checksum_, reinterpret_cast<const Bytef *>(bytes), count));
        if (done_ > size_ || (done_ == size_ && checksum_ != expected_)) {
            refuse_zip(name_, "damaged: its size or its checksum is not that of the directory");
        }
        return count;
    }

private:
    std::string name_;
    std::uint64_t size_;
    std::uint32_t expected_;
    std::unique_ptr<ByteSource> bytes_;
    std::uint64_t done_ = 0;
    std::uint32_t checksum_ = 0;
};

} // namespace

std::vector<ZipMember> read_zip_directory(const std::string &path) {
    std::error_code error;
    const std::uint64_t file_size = std::filesystem::file_size(path, error);
    if (error) {
        throw Failure(ExitCode::file, "cannot read " + path + ": a zip file has to be a file: " + error.message());
    }
    const Directory directory = find_directory(path, file_size);
    if (directory.size > file_size || directory.offset > file_size - directory.size) {
        refuse_zip(path, "damaged: its directory is not within the file");
    }
    const std::string bytes = read_part(path, directory.offset, directory.size);
    ZipDirectoryReader reader(path, bytes);
    std::vector<ZipMember> members;
    while (members.size() < directory.count) {
        members.push_back(reader.next());
    }
    if (!reader.at_end()) {
        refuse_zip(path, "damaged: its directory has more members than it says");
    }
    return members;
}

std::unique_ptr<ByteSource> open_member(const std::string &path, const ZipMember &member) {
    constexpr std::uint64_t head_size = 30;
    const std::string head = read_part(path, member.offset, head_size);
    if (!head.starts_with("PK\3\4")) {
        refuse_zip(path, "damaged: byte " + std::to_string(member.offset) + " begins no member");
    }
    const std::uint64_t first = member.offset + head_size + number_at(head, 26, 2) + number_at(head, 28, 2);
    auto packed = open_part(path, first, member.packed_size);
    auto bytes = member.method == 0 ? std::move(packed)
                                    : unpacked(std::move(packed), Compression::deflate, path + ": " + member.name);
    return std::make_unique<CheckedMember>(path, member, std::move(bytes));
}

} // namespace cli
