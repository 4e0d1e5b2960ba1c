// llvmpipe's vector width. Whether wide vectors pay depends on processor, driver and kind of kernel, so it is measured
// once, and the result is kept in the user's cache. Images have the same bits at each width.
#pragma once

#include <pt/devices.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace cli {

struct KernelUse {
    bool has_tree = false;
    std::uint64_t sample_count = 0;
};

bool has_avx512();

inline constexpr const char *vector_width_variables[] = {"LP_NATIVE_VECTOR_WIDTH", "MESA_SHADER_CACHE_DIR",
                                                         "MESA_SHADER_CACHE_DISABLE"};

class VectorWidth {
public:
    // Sets environment variables, unless the user chose a width or `is_free` is false. Must precede the first Vulkan
    // instance and other threads.
    explicit VectorWidth(const KernelUse &use, bool is_free = has_avx512());

    // Whether llvmpipe has no result, and the samples take longer than a trial.
    bool should_measure(const pt_device_info &device) const;

    // There must be no Vulkan instance, because llvmpipe reads the width when it is loaded.
    void measure(const pt_device_info &device);

private:
    void set(unsigned int bits) const;

    KernelUse use_;
    bool is_free_;
    std::filesystem::path cache_;
    std::filesystem::path file_;
    std::string driver_; // driver of the result in use
};

} // namespace cli
