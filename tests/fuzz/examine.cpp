#include "tests/fuzz/examine.h"

#include <algorithm>
#include <random>
#include <utility>

namespace fuzz {

namespace {

// FNV-1a (Fowler, Noll and Vo, 1991).
std::uint64_t hash_of(std::span<const std::uint8_t> bytes) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const std::uint8_t byte : bytes)
        hash = (hash ^ byte) * 0x100000001b3U;
    return hash;
}

} // namespace

void examine_neighbourhood(const Input &input, std::span<const std::uint8_t> bytes) {
    constexpr std::uint32_t most_changes = 4;
    std::vector<Input> family{input};
    std::mt19937_64 random(hash_of(bytes));
    for (std::uint32_t i = 0; i < neighbour_count; ++i) {
        Input neighbour = input;
        for (std::uint64_t change = random() % most_changes; change < most_changes; ++change) {
            std::array<std::uint8_t, 24> numbers;
            std::ranges::generate(numbers, [&] { return static_cast<std::uint8_t>(random()); });
            ByteReader reader(numbers);
            change_one_number(neighbour, reader);
        }
        family.push_back(std::move(neighbour));
    }
    examine(family);
}

} // namespace fuzz
