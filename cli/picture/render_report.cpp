#include "cli/picture/render_report.h"

#include "cli/base/devices.h"
#include "cli/base/json.h"
#include "cli/base/text.h"
#include "lib/platform/process.h"
#include "lib/scene_file/enumerations.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

namespace cli {
namespace {

template <std::size_t Count>
std::vector<std::string_view> names_of(std::uint32_t bits, const pt::ValueNames<Count> &all) {
    std::vector<std::string_view> names;
    for (const std::string_view name : all.names())
        if ((bits & all.find(name).value()) != 0)
            names.push_back(name);
    return names;
}

nlohmann::ordered_json crop_json(const ImageWindow &window) {
    const Rectangle &part = window.part;
    return window.is_whole() ? nlohmann::ordered_json(nullptr)
                             : nlohmann::ordered_json{part.x, part.y, part.width, part.height};
}

double samples_per_second(const RenderReport &report) {
    const double pixels = static_cast<double>(report.render.width) * report.window.part.height; // counts whole rows
    return report.accumulate_seconds > 0.0 ? pixels * report.stats.mean_sample_count / report.accumulate_seconds : 0.0;
}

// Empty if the relative error is reliable.
std::string uncertainty_text(std::uint32_t uncertain) {
    if ((uncertain & PT_UNCERTAIN_UNMET) != 0)
        return ", uncertain: few samples hit small lamps, take more";
    if ((uncertain & PT_UNCERTAIN_RELATIVE_RMSE) != 0)
        return ", uncertain: a few bright pixels cause most of it, take more samples";
    return (uncertain & PT_UNCERTAIN_UNSEEN) != 0 ? ", uncertain: dark pixels beside bright ones may have light that "
                                                    "no sample has hit, take more samples"
                                                  : "";
}

std::string estimate_text(const RenderReport &report) {
    const pt_error_estimate &error = report.error;
    if (!std::isfinite(error.relative_rmse)) {
        const std::uint32_t first_check = pt_next_check(0);
        const std::string reason = " with fewer than " + std::to_string(first_check) + " samples";
        return "error unknown" + (report.stats.sample_count < first_check ? reason : uncertainty_text(error.uncertain));
    }
    return "error " + percent_text(error.relative_rmse) + " (" + percent_text(error.relative_rmse_low) + " to " +
           percent_text(error.relative_rmse_high) + ")" + uncertainty_text(error.uncertain);
}

// "64", or "37.3 (16 to 256)" if pixels differ.
std::string samples_text(const pt_stats &stats) {
    if (stats.sample_count == stats.max_sample_count)
        return std::to_string(stats.sample_count);
    return formatted("%.1f (%u to %u)", stats.mean_sample_count, stats.sample_count, stats.max_sample_count);
}

std::string target_text(const RenderReport &report) {
    const std::string count = samples_text(report.stats);
    const std::string samples = count + (count == "1" ? " sample" : " samples");
    if (report.target_reached)
        return "target reached after " + samples;
    const std::string high = std::isfinite(report.error.relative_rmse_high)
                                 ? percent_text(report.error.relative_rmse_high) + " is above "
                                 : "unknown error for ";
    const bool interrupted = report.stats.max_sample_count < report.requested_sample_count;
    return "target not reached: " + high + percent_text(report.target_error) + " after " + samples +
           (interrupted ? "" : ", raise --spp");
}

} // namespace

RenderReport film_report(const FilmHandle &film) {
    const pt_film_info info = film.info();
    RenderReport report{};
    report.render.width = info.width;
    report.render.height = info.height;
    report.window = {{info.x, info.y, info.columns, info.rows}, info.width, info.height};
    report.render.max_path_length = info.max_path_length;
    report.render.seed = info.seed;
    report.render.first_sample = static_cast<std::uint32_t>(film.hull().first);
    report.render.estimator = info.estimator;
    report.render.sampler = info.sampler;
    report.stats = film.stats();
    report.error = film.error_estimate();
    report.requested_sample_count = report.stats.sample_count;
    std::snprintf(report.device.name, sizeof report.device.name, "%s", info.device);
    return report;
}

nlohmann::ordered_json error_json(const pt_error_estimate &error) {
    return {{"rmse", number_or_null(error.rmse)},
            {"rmse_low", number_or_null(error.rmse_low)},
            {"rmse_high", number_or_null(error.rmse_high)},
            {"relative_rmse", number_or_null(error.relative_rmse)},
            {"relative_rmse_low", number_or_null(error.relative_rmse_low)},
            {"relative_rmse_high", number_or_null(error.relative_rmse_high)},
            {"uncertain", names_of(error.uncertain, pt::uncertainties)}};
}

nlohmann::ordered_json stats_json(const RenderReport &report) {
    const pt_render &render = report.render;
    nlohmann::ordered_json stats{{"version", version_text()},
                                 {"scene", report.scene},
                                 {"width", render.width},
                                 {"height", render.height},
                                 {"crop", crop_json(report.window)},
                                 {"spp", report.stats.sample_count},
                                 {"spp_mean", report.stats.mean_sample_count},
                                 {"spp_max", report.stats.max_sample_count},
                                 {"spp_requested", report.requested_sample_count},
                                 {"first_sample", render.first_sample},
                                 {"seed", render.seed},
                                 {"max_path_length", render.max_path_length},
                                 {"sampler", pt::samplers.name(render.sampler)},
                                 {"estimator", pt::estimators.name(render.estimator)},
                                 {"device", device_json(report.device)},
                                 {"denoised", report.is_denoised}};
    stats.update(error_json(report.error));
    stats.update(nlohmann::ordered_json{
        {"target_error", report.target_error > 0.0 ? nlohmann::ordered_json(report.target_error) : nullptr},
        {"target_reached", report.target_reached},
        {"ended_by", report.ended_by},
        {"seconds",
         {{"create", report.create_seconds},
          {"accumulate", report.accumulate_seconds},
          {"device", report.stats.device_seconds},
          {"total", report.total_seconds}}},
        {"submissions", report.stats.submit_count},
        {"rejected_samples", report.stats.rejected_samples},
        {"device_bytes", report.stats.device_bytes},
        {"peak_host_bytes", platform::peak_bytes()},
        {"features", names_of(report.stats.features, pt::features)},
        {"samples_per_second", samples_per_second(report)},
        {"tone_map", tone_map_json(report.tone_map)},
        {"warnings", report.warnings}});
    return stats;
}

std::string summary_text(const RenderReport &report) {
    return window_text(report.window) + ", " + samples_text(report.stats) +
           formatted(report.is_denoised ? " spp, denoised, in %.2f s on " : " spp in %.2f s on ",
                     report.total_seconds) +
           report.device.name;
}

std::string error_text(const RenderReport &report) {
    return estimate_text(report) + (report.target_error > 0.0 ? "; " + target_text(report) : "");
}

// Without a date, equal runs give equal files. Numbers beyond OpenEXR's int32 are texts.
std::vector<ImageAttribute> image_metadata(const RenderReport &report, const ToneMap *tone_map) {
    std::vector<ImageAttribute> attributes;
    const auto add = [&](const char *name, auto value) { attributes.push_back({name, std::move(value)}); };
    const auto whole = [](std::uint32_t number) {
        return static_cast<std::int32_t>(std::min<std::uint32_t>(number, std::numeric_limits<std::int32_t>::max()));
    };
    add("software", "pt " + version_text());
    add("samplesPerPixel", whole(report.stats.sample_count));
    add("pt.quantity", std::string(tone_map != nullptr ? "tone-mapped " : "") +
                           (report.is_denoised ? "denoised radiance" : "radiance"));
    if (tone_map != nullptr)
        add_tone_map(attributes, *tone_map);
    if (!report.window.is_whole())
        add("pt.crop", window_text(report.window));
    if (!report.scene.empty())
        add("pt.scene", std::filesystem::path(report.scene).filename().string());
    add("pt.seed", std::to_string(report.render.seed));
    add("pt.firstSample", std::to_string(report.render.first_sample));
    add("pt.maxPathLength", whole(report.render.max_path_length));
    add("pt.sampler", std::string(pt::samplers.name(report.render.sampler)));
    add("pt.estimator", std::string(pt::estimators.name(report.render.estimator)));
    add("pt.rejectedSamples", std::to_string(report.stats.rejected_samples));
    if (std::isfinite(report.error.relative_rmse))
        add("pt.relativeError", report.error.relative_rmse);
    add("pt.device", std::string(report.device.name));
    if (report.device.driver[0] != '\0')
        add("pt.driver", std::string(report.device.driver));
    return attributes;
}

} // namespace cli
