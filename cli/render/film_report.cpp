#include "cli/render/film_report.h"

#include <cstdio>

namespace cli {

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

} // namespace cli
