#include "cli/base/vector_width.h"

#include "cli/base/devices.h"
#include "cli/base/environment.h"
#include "cli/base/exit_code.h"
#include "cli/base/file.h"
#include "lib/base/struct_size.h"
#include "lib/platform/process.h"

#include <pt/pt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>
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
constexpr std::size_t longest_record = 1024;
constexpr std::uint64_t run_count = 6;

// Building four kernels takes about as long as this many samples.
constexpr std::uint64_t measured_from = std::uint64_t{1} << 24;

std::string processor() {
    std::string name;
#if defined(__x86_64__)
    for (unsigned int leaf = 0x80000002; leaf <= 0x80000004; ++leaf) {
        std::array<unsigned int, 4> words{};
        __get_cpuid(leaf, words.data(), &words[1], &words[2], &words[3]);
        name.append(reinterpret_cast<const char *>(words.data()), sizeof(words));
    }
#endif
    std::erase_if(name, [](char letter) { return letter < ' ' || letter > '~'; });
    return name;
}

struct TrialScene {
    explicit TrialScene(bool has_tree) {
        std::minstd_rand random(1);
        const auto between = [&](double low, double high) {
            return low + (high - low) * static_cast<double>(random() - 1) / (std::minstd_rand::max() - 1);
        };
        const unsigned int count = has_tree ? 1000 : 4;
        const double radius = has_tree ? 0.2 : 0.9;
        spheres.push_back({.center = {2, 6.5, 6}, .radius = 0.6, .motion = {}, .material = 1, .reserved = 0});
        for (unsigned int i = 0; i < count; ++i)
            spheres.push_back({.center = {between(-4, 4), between(0.05, 4), between(-2, 2)},
                               .radius = radius * between(0.4, 1),
                               .motion = {},
                               .material = 0,
                               .reserved = 0});
        std::ranges::fill(materials[0].diffuse, 0.6F);
        std::ranges::fill(materials[1].emission, 50.0F);
    }

    pt_result describe(pt_context *context) const {
        auto scene = pt::sized<pt_scene>();
        scene.material_count = static_cast<std::uint32_t>(materials.size());
        scene.materials = materials.data();
        scene.sphere_count = static_cast<std::uint32_t>(spheres.size());
        scene.spheres = spheres.data();
        scene.plane_count = 1;
        scene.planes = &floor;
        auto camera = pt::sized<pt_camera>();
        camera.position[1] = camera.target[1] = 2;
        camera.position[2] = 6.5;
        const pt_result result = pt_set_scene(context, &scene);
        return result < 0 ? result : pt_set_camera(context, &camera);
    }

    std::vector<pt_sphere> spheres;
    std::array<pt_material, 2> materials{};
    pt_plane floor{.normal = {0, 1, 0}, .offset = 0, .material = 0, .reserved = 0};
};

pt_result take_samples(pt_context *context, std::uint32_t count, std::uint64_t seed) {
    auto render = pt::sized<pt_render>();
    render.width = 64;
    render.height = 32;
    render.max_path_length = 3;
    render.seed = seed;
    auto samples = pt::sized<pt_accumulate_info>();
    samples.sample_count = count;
    const pt_result result = pt_set_render(context, &render);
    return result < 0 ? result : pt_accumulate(context, &samples);
}

// Returns the least CPU seconds of several runs, because other processes only add time. Infinite on failure.
double seconds_at(unsigned int bits, const std::string &device, const TrialScene &scene, std::uint32_t sample_count) {
    constexpr double failed = std::numeric_limits<double>::infinity();
    auto info = pt::sized<pt_create_info>();
    info.flags = PT_CREATE_NO_SCENE_KERNELS;
    info.device = device.c_str();
    pt_context *created = nullptr;
    if (pt_create(&info, &created) < 0)
        return failed;
    const std::unique_ptr<pt_context, decltype(&pt_destroy)> context(created, &pt_destroy);
    pt_device_info found{};
    if (pt_get_context_device(created, &found) < 0 ||
        std::string_view(found.name).find(std::to_string(bits) + " bits") == std::string_view::npos ||
        scene.describe(created) < 0 || take_samples(created, 1, 0) < 0)
        return failed;
    double least = failed;
    for (std::uint64_t seed = 0; seed < run_count; ++seed) {
        const std::clock_t start = std::clock();
        if (take_samples(created, sample_count, seed) < 0)
            return failed;
        least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return least;
}

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

std::optional<KeptWidth> read_width(const fs::path &file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error))
        return std::nullopt;
    std::string text(longest_record, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    std::istringstream lines(text);
    std::string bits;
    std::string owner;
    std::string driver;
    std::getline(lines, bits);
    std::getline(lines, owner);
    std::getline(lines, driver);
    if ((bits != "256" && bits != "512") || owner != processor() || lines.eof())
        return std::nullopt;
    return KeptWidth{bits == "512" ? wide : narrow, driver};
}

void write_width(const fs::path &file, const KeptWidth &width) {
    const std::string text = std::to_string(width.bits) + '\n' + processor() + '\n' + width.driver + '\n';
    try {
        AtomicFile written(file.string());
        written.write(std::as_bytes(std::span(text)));
        written.commit();
    } catch (const Failure &) {
        return; // measured again next time
    }
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
    return is_free_ && use_.sample_count >= measured_from && !file_.empty() && driver_ != device.driver &&
           std::string_view(device.name).starts_with("llvmpipe");
}

void VectorWidth::measure(const pt_device_info &device) {
    const std::string uuid = uuid_text(device.uuid);
    const TrialScene scene(use_.has_tree);
    const std::uint32_t sample_count = use_.has_tree ? 8 : 64;
    set(narrow);
    const double of_narrow = seconds_at(narrow, uuid, scene, sample_count);
    set(wide);
    const double of_wide = seconds_at(wide, uuid, scene, sample_count);
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
