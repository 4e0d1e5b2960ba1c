// Copies without filling the processor's cache, for bytes that are not read soon.
#pragma once

#include <cstddef>
#include <span>

namespace pt {

void stream_copy(std::span<const std::byte> from, std::byte *to);

} // namespace pt
