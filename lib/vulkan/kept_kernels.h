// A driver's compiled kernels, as the caller keeps them from process to process. Used by PipelineCache.
#pragma once

#include <pt/pt.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace pt::vulkan {

// The caller's functions; each may be NULL.
struct KernelStore {
    pt_load_kernels_fn load = nullptr;
    pt_store_kernels_fn store = nullptr;
    void *user = nullptr;
};

// A header in front of a driver's bytes identifies them: a driver trusts what it reads, so it must never see other
// bytes.
struct KernelSeal {
    char magic[8];
    char key[32];
    std::uint64_t size_bytes; // of what follows
    std::uint64_t checksum;   // of what follows
};

// The seal for data under a key of 32 characters.
KernelSeal kernel_seal(const std::string &key, std::span<const std::byte> data);

// The bytes after the seal; empty unless they are exactly what was sealed under this key.
std::span<const std::byte> unsealed_kernels(const std::string &key, std::span<const std::byte> bytes);

} // namespace pt::vulkan
