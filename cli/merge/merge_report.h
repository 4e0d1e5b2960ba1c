// What a sum of films has, and what it lacks: as JSON and for people.
#pragma once

#include "cli/film/film_handle.h"
#include "cli/merge/merge_command.h"
#include "cli/render/render_report.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace cli {

struct MergeReport {
    RenderReport picture; // as far as a film says it
    pt_film_info info;
    std::size_t part_count;
    std::vector<pt_sample_range> samples; // that all pixels have
    std::vector<pt_sample_range> missing; // of those that there should be, some pixel has not
};

MergeReport merge_report(const FilmHandle &film, const MergeOptions &options);

nlohmann::ordered_json stats_json(const MergeReport &report);

// "8 films of 320x160 pixels: 64 spp, samples [0, 64)", and a line of what is missing, if anything is.
std::string summary_text(const MergeReport &report);
std::string missing_text(const MergeReport &report);

} // namespace cli
