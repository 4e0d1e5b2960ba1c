#include "cli/merge/merge_report.h"

#include "cli/base/device_text.h"
#include "cli/base/method_names.h"
#include "cli/base/source_date.h"
#include "cli/base/text.h"
#include "cli/film/sample_ranges.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

namespace cli {
namespace {

using Ranges = std::vector<pt_sample_range>;

// From the first to the last sample of any pixel.
pt_sample_range hull_of(const std::vector<Ranges> &tiles) {
    pt_sample_range hull{std::numeric_limits<std::uint64_t>::max(), 0};
    for (const Ranges &ranges : tiles) {
        hull.first = std::min(hull.first, ranges.front().first);
        hull.end = std::max(hull.end, ranges.back().end);
    }
    return hull;
}

// What some of them has, in ascending order.
Ranges united(Ranges ranges) {
    std::sort(ranges.begin(), ranges.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    Ranges all;
    for (const pt_sample_range &range : ranges)
        if (!all.empty() && range.first <= all.back().end)
            all.back().end = std::max(all.back().end, range.end);
        else
            all.push_back(range);
    return all;
}

Ranges missing_in_any(const pt_sample_range &wanted, const std::vector<Ranges> &tiles) {
    Ranges missing;
    for (const Ranges &ranges : tiles) {
        const Ranges lacked = missing_of(wanted, ranges);
        missing.insert(missing.end(), lacked.begin(), lacked.end());
    }
    return united(std::move(missing));
}

pt_sample_range wanted_range(const MergeOptions &options, const pt_sample_range &hull) {
    const std::uint64_t first = options.first_sample.value_or(static_cast<std::uint32_t>(hull.first));
    return {first, options.sample_count ? first + *options.sample_count : std::max(first, hull.end)};
}

RenderReport picture_of(const FilmHandle &film, const pt_film_info &info, const pt_sample_range &hull) {
    RenderReport picture{};
    picture.date = source_date();
    picture.render.width = info.width;
    picture.render.height = info.height;
    picture.window = {{info.x, info.y, info.columns, info.rows}, info.width, info.height};
    picture.render.max_path_length = info.max_path_length;
    picture.render.seed = info.seed;
    picture.render.first_sample = static_cast<std::uint32_t>(hull.first);
    picture.render.estimator = info.estimator;
    picture.render.sampler = info.sampler;
    picture.stats = film.stats();
    picture.requested_sample_count = picture.stats.sample_count;
    std::snprintf(picture.device.name, sizeof picture.device.name, "%s", info.device);
    return picture;
}

nlohmann::ordered_json json_of(const Ranges &ranges) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const pt_sample_range &range : ranges)
        list.push_back({range.first, range.end});
    return list;
}

} // namespace

MergeReport merge_report(const FilmHandle &film, const MergeOptions &options) {
    std::vector<Ranges> tiles;
    for (std::uint32_t i = 0; i < film.info().tile_count; ++i)
        tiles.push_back(film.ranges(i));
    const pt_sample_range hull = hull_of(tiles);
    MergeReport report{picture_of(film, film.info(), hull), film.info(), options.parts.size(), {}, {}};
    report.samples = missing_of(hull, missing_in_any(hull, tiles));
    report.missing = missing_in_any(wanted_range(options, hull), tiles);
    return report;
}

nlohmann::ordered_json stats_json(const MergeReport &report) {
    const pt_film_info &info = report.info;
    nlohmann::ordered_json stats{{"version", version_text()},
                                 {"films", report.part_count},
                                 {"width", info.width},
                                 {"height", info.height},
                                 {"rectangle", {info.x, info.y, info.columns, info.rows}},
                                 {"tiles", info.tile_count},
                                 {"spp", report.picture.stats.sample_count},
                                 {"samples", json_of(report.samples)},
                                 {"missing", json_of(report.missing)},
                                 {"seed", info.seed},
                                 {"max_path_length", info.max_path_length},
                                 {"sampler", samplers.name(info.sampler)},
                                 {"estimator", estimators.name(info.estimator)},
                                 {"device", info.device}};
    stats.update(error_json(report.picture.stats));
    stats.update(nlohmann::ordered_json{{"rejected_samples", report.picture.stats.rejected_samples},
                                        {"tone_map", tone_map_json(report.picture)}});
    return stats;
}

std::string summary_text(const MergeReport &report) {
    return concat(report.part_count, report.part_count == 1 ? " film of " : " films of ", report.info.columns, "x",
                  report.info.rows, " pixels: ", report.picture.stats.sample_count, " spp, samples ",
                  ranges_text(report.samples));
}

std::string missing_text(const MergeReport &report) {
    return report.missing.empty() ? ""
                                  : concat(sample_count_of(report.missing),
                                           " samples per pixel are missing: ", ranges_text(report.missing));
}

} // namespace cli
