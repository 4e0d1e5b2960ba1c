#include "lib/platform/process.h"

#include <mach-o/dyld.h>
#include <string>
#include <sys/resource.h>
#include <sys/sysctl.h>

namespace platform {

std::filesystem::path program_file() {
    std::uint32_t size = 0;
    _NSGetExecutablePath(nullptr, &size);
    std::string path(size, '\0');
    _NSGetExecutablePath(path.data(), &size);
    return std::filesystem::canonical(path.c_str());
}

std::uint64_t peak_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss);
}

std::uint64_t most_bytes() {
    std::uint64_t memory = 0;
    std::size_t size = sizeof memory;
    return sysctlbyname("hw.memsize", &memory, &size, nullptr, 0) == 0 ? memory : UINT64_MAX;
}

} // namespace platform
