#include "cli/base/vector_width.h"

#include <cstdlib>
#include <system_error>
#include <unistd.h>

namespace cli {
namespace {

constexpr const char *width_name = "LP_NATIVE_VECTOR_WIDTH"; // in bits
constexpr const char *cache_name = "MESA_SHADER_CACHE_DIR";
constexpr const char *no_cache_name = "MESA_SHADER_CACHE_DISABLE";

// The user's own for Mesa, else this program's; empty if there is neither.
std::filesystem::path cache_folder(const Environment &environment) {
    const auto chosen = environment.find(cache_name);
    return chosen == environment.end() || chosen->second.empty() ? user_cache(environment)
                                                                 : std::filesystem::path(chosen->second);
}

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
// and 25.0.7), so that machine code for 256 bits, left by any program, would be taken for that of 512. The width itself
// does not depend on that folder: it is part of the device's name, by which films know each other.
Environment wide_vectors(const Environment &environment) {
    if (environment.contains(width_name))
        return {};
    const std::filesystem::path folder = cache_folder(environment);
    return folder.empty() ? Environment{{width_name, "512"}, {no_cache_name, "true"}}
                          : Environment{{width_name, "512"}, {cache_name, (folder / "shaders-512").string()}};
}

void choose_vector_width() {
    if (!has_avx512())
        return;
    Environment wide = wide_vectors(own_environment());
    // Mesa makes the last folder of the path only.
    if (const auto folder = wide.find(cache_name); folder != wide.end()) {
        std::error_code error;
        std::filesystem::create_directories(folder->second, error);
        if (error) {
            wide.erase(folder);
            wide.emplace(no_cache_name, "true"); // every start compiles anew
        }
    }
    for (const auto &[name, value] : wide)
        setenv(name.c_str(), value.c_str(), 1);
}

Environment own_environment() {
    Environment environment;
    for (char **entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
        const std::string text = *entry;
        const std::size_t end = text.find('=');
        environment.emplace(text.substr(0, end), end == std::string::npos ? "" : text.substr(end + 1));
    }
    return environment;
}

// By the XDG Base Directory Specification, which ignores relative paths.
std::filesystem::path user_cache(const Environment &environment) {
    const auto folder = [&](const char *name) {
        const auto found = environment.find(name);
        const std::filesystem::path path = found == environment.end() ? "" : found->second;
        return path.is_absolute() ? path : std::filesystem::path();
    };
    if (const std::filesystem::path path = folder("XDG_CACHE_HOME"); !path.empty())
        return path / "pt";
    const std::filesystem::path home = folder("HOME");
    return home.empty() ? home : home / ".cache" / "pt";
}

} // namespace cli
