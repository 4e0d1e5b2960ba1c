#include "lib/tree/equal_words.h"

#include "lib/base/mixed.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pt {

namespace {

constexpr std::uint32_t empty = ~std::uint32_t{0};
constexpr unsigned place_bits = 26;
constexpr std::uint32_t tag_count = 63; // a 64th tag could make a used slot look empty

std::uint64_t hash_of(const glm::uvec4 &word) {
    const auto two = [](std::uint32_t low, std::uint32_t high) { return std::uint64_t{high} << 32 | low; };
    return mixed(mixed(two(word.x, word.y)) ^ two(word.z, word.w));
}

// A hash table. A slot has a word's position and six bits of its hash, so different words are rarely compared. At most
// three quarters of the slots are used.
class Slots {
public:
    explicit Slots(std::span<const glm::uvec4> words) :
        words_(words),
        slots_(std::bit_ceil(words.size() * 4 / 3 + 1), empty) {}

    void fetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash & (slots_.size() - 1)]); }

    bool add(std::uint32_t place, std::uint64_t hash) {
        constexpr std::size_t most_looks = 1000;
        const std::uint32_t tag = static_cast<std::uint32_t>(hash >> 32) % tag_count << place_bits;
        for (std::size_t i = 0; i < most_looks; ++i) {
            std::uint32_t &slot = slots_[(hash + i) & (slots_.size() - 1)];
            if (slot == empty) {
                slot = tag | place;
                return true;
            }
            if ((slot ^ tag) >> place_bits == 0 && words_[slot ^ tag] == words_[place])
                return false;
        }
        return false;
    }

private:
    std::span<const glm::uvec4> words_;
    std::vector<std::uint32_t> slots_;
};

} // namespace

bool has_equal_words(std::span<const glm::uvec4> words, WorkProgress &progress) {
    Slots slots(words);
    std::array<std::uint64_t, 32> hashes;
    for (std::size_t first = 0; first < words.size(); first += hashes.size()) {
        const std::size_t count = std::min(hashes.size(), words.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            hashes[i] = hash_of(words[first + i]);
            slots.fetch(hashes[i]);
        }
        for (std::size_t i = 0; i < count; ++i)
            if (!slots.add(static_cast<std::uint32_t>(first + i), hashes[i]))
                return true;
        progress.add(count);
    }
    return false;
}

} // namespace pt
