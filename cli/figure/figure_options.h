// The options of `pt figure`: their names, help and syntax.
#pragma once

#include "cli/data/particle_colour.h"
#include "cli/data/particle_radius.h"
#include "cli/figure/composition.h"
#include "cli/image/display_options.h"
#include "cli/layout/figure_look.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace cli {

inline constexpr std::array<std::string_view, 2> box_names{"lines", "none"};

struct FigureOptions {
    std::string data;
    std::vector<std::string> outputs;
    std::optional<ImageFormat> format; // of an output that is standard output
    std::string legend;                // path of the SVG; empty: none
    std::string scene;                 // path of the scene file; empty: none

    std::int64_t frame = -1;
    bool wraps = false;
    std::vector<std::string> where; // conditions of particles that are shown
    ParticleRadius radius;
    std::string radius_text; // as it was given
    ParticleColour color;
    std::string color_text;
    std::optional<std::string> colormap;
    std::optional<std::array<double, 2>> color_range;

    std::optional<ImageSize> size; // nothing: as the data are
    FigureLook look;

    FigureBackground background = FigureBackground::white;
    bool has_outlines = false;
    bool shows_box = true;
    DisplayOptions display;

    std::optional<std::uint32_t> sample_count;
    std::optional<std::uint64_t> seed;
    std::string device;
    std::string progress = "auto";
    bool quiet = false;
};

inline constexpr std::uint32_t default_figure_samples = 128;

extern const char *const figure_help;

// The options write into `options` when the command line is parsed, so it has to live as long as the command.
void add_figure_options(CLI::App &command, FigureOptions &options);

} // namespace cli
