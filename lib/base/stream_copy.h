// Copies bytes that are not read soon, without filling the processor's cache.
#pragma once

#include <cstddef>
#include <span>

namespace pt {

void stream_copy(std::span<const std::byte> from, std::byte *to);

} // namespace pt
