#include "lib/base/stream_copy.h"

#include <algorithm>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace pt {

void stream_copy(std::span<const std::byte> from, std::byte *to) {
    std::size_t done = 0;
#ifdef __SSE2__
    constexpr std::size_t lane = sizeof(__m128i);
    const std::size_t misaligned = reinterpret_cast<std::uintptr_t>(to) % lane;
    done = std::min((lane - misaligned) % lane, from.size());
    std::ranges::copy(from.first(done), to);
    for (; done + lane <= from.size(); done += lane)
        _mm_stream_si128(reinterpret_cast<__m128i *>(to + done),
                         _mm_loadu_si128(reinterpret_cast<const __m128i *>(from.data() + done)));
    _mm_sfence(); // makes the bytes visible to later reads, also by other threads
#endif
    std::ranges::copy(from.subspan(done), to + done);
}

} // namespace pt
