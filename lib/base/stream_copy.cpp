#include "lib/base/stream_copy.h"

#include <algorithm>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace pt {

#ifdef __SSE2__

void stream_copy(std::span<const float> from, float *to) {
    constexpr std::size_t lanes = 4;
    const std::size_t misaligned = reinterpret_cast<std::uintptr_t>(to) / sizeof(float) % lanes;
    const std::size_t head = std::min((lanes - misaligned) % lanes, from.size());
    std::ranges::copy(from.first(head), to);
    std::size_t i = head;
    for (; i + lanes <= from.size(); i += lanes)
        _mm_stream_ps(to + i, _mm_loadu_ps(from.data() + i));
    std::ranges::copy(from.subspan(i), to + i);
    _mm_sfence(); // what follows, on other threads too, sees the values
}

#else

void stream_copy(std::span<const float> from, float *to) {
    std::ranges::copy(from, to);
}

#endif

} // namespace pt
