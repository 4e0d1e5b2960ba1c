// The command `pt merge`: films of one picture in, images and their sum out.
#pragma once

#include "cli/film/film.h"
#include "cli/render/render_options.h"
#include "cli/render/render_report.h"
#include "cli/scene/scene_override.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

struct MergeOptions {
    std::vector<std::string> parts;

    // The range of which missing samples are told: that of the parts' first and last one where nothing is given.
    std::optional<std::uint32_t> first_sample;
    std::optional<std::uint32_t> sample_count;

    OutputOptions output;
    std::vector<SceneOverride> display; // how pictures are shown
};

extern const char *const merge_help;

// The options write into `options` when the command line is parsed, so it has to live as long as the command.
void add_merge_options(CLI::App &command, MergeOptions &options);

// Returns the exit code; throws Failure.
int run_merge(const MergeOptions &options);

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
