// The options of `pt bench`: their names, help and syntax.
#pragma once

#include "cli/base/number.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace cli {

struct BenchOptions {
    std::string scene;

    std::optional<ImageSize> size;
    std::optional<std::uint32_t> max_path_length;
    std::optional<std::uint64_t> seed;

    // Without repetitions; sample counts in ascending order.
    std::vector<std::uint32_t> samplers;
    std::vector<std::uint32_t> estimators;
    std::vector<std::uint32_t> sample_counts{16, 64, 256, 1024};
    std::vector<double> target_errors; // falling; if there are any, in place of sample counts
    std::uint32_t round_count = 3;

    std::string reference; // path; empty: rendered first
    std::optional<std::uint32_t> reference_sample_count;

    std::string device;
    std::string csv;
    std::string json;
    std::string progress = "auto";
    bool quiet = false;

    BenchOptions(); // all samplers, the best estimator
};

extern const char *const bench_help;

// The options write into `options` when the command line is parsed, so it has to live as long as the command.
void add_bench_options(CLI::App &command, BenchOptions &options);

} // namespace cli
