// Numbers for some spheres of a scene, by their order in it, whatever the order in which they are added.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pt {

// First all are added, then their numbers are asked for. Takes 12 bytes for 64 spheres of the scene.
class SceneNumbers {
public:
    explicit SceneNumbers(std::size_t sphere_count) : blocks_(sphere_count / block_size + 1) {}

    void add(std::uint32_t sphere) { blocks_[sphere / block_size].added |= bit_of(sphere); }

    void count() {
        std::uint32_t before = 0;
        for (Block &block : blocks_) {
            block.before = before;
            before += static_cast<std::uint32_t>(std::popcount(block.added));
        }
    }

    // How many of the added spheres come before this one.
    std::uint32_t number_of(std::uint32_t sphere) const {
        const Block &block = blocks_[sphere / block_size];
        return block.before + static_cast<std::uint32_t>(std::popcount(block.added & (bit_of(sphere) - 1)));
    }

private:
    static constexpr std::uint32_t block_size = 64;

    struct Block {
        std::uint64_t added = 0;
        std::uint32_t before = 0;
    };

    static std::uint64_t bit_of(std::uint32_t sphere) { return std::uint64_t{1} << sphere % block_size; }

    std::vector<Block> blocks_;
};

} // namespace pt
