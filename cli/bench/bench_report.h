// The results of `pt bench` and their forms: a table for people, CSV and JSON.
#pragma once

#include "cli/image/error_metrics.h"

#include <pt/devices.h>
#include <pt/pt.h>

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

struct BenchRun {
    double mean_sample_count; // of a pixel
    double seconds;           // wall clock
    double processor_seconds; // of all threads of this process
    ImageError error;
};

struct BenchCell {
    std::uint32_t sampler;
    std::uint32_t estimator;
    std::uint32_t sample_count; // of a pixel, or with a target error at most
    double target_error;        // 0: none
    std::vector<BenchRun> runs; // one for each round that was finished
};

struct BenchReference {
    std::string path; // empty: rendered with the settings that follow
    std::uint64_t seed = 0;
    std::uint32_t sample_count = 0;
    std::optional<ImageError> noise; // unknown for a file
};

struct BenchReport {
    std::string scene;
    pt_render render;
    pt_device_info device;
    std::uint32_t requested_round_count;
    BenchReference reference;
    std::vector<BenchCell> cells; // those of one sampler and estimator together, by ascending cost
};

// A cell that was finished at least once, summed up.
struct BenchRow {
    std::string_view sampler;
    std::string_view estimator;
    std::optional<double> target_error;
    double sample_count; // of a pixel: the mean, and of the rounds the median
    std::size_t round_count;
    double seconds;
    double processor_seconds;
    ImageError error;
    std::optional<double> efficiency; // nothing where the error is 0
    std::optional<double> slope;      // nothing at the first sample count
    bool near_reference_noise;        // the error is less than 3 times the reference's own
};

std::vector<BenchRow> bench_rows(const BenchReport &report);

std::string bench_table(const BenchReport &report);
std::string bench_csv(const BenchReport &report);
nlohmann::ordered_json bench_json(const BenchReport &report);

} // namespace cli
