// Copies bytes that will not be read soon around the processor's cache, so that the memory of an image is not fetched
// only to be overwritten.
#pragma once

#include <cstddef>
#include <span>

namespace pt {

// to: memory for at least as many bytes.
void stream_copy(std::span<const std::byte> from, std::byte *to);

} // namespace pt
