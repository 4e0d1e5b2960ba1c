// Copies what will not be read soon past the processor's cache: an image's memory need not be fetched to be written.
#pragma once

#include <cstddef>
#include <span>

namespace pt {

// to: memory for as many bytes.
void stream_copy(std::span<const std::byte> from, std::byte *to);

} // namespace pt
