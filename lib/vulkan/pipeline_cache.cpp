#include "lib/vulkan/pipeline_cache.h"

#include "lib/base/digest.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <memory>
#include <new>
#include <span>
#include <string_view>
#include <vector>

namespace pt::vulkan {

namespace {

// Far more than the kernels of a context take.
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 28;

constexpr std::string_view magic = "ptkernel";

// A header that protects drivers from damaged or foreign bytes.
struct KernelSeal {
    char magic[8];
    char key[32];
    std::uint64_t size_bytes;
    std::uint64_t checksum;
};

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

} // namespace

PipelineCache::PipelineCache(const vk::raii::Device &device) :
    device_(&device),
    cache_(device.createPipelineCache({})) {}

void PipelineCache::use(const KernelStore &store, std::string key, const Log &log) {
    key_ = std::move(key);
    store_ = store;
    if (store.load)
        load(store, log);
}

void PipelineCache::load(const KernelStore &store, const Log &log) {
    const std::uint64_t size = store.load(store.user, key_.c_str(), nullptr, 0);
    if (size == 0)
        return;
    std::vector<std::byte> bytes(size <= most_bytes ? size : 0);
    const bool unchanged = store.load(store.user, key_.c_str(), bytes.data(), bytes.size()) == size;
    const std::span<const std::byte> data = unchanged ? unsealed_kernels(key_, bytes) : std::span<const std::byte>{};
    if (data.empty()) {
        log.info([] { return std::string("the kept kernels are damaged or foreign, and are built again"); });
        return;
    }
    try {
        cache_ = device_->createPipelineCache({.initialDataSize = data.size(), .pInitialData = data.data()});
        kept_checksum_ = kernel_seal(key_, data).checksum;
    } catch (const vk::SystemError &error) {
        log.info([&] { return std::string("the driver refuses the kept kernels: ") + error.what(); });
    }
}

// Must not throw, because it runs at the end of successful calls.
void PipelineCache::save(const Log &log) noexcept {
    if (!store_.store || !std::exchange(has_news_, false))
        return;
    const auto get_data = device_->getDispatcher()->vkGetPipelineCacheData;
    const VkDevice device = **device_;
    const VkPipelineCache cache = *cache_;
    std::size_t size = 0;
    if (get_data(device, cache, &size, nullptr) != VK_SUCCESS)
        return;
    const std::unique_ptr<std::byte[]> bytes(new (std::nothrow) std::byte[sizeof(KernelSeal) + size]);
    if (!bytes || get_data(device, cache, &size, bytes.get() + sizeof(KernelSeal)) != VK_SUCCESS)
        return;
    const KernelSeal seal = kernel_seal(key_, {bytes.get() + sizeof(KernelSeal), size});
    if (seal.checksum == kept_checksum_)
        return;
    std::memcpy(bytes.get(), &seal, sizeof seal);
    log.info([&] { return "hands over " + std::to_string(size) + " bytes of kernels to be kept"; });
    store_.store(store_.user, key_.c_str(), bytes.get(), sizeof seal + size);
    kept_checksum_ = seal.checksum;
}

} // namespace pt::vulkan
