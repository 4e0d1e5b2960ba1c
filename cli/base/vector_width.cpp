#include "cli/base/vector_width.h"

#include "cli/base/devices.h"
#include "cli/base/environment.h"
#include "cli/base/kept_width.h"
#include "cli/base/width_trial.h"
#include "lib/platform/process.h"

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <system_error>
#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr const char *width_name = vector_width_variables[0];
constexpr const char *cache_name = vector_width_variables[1];
constexpr const char *no_cache_name = vector_width_variables[2];
constexpr unsigned int narrow = 256;
constexpr unsigned int wide = 512;

} // namespace

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

VectorWidth::VectorWidth(const KernelUse &use, bool is_free) :
    use_(use),
    is_free_(is_free && std::getenv(width_name) == nullptr) {
    if (!is_free_)
        return;
    const char *chosen = std::getenv(cache_name);
    cache_ = chosen == nullptr || *chosen == '\0' ? user_cache() : chosen;
    if (const fs::path folder = user_cache(); !folder.empty())
        file_ = folder / (use.has_tree ? "vector-width-tree" : "vector-width-list");
    const std::optional<KeptWidth> kept = read_width(file_);
    driver_ = kept ? kept->driver : "";
    set(kept ? kept->bits : use.has_tree ? narrow : wide);
}

bool VectorWidth::should_measure(const pt_device_info &device) const {
    return is_free_ && use_.sample_count >= trial_pays_from && !file_.empty() && driver_ != device.driver &&
           std::string_view(device.name).starts_with("llvmpipe");
}

void VectorWidth::measure(const pt_device_info &device) {
    const std::string uuid = uuid_text(device.uuid);
    set(narrow);
    const double of_narrow = trial_seconds(narrow, uuid, use_.has_tree);
    set(wide);
    const double of_wide = trial_seconds(wide, uuid, use_.has_tree);
    const bool is_measured = std::isfinite(of_narrow) && std::isfinite(of_wide);
    const bool is_wide = is_measured ? of_wide < of_narrow : !use_.has_tree;
    set(is_wide ? wide : narrow);
    if (is_measured)
        write_width(file_, {is_wide ? wide : narrow, device.driver});
}

// Mesa's cache keys ignore the vector width (22.3.6, 25.0.7), so each width needs a cache of its own.
void VectorWidth::set(unsigned int bits) const {
    platform::set_environment(width_name, std::to_string(bits).c_str());
    const fs::path folder = cache_ / ("shaders-" + std::to_string(bits));
    std::error_code error;
    if (!cache_.empty())
        fs::create_directories(folder, error); // Mesa creates only the last folder
    if (cache_.empty() || error)
        platform::set_environment(no_cache_name, "true");
    else
        platform::set_environment(cache_name, folder.string().c_str());
}

} // namespace cli
