#include "cli/base/vector_width.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace cli {
namespace {

constexpr const char *width_name = "LP_NATIVE_VECTOR_WIDTH"; // in bits
constexpr const char *cache_name = "MESA_SHADER_CACHE_DIR";

// If the user has set one of these, neither the width nor the folder of compiled shaders is changed, because one is not
// safe without the other (see wide_vectors). The last two are older names of Mesa's.
constexpr std::array choices{width_name, cache_name, "MESA_SHADER_CACHE_DISABLE", "MESA_GLSL_CACHE_DIR",
                             "MESA_GLSL_CACHE_DISABLE"};

bool has_avx512() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#else
    return false;
#endif
}

} // namespace

// A folder of compiled shaders for this width alone: Mesa's key of a shader does not tell its width (seen with 22.3.6
// and 25.0.7), so that machine code for 256 bits, left by any program, would be taken for that of 512.
Environment wide_vectors(const Environment &environment) {
    const bool chosen =
        std::any_of(choices.begin(), choices.end(), [&](const char *name) { return environment.contains(name); });
    const std::filesystem::path cache = user_cache(environment);
    if (chosen || cache.empty()) {
        return {};
    }
    return {{width_name, "512"}, {cache_name, (cache / "shaders-512").string()}};
}

void choose_vector_width() {
    if (!has_avx512()) {
        return;
    }
    const Environment wide = wide_vectors(own_environment());
    if (wide.empty()) {
        return;
    }
    // Mesa makes the last folder of the path only, and goes without a cache if it cannot: every start would compile
    // anew.
    std::error_code error;
    std::filesystem::create_directories(wide.at(cache_name), error);
    if (error) {
        return;
    }
    for (const auto &[name, value] : wide) {
        setenv(name.c_str(), value.c_str(), 1);
    }
}

} // namespace cli
