#include "lib/platform/process.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sys/resource.h>
#include <sys/sysinfo.h>

namespace platform {

std::filesystem::path program_file() {
    return std::filesystem::read_symlink("/proc/self/exe");
}

std::uint64_t peak_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::uint64_t most_bytes() {
    // The container's limit (cgroup v2). The file has the word "max" if there is no limit.
    std::uint64_t container = 0;
    if (!(std::ifstream("/sys/fs/cgroup/memory.max") >> container))
        container = std::numeric_limits<std::uint64_t>::max();
    struct sysinfo system {};
    rlimit address_space{};
    sysinfo(&system);
    getrlimit(RLIMIT_AS, &address_space);
    const auto bytes = [&](std::uint64_t units) { return units * system.mem_unit; };
    return std::min<std::uint64_t>(std::min(bytes(system.totalram), container) + bytes(system.totalswap),
                                   address_space.rlim_cur);
}

} // namespace platform
