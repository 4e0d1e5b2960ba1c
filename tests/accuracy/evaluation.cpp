#include "tests/accuracy/evaluation.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace accuracy {

namespace {

// a NaN that no function returns
constexpr std::uint32_t sentinel = 0xffa5c35aU;

std::vector<std::uint32_t> unwritten_items(Probe &probe, std::span<const std::byte> inputs,
                                           std::span<std::byte> outputs, const ItemRange &range) {
    const std::size_t item_bytes = outputs.size() / range.count;
    for (std::size_t offset = 0; offset < outputs.size(); offset += sizeof sentinel)
        std::memcpy(outputs.data() + offset, &sentinel, sizeof sentinel);
    probe.run_over(inputs, outputs, std::as_bytes(std::span(&range, 1)), range.count);
    std::vector<std::uint32_t> unwritten;
    for (std::size_t offset = 0; offset < outputs.size(); offset += sizeof sentinel) {
        const auto item = static_cast<std::uint32_t>(offset / item_bytes);
        const bool is_sentinel = std::memcmp(outputs.data() + offset, &sentinel, sizeof sentinel) == 0;
        if (is_sentinel && (unwritten.empty() || unwritten.back() != item))
            unwritten.push_back(item);
    }
    return unwritten;
}

} // namespace

void evaluate_bytes(Probe &probe, std::span<const std::byte> inputs, std::span<std::byte> outputs,
                    std::uint32_t item_count) {
    const std::uint32_t skipped = item_count / 3;
    EXPECT_EQ(unwritten_items(probe, inputs, outputs, {item_count, skipped}), std::vector<std::uint32_t>{skipped})
        << "an item that the kernel skips must be seen";
    EXPECT_EQ(unwritten_items(probe, inputs, outputs, {item_count, item_count}), std::vector<std::uint32_t>{});
}

} // namespace accuracy
