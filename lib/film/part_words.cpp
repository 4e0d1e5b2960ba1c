#include "lib/film/part_words.h"

#include "shaders/gpu_layout.h"

#include <algorithm>
#include <array>

namespace pt {

namespace {

// What a word becomes, and the carry into the next more significant one: 0 or 1.
struct WordAndCarry {
    std::uint32_t word;
    std::uint32_t carry;
};

// In 32 bits, so that compilers do several pixels at once.
WordAndCarry sum_of(std::uint32_t a, std::uint32_t b, std::uint32_t carry) {
    const std::uint32_t sum = a + b;
    const std::uint32_t with_carry = sum + carry;
    return {with_carry, static_cast<std::uint32_t>(sum < a) | static_cast<std::uint32_t>(with_carry < sum)};
}

WordAndCarry difference_of(std::uint32_t a, std::uint32_t b, std::uint32_t borrow) {
    const std::uint32_t difference = a - b;
    return {difference - borrow, static_cast<std::uint32_t>(a < b) | static_cast<std::uint32_t>(difference < borrow)};
}

// Plane by plane: a sum's carries go from each word to the next.
template <typename Operation>
void combine(const PartWords<std::uint32_t> &to, const PartWords<const std::uint32_t> &from, std::size_t pixel_count,
             const Operation &operation) noexcept {
    constexpr std::size_t block_pixels = 256; // whose carries and planes stay in the fastest cache
    std::array<std::uint32_t, block_pixels> carries;
    for (std::size_t done = 0; done < pixel_count; done += block_pixels) {
        const std::size_t block = std::min(block_pixels, pixel_count - done);
        for (std::size_t plane = 0; plane < gpu::FILM_WORDS; ++plane) {
            if (plane >= gpu::FILM_ACCEPTED || plane % gpu::FILM_SUM_WORDS == 0)
                std::fill_n(carries.begin(), block, 0U);
            std::uint32_t *const words = to.first + plane * to.stride + done;
            const std::uint32_t *const others = from.first + plane * from.stride + done;
            for (std::size_t pixel = 0; pixel < block; ++pixel) {
                const WordAndCarry result = operation(words[pixel], others[pixel], carries[pixel]);
                words[pixel] = result.word;
                carries[pixel] = result.carry;
            }
        }
    }
}

} // namespace

void add_words(const PartWords<std::uint32_t> &to, const PartWords<const std::uint32_t> &from,
               std::size_t pixel_count) noexcept {
    combine(to, from, pixel_count, sum_of);
}

void subtract_words(const PartWords<std::uint32_t> &to, const PartWords<const std::uint32_t> &from,
                    std::size_t pixel_count) noexcept {
    combine(to, from, pixel_count, difference_of);
}

} // namespace pt
