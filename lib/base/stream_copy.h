// Copies what will not be read soon past the processor's cache: an image's memory need not be fetched to be written.
#pragma once

#include <span>

namespace pt {

// to: memory for as many values.
void stream_copy(std::span<const float> from, float *to);

} // namespace pt
