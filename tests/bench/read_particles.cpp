// Reads a file of particles and prints what that took: bytes of the file, particles, CPU seconds of reading and the
// largest memory of the process in MiB. For read_particles.py.
#include "cli/data/particle_file.h"

#include <sys/resource.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

double cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval &time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Not that of getrusage, which counts the process that started this one.
double peak_mebibytes() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (double kibibytes = 0.0; word == "VmHWM:" && status >> kibibytes)
            return kibibytes / 1024.0;
    return 0.0;
}

} // namespace

int main(int count, char **arguments) {
    if (count < 2) {
        std::fputs("usage: pt_read_particles FILE [COLUMN]...\n", stderr);
        return EXIT_FAILURE;
    }
    const std::string path = arguments[1];
    cli::ParticleQuery query;
    query.columns.assign(arguments + 2, arguments + count);
    try {
        const double before = cpu_seconds();
        const cli::Particles particles = cli::read_particles(path, query);
        const double seconds = cpu_seconds() - before;
        std::printf("%ju %zu %.6f %.1f\n", static_cast<std::uintmax_t>(std::filesystem::file_size(path)),
                    particles.count(), seconds, peak_mebibytes());
    } catch (const cli::Failure &failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
