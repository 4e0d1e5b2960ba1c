// A driver's cache of built kernels. The caller may keep it between processes.
#pragma once

#include "lib/base/log.h"
#include "lib/vulkan/api.h"

#include <pt/pt.h>

#include <cstdint>
#include <string>
#include <utility>

namespace pt::vulkan {

struct KernelStore {
    pt_load_kernels_fn load = nullptr;
    pt_store_kernels_fn store = nullptr;
    void *user = nullptr;
};

class PipelineCache {
public:
    PipelineCache() = default;
    explicit PipelineCache(const vk::raii::Device &device);

    const vk::raii::PipelineCache &handle() const { return cache_; }

    // Loads the caller's kernels if they are intact and the driver accepts them. `key` has 32 hexadecimal digits.
    void use(const KernelStore &store, std::string key, const Log &log);

    void set_key(std::string key) noexcept { key_ = std::move(key); }

    void note_kernel() { has_news_ = true; }

    void save(const Log &log) noexcept;

    void abandon() { cache_.release(); }

private:
    void load(const KernelStore &store, const Log &log);

    const vk::raii::Device *device_ = nullptr;
    vk::raii::PipelineCache cache_ = nullptr;
    KernelStore store_;
    std::string key_;
    std::uint64_t kept_checksum_ = 0;
    bool has_news_ = false;
};

} // namespace pt::vulkan
