#include "cli/base/environment.h"

#include "lib/platform/process.h"

#include <cstdlib>
#include <system_error>
#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace cli {
namespace {

// Asks the processor, because Zig has no runtime for the compiler's __builtin_cpu_supports().
bool has_avx512() {
#if defined(__x86_64__)
    constexpr unsigned int needed = bit_AVX512F | bit_AVX512BW | bit_AVX512DQ | bit_AVX512VL;
    unsigned int a = 0;
    unsigned int b = 0;
    unsigned int c = 0;
    unsigned int d = 0;
    return __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b & needed) == needed;
#else
    return false;
#endif
}

} // namespace

std::filesystem::path user_cache() {
    const std::filesystem::path folder = platform::cache_folder();
    return folder.empty() ? folder : folder / "pt";
}

// Mesa's cache keys ignore the vector width (22.3.6, 25.0.7), so each width needs a cache of its own.
void widen_vectors() {
    constexpr const char *width_name = "LP_NATIVE_VECTOR_WIDTH";
    constexpr const char *cache_name = "MESA_SHADER_CACHE_DIR";
    if (std::getenv(width_name) != nullptr)
        return;
    platform::set_environment(width_name, "512");
    const char *chosen = std::getenv(cache_name);
    const std::filesystem::path cache = chosen == nullptr || *chosen == '\0' ? user_cache() : chosen;
    std::error_code error;
    if (!cache.empty())
        std::filesystem::create_directories(cache / "shaders-512",
                                            error); // Mesa creates only the last folder
    if (cache.empty() || error)
        platform::set_environment("MESA_SHADER_CACHE_DISABLE", "true");
    else
        platform::set_environment(cache_name, (cache / "shaders-512").string().c_str());
}

void choose_vector_width() {
    if (has_avx512())
        widen_vectors();
}

} // namespace cli
