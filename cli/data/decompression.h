// Unpacks gzip (RFC 1952), zstd (RFC 8878) and the deflated members of zip files (RFC 1951) as they are read.
#pragma once

#include "cli/data/byte_source.h"

#include <memory>
#include <string>
#include <string_view>

namespace cli {

enum class Compression { none, gzip, zstd, deflate };

// By the first four bytes of a file; never deflate, which has no mark of its own.
Compression compression_of(std::string_view head);

// What the bytes of packed unpack to. name: of the file, for messages.
std::unique_ptr<ByteSource> unpacked(std::unique_ptr<ByteSource> packed, Compression compression,
                                     const std::string &name);

} // namespace cli
