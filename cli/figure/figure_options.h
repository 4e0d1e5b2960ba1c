// The options of `pt figure`: their names, help and syntax.
#pragma once

#include "cli/figure/composition.h"
#include "cli/figure/stage.h"
#include "cli/figure/view_frame.h"
#include "cli/image/display_options.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace cli {

inline constexpr std::array<std::string_view, 2> projection_names{"perspective", "orthographic"};
inline constexpr std::array<std::string_view, 2> box_names{"lines", "none"};

struct FigureOptions {
    std::string data;
    std::vector<std::string> outputs;
    std::optional<ImageFormat> format; // of an output that is standard output
    std::string legend;                // path of the SVG; empty: none
    std::string scene;                 // path of the scene file; empty: none

    std::int64_t frame = -1;
    bool wraps = false;
    std::string color;            // the column that the colours say; empty: types, if there are any
    std::optional<double> radius; // of all; nothing: the file's, or what suits the distances

    std::optional<ImageSize> size; // nothing: as the data are
    ViewDirection view{view_names.front(), {}};
    glm::dvec3 up{0.0, 0.0, 1.0};
    Projection projection = Projection::perspective;

    FigureStyle style = FigureStyle::matte;
    bool has_floor = false;
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
