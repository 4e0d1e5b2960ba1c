// Reads a file of particles and prints what that took: bytes of the file, particles, CPU seconds of reading and the
// largest memory of the process in MiB. For read_particles.py.
#include "cli/data/particle_file.h"

#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>

namespace {

double cpu_seconds(const rusage &usage) {
    const auto seconds = [](const timeval &time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

rusage usage_of_process() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage;
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
        const double before = cpu_seconds(usage_of_process());
        const cli::Particles particles = cli::read_particles(path, query);
        const rusage after = usage_of_process();
        std::printf("%ju %zu %.6f %.1f\n", static_cast<std::uintmax_t>(std::filesystem::file_size(path)),
                    particles.count(), cpu_seconds(after) - before, static_cast<double>(after.ru_maxrss) / 1024.0);
    } catch (const cli::Failure &failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
