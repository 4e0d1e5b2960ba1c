// A driver's cache of the kernels that it has built on a device, which the caller may keep from process to process.
// Owned by Device. It only saves time: if anything is wrong with what was kept, kernels are built anew.
#pragma once

#include "lib/base/log.h"
#include "lib/vulkan/api.h"

#include <pt/pt.h>

#include <cstdint>
#include <string>
#include <utility>

namespace pt::vulkan {

// The caller's functions; each may be NULL.
struct KernelStore {
    pt_load_kernels_fn load = nullptr;
    pt_store_kernels_fn store = nullptr;
    void *user = nullptr;
};

class PipelineCache {
public:
    PipelineCache() = default; // none
    // An empty one. The device must outlive it.
    explicit PipelineCache(const vk::raii::Device &device);

    const vk::raii::PipelineCache &handle() const { return cache_; }

    // Loads what the caller has kept under a key, if it is intact and the driver accepts it; from now on save() hands
    // over what is new. key: 32 hexadecimal digits.
    void use(const KernelStore &store, std::string key, const Log &log);

    // From now on save() hands over under another key.
    void set_key(std::string key) noexcept { key_ = std::move(key); }

    // Notes that a kernel was built.
    void note_kernel() { has_news_ = true; }

    // Hands the kernels to the caller, if some were built since the last time and the driver's bytes have changed.
    void save(const Log &log) noexcept;

    void abandon() { cache_.release(); }

private:
    void load(const KernelStore &store, const Log &log);

    const vk::raii::Device *device_ = nullptr;
    vk::raii::PipelineCache cache_ = nullptr;
    KernelStore store_;
    std::string key_;
    std::uint64_t kept_checksum_ = 0; // of what the caller has kept
    bool has_news_ = false;
};

} // namespace pt::vulkan
