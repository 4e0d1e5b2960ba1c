#include "cli/base/host_memory.h"

#include "cli/base/device_text.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sys/resource.h>
#include <sys/sysinfo.h>

namespace cli {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

// The memory limit of a container, as seen from inside of it (Linux, cgroup v2). The file says "max" where there is no
// limit, and does not exist outside of containers.
std::uint64_t container_limit() {
    std::uint64_t bytes = 0;
    return std::ifstream("/sys/fs/cgroup/memory.max") >> bytes ? bytes : unlimited;
}

std::uint64_t address_space_limit() {
    rlimit limit{};
    return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? limit.rlim_cur : unlimited;
}

// The most that this process could ever have: memory and swap space, within its limits. What others use is not counted.
std::uint64_t most_bytes() {
    struct sysinfo system {};
    if (sysinfo(&system) != 0)
        return address_space_limit();
    const std::uint64_t memory = std::min(std::uint64_t{system.totalram} * system.mem_unit, container_limit());
    return std::min(memory + std::uint64_t{system.totalswap} * system.mem_unit, address_space_limit());
}

} // namespace

std::uint64_t image_bytes(const ImageWindow &window, std::uint32_t image_count) {
    constexpr std::uint64_t pixel_bytes = 3 * sizeof(float);
    return pixel_bytes * window.part.width * window.part.height * image_count;
}

void require_host_memory(const RenderSettings &settings, const std::string &scene, std::uint32_t image_count) {
    const std::uint64_t needed = image_bytes(settings.window, image_count);
    const std::uint64_t most = most_bytes();
    if (needed <= most)
        return;
    const std::string size = window_text(settings.window);
    const bool from_scene = settings.is_size_from_scene();
    throw Failure(from_scene ? ExitCode::scene : ExitCode::usage,
                  (from_scene ? scene + ": film of " : "--size ") + size + ": " +
                      (image_count == 1 ? "the image takes " : std::to_string(image_count) + " images take ") +
                      memory_text(needed) + " of memory, more than the " + memory_text(most) +
                      " that this process can have");
}

} // namespace cli
