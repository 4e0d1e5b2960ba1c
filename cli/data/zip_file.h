// Zip files (PKWARE's APPNOTE 6.3.10), also larger than 4 GiB, with members that are stored or deflated.
#pragma once

#include "cli/data/byte_source.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cli {

struct ZipMember {
    std::string name;
    std::uint16_t method; // 0: stored, 8: deflated
    std::uint32_t checksum;
    std::uint64_t packed_size;
    std::uint64_t size;
    std::uint64_t offset; // of its local head in the file
};

// Both throw Failure.
std::vector<ZipMember> read_zip_directory(const std::string &path);

// What the member holds. Its checksum is compared when all of it has been read.
std::unique_ptr<ByteSource> open_member(const std::string &path, const ZipMember &member);

} // namespace cli
