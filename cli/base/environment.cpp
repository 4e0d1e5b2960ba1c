#include "cli/base/environment.h"

#include <cstdlib>
#include <system_error>

namespace cli {
namespace {

bool has_avx512() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#else
    return false;
#endif
}

} // namespace

// As the XDG Base Directory Specification says, which ignores relative paths.
std::filesystem::path user_cache() {
    const auto folder = [](const char *name) {
        const char *variable = std::getenv(name);
        const std::filesystem::path path = variable == nullptr ? "" : variable;
        return path.is_absolute() ? path : std::filesystem::path();
    };
    if (const std::filesystem::path path = folder("XDG_CACHE_HOME"); !path.empty())
        return path / "pt";
    const std::filesystem::path home = folder("HOME");
    return home.empty() ? home : home / ".cache" / "pt";
}

// Gives vectors of 512 bits a folder of compiled shaders of their own. Mesa's key of a shader does not tell the width
// (seen with 22.3.6 and 25.0.7), so code for 256 bits that some program has left would be used for 512. Films tell the
// widths apart, because the device's name has it.
void widen_vectors() {
    constexpr const char *width_name = "LP_NATIVE_VECTOR_WIDTH"; // in bits
    constexpr const char *cache_name = "MESA_SHADER_CACHE_DIR";
    if (std::getenv(width_name) != nullptr)
        return;
    setenv(width_name, "512", 1);
    const char *chosen = std::getenv(cache_name);
    const std::filesystem::path cache = chosen == nullptr || *chosen == '\0' ? user_cache() : chosen;
    std::error_code error;
    if (!cache.empty())
        std::filesystem::create_directories(cache / "shaders-512", error); // Mesa makes the last folder of a path only
    if (cache.empty() || error)
        setenv("MESA_SHADER_CACHE_DISABLE", "true", 1); // every start compiles anew
    else
        setenv(cache_name, (cache / "shaders-512").c_str(), 1);
}

void choose_vector_width() {
    if (has_avx512())
        widen_vectors();
}

} // namespace cli
