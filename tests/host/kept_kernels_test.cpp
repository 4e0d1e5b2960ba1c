// Which bytes of kernels that were kept reach a driver.
#include "lib/vulkan/kept_kernels.h"

#include <gtest/gtest.h>

#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace {

using KernelBytes = std::vector<std::byte>;

const std::string kernels_key = "0123456789abcdef0123456789abcdef";

KernelBytes sealed(const std::string &key, const KernelBytes &data) {
    const pt::vulkan::KernelSeal seal = pt::vulkan::kernel_seal(key, data);
    KernelBytes bytes(sizeof seal);
    std::memcpy(bytes.data(), &seal, sizeof seal);
    bytes.insert(bytes.end(), data.begin(), data.end());
    return bytes;
}

const KernelBytes kernels_data = {std::byte{1}, std::byte{2}, std::byte{3}, std::byte{250}};

bool is_taken(const KernelBytes &bytes) {
    return !pt::vulkan::unsealed_kernels(kernels_key, bytes).empty();
}

TEST(KeptKernelsTest, WhatWasSealedComesBack) {
    const KernelBytes bytes = sealed(kernels_key, kernels_data);
    const std::span<const std::byte> data = pt::vulkan::unsealed_kernels(kernels_key, bytes);
    EXPECT_EQ(KernelBytes(data.begin(), data.end()), kernels_data);
}

TEST(KeptKernelsTest, EachBitCounts) {
    const KernelBytes bytes = sealed(kernels_key, kernels_data);
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        KernelBytes damaged = bytes;
        damaged[bit / 8] ^= std::byte{1} << bit % 8;
        EXPECT_FALSE(is_taken(damaged)) << "bit " << bit;
    }
}

TEST(KeptKernelsTest, SoDoesTheLength) {
    KernelBytes bytes = sealed(kernels_key, kernels_data);
    bytes.push_back(std::byte{0});
    EXPECT_FALSE(is_taken(bytes));
    bytes.pop_back();
    EXPECT_TRUE(is_taken(bytes));
    for (; !bytes.empty(); bytes.pop_back())
        EXPECT_EQ(is_taken(bytes), bytes.size() == sizeof(pt::vulkan::KernelSeal) + kernels_data.size());
    EXPECT_FALSE(is_taken(bytes));
}

TEST(KeptKernelsTest, OthersAreForeign) {
    EXPECT_FALSE(is_taken(sealed("1123456789abcdef0123456789abcdef", kernels_data)));
    EXPECT_FALSE(is_taken(sealed("", kernels_data)));
}

} // namespace
