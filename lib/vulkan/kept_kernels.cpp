// Seals of kernels; see kept_kernels.h.
#include "lib/vulkan/kept_kernels.h"

#include "lib/base/digest.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <string_view>

namespace pt::vulkan {

namespace {

constexpr std::string_view magic = "ptkernel";

} // namespace

KernelSeal kernel_seal(const std::string &key, std::span<const std::byte> data) {
    KernelSeal seal{};
    std::ranges::copy(magic, seal.magic);
    std::copy_n(key.begin(), std::min(key.size(), std::size(seal.key)), seal.key);
    seal.size_bytes = data.size();
    seal.checksum = checksum(data);
    return seal;
}

std::span<const std::byte> unsealed_kernels(const std::string &key, std::span<const std::byte> bytes) {
    if (bytes.size() < sizeof(KernelSeal))
        return {};
    const std::span<const std::byte> data = bytes.subspan(sizeof(KernelSeal));
    const KernelSeal expected = kernel_seal(key, data);
    return std::memcmp(bytes.data(), &expected, sizeof expected) == 0 ? data : std::span<const std::byte>{};
}

} // namespace pt::vulkan
