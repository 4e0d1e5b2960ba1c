#include "cli/bench/bench_report.h"

#include "cli/base/device_text.h"
#include "cli/base/method_names.h"
#include "cli/render/render_report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

namespace cli {
namespace {

constexpr double noise_margin = 3.0;

template <typename Member>
std::vector<double> collect(const std::vector<BenchRun> &runs, Member member) {
    std::vector<double> values(runs.size());
    std::transform(runs.begin(), runs.end(), values.begin(), [member](const BenchRun &run) { return run.*member; });
    return values;
}

ImageError mean_error(const std::vector<BenchRun> &runs) {
    ImageError sum;
    for (const BenchRun &run : runs) {
        sum.mse += run.error.mse;
        sum.relative_mse += run.error.relative_mse;
    }
    const auto count = static_cast<double>(runs.size());
    return {sum.mse / count, sum.relative_mse / count};
}

bool is_near(const ImageError &error, const std::optional<ImageError> &noise) {
    return noise && (error.mse < noise_margin * noise->mse || error.relative_mse < noise_margin * noise->relative_mse);
}

BenchRow sum_up(const BenchCell &cell, const std::optional<ImageError> &noise) {
    BenchRow row{};
    row.sampler = samplers.name(cell.sampler);
    row.estimator = estimators.name(cell.estimator);
    row.target_error = cell.target_error > 0.0 ? std::optional(cell.target_error) : std::nullopt;
    row.sample_count = median(collect(cell.runs, &BenchRun::mean_sample_count));
    row.round_count = cell.runs.size();
    row.seconds = median(collect(cell.runs, &BenchRun::seconds));
    row.processor_seconds = median(collect(cell.runs, &BenchRun::processor_seconds));
    row.error = mean_error(cell.runs);
    row.efficiency = efficiency(row.error.relative_mse, row.seconds);
    row.near_reference_noise = is_near(row.error, noise);
    return row;
}

// A number that may be missing.
std::string optional_text(const char *format, const std::optional<double> &value) {
    std::array<char, 32> text{};
    if (value) {
        std::snprintf(text.data(), text.size(), format, *value);
    }
    return text.data();
}

std::string table_line(const BenchRow &row) {
    std::array<char, 192> text{};
    std::snprintf(text.data(), text.size(), "%-10s %-10s %8.6g %10.4f %10.4f %11.3e %11.3e%s %10s %7s\n",
                  std::string(row.sampler).c_str(), std::string(row.estimator).c_str(), row.sample_count, row.seconds,
                  row.processor_seconds, row.error.mse, row.error.relative_mse, row.near_reference_noise ? "*" : " ",
                  optional_text("%.3g", row.efficiency).c_str(), optional_text("%.2f", row.slope).c_str());
    return text.data();
}

std::string reference_text(const BenchReference &reference) {
    if (!reference.path.empty()) {
        return "reference: " + reference.path + "\n";
    }
    std::array<char, 128> text{};
    std::snprintf(text.data(), text.size(), "reference: %u spp, its own error about MSE %.3e, relMSE %.3e\n",
                  reference.sample_count, reference.noise->mse, reference.noise->relative_mse);
    return text.data();
}

nlohmann::ordered_json error_json(const ImageError &error) {
    return {{"mse", error.mse}, {"rel_mse", error.relative_mse}};
}

nlohmann::ordered_json reference_json(const BenchReference &reference) {
    if (!reference.path.empty()) {
        return {{"file", reference.path}};
    }
    return {{"spp", reference.sample_count}, {"seed", reference.seed}, {"own_error", error_json(*reference.noise)}};
}

nlohmann::ordered_json optional_json(const std::optional<double> &value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

// Whole without a target error.
nlohmann::ordered_json spp_json(const BenchRow &row) {
    return row.target_error ? nlohmann::ordered_json(row.sample_count)
                            : nlohmann::ordered_json(static_cast<std::uint32_t>(row.sample_count));
}

nlohmann::ordered_json row_json(const BenchRow &row) {
    return {{"sampler", row.sampler},
            {"estimator", row.estimator},
            {"target_error", optional_json(row.target_error)},
            {"spp", spp_json(row)},
            {"rounds", row.round_count},
            {"seconds", row.seconds},
            {"processor_seconds", row.processor_seconds},
            {"mse", row.error.mse},
            {"rel_mse", row.error.relative_mse},
            {"efficiency", optional_json(row.efficiency)},
            {"slope", optional_json(row.slope)},
            {"near_reference_noise", row.near_reference_noise}};
}

} // namespace

std::vector<BenchRow> bench_rows(const BenchReport &report) {
    std::vector<BenchRow> rows;
    for (const BenchCell &cell : report.cells) {
        if (cell.runs.empty()) {
            continue;
        }
        BenchRow row = sum_up(cell, report.reference.noise);
        if (!rows.empty() && rows.back().sampler == row.sampler && rows.back().estimator == row.estimator) {
            const BenchRow &before = rows.back();
            row.slope = convergence_slope(before.error.mse, before.sample_count, row.error.mse, row.sample_count);
        }
        rows.push_back(row);
    }
    return rows;
}

std::string bench_table(const BenchReport &report) {
    const std::vector<BenchRow> rows = bench_rows(report);
    std::array<char, 192> heading{};
    std::snprintf(heading.data(), heading.size(), "%-10s %-10s %8s %10s %10s %11s %11s  %10s %7s\n", "sampler",
                  "estimator", "spp", "seconds", "cpu s", "MSE", "relMSE", "efficiency", "slope");
    std::string text = std::to_string(report.render.width) + "x" + std::to_string(report.render.height) + " on " +
                       report.device.name + "; " + reference_text(report.reference) + heading.data();
    for (const BenchRow &row : rows) {
        text += table_line(row);
    }
    if (std::any_of(rows.begin(), rows.end(), [](const BenchRow &row) { return row.near_reference_noise; })) {
        text += "* less than 3 times the reference's own error: too good to be told; raise --reference-spp\n";
    }
    return text;
}

std::string bench_csv(const BenchReport &report) {
    std::ostringstream text;
    text.precision(9);
    text << "sampler,estimator,target_error,spp,rounds,seconds,processor_seconds,mse,rel_mse,efficiency,slope,"
            "near_reference_noise\n";
    for (const BenchRow &row : bench_rows(report)) {
        text << row.sampler << ',' << row.estimator << ',' << optional_text("%.9g", row.target_error) << ','
             << row.sample_count << ',' << row.round_count << ',' << row.seconds << ',' << row.processor_seconds << ','
             << row.error.mse << ',' << row.error.relative_mse << ',' << optional_text("%.9g", row.efficiency) << ','
             << optional_text("%.9g", row.slope) << ',' << (row.near_reference_noise ? "1" : "0") << '\n';
    }
    return text.str();
}

nlohmann::ordered_json bench_json(const BenchReport &report) {
    const pt_render &render = report.render;
    nlohmann::ordered_json cells = nlohmann::ordered_json::array();
    for (const BenchRow &row : bench_rows(report)) {
        cells.push_back(row_json(row));
    }
    return {{"version", version_text()},
            {"scene", report.scene},
            {"width", render.width},
            {"height", render.height},
            {"max_path_length", render.max_path_length},
            {"seed", render.seed},
            {"rounds_requested", report.requested_round_count},
            {"device",
             {{"name", report.device.name}, {"driver", report.device.driver}, {"uuid", uuid_text(report.device.uuid)}}},
            {"reference", reference_json(report.reference)},
            {"cells", cells}};
}

} // namespace cli
