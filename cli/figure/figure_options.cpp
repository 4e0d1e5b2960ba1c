#include "cli/figure/figure_options.h"

#include "cli/base/common_options.h"

#include <limits>

namespace cli {
namespace {

std::optional<Projection> find_projection(std::string_view name) {
    return name == "perspective"    ? std::optional(Projection::perspective)
           : name == "orthographic" ? std::optional(Projection::orthographic)
                                    : std::nullopt;
}

std::optional<bool> find_box(std::string_view name) {
    return name == "lines" ? std::optional(true) : name == "none" ? std::optional(false) : std::nullopt;
}

void add_output_options(CLI::App &command, FigureOptions &options) {
    const std::string group = "Output";
    command
        .add_option("-o,--output", options.outputs,
                    "Image to write, may be given again: .png, .jpg are the figure; .exr is the linear radiance of its "
                    "scene; - is standard output")
        ->expected(1)
        ->take_all()
        ->type_name("IMAGE")
        ->group(group);
    add_format(command, options.format, image_format_names)->group(group);
    command.add_option("--legend", options.legend, "Write what the colours say, as a picture of its own")
        ->type_name("SVG")
        ->group(group);
    command
        .add_option("--write-scene", options.scene,
                    "Write the scene file that is rendered, which `pt render` takes; -o may be left out then")
        ->type_name("SCENE")
        ->group(group);
}

void add_data_options(CLI::App &command, FigureOptions &options) {
    const std::string group = "Data";
    add_whole_number<std::int64_t>(command, "--frame", options.frame, std::numeric_limits<std::int64_t>::min(),
                                   "Frame of the file: 0 is the first, -1 the last, -2 the one before (default: -1)")
        ->group(group);
    command.add_flag("--wrap", options.wraps, "Bring particles that have left a periodic box back into it")
        ->group(group);
}

void add_particle_options(CLI::App &command, FigureOptions &options) {
    const std::string group = "Particles";
    command
        .add_option("--color", options.color,
                    "Column whose numbers the colours say (default: types, where the file has them)")
        ->type_name("COLUMN")
        ->group(group);
    constexpr double least = 1e-18;
    constexpr double most = 1e18;
    add_real_number(
        command, "--radius", options.radius, least, most,
        "Radius of all balls (default: the column radius, else half of what most nearest neighbours are apart)")
        ->type_name("R")
        ->group(group);
}

void add_view_options(CLI::App &command, FigureOptions &options) {
    const std::string group = "View";
    add_size(command, options.size)
        ->group(group)
        ->description("Width and height of the picture (default: 1024x768 pixels in the shape of the data)");
    const auto read_view = [&options](const std::string &text) {
        const auto view = parse_view(text);
        if (!view) {
            refuse_option("--view",
                          "must be " + alternatives(view_names) + ", or three numbers like 1,-2,0.5, not all 0", text);
        }
        options.view = *view;
    };
    command
        .add_option_function<std::string>(
            "--view", read_view,
            "From where the data are seen: a side, or the direction to the camera (default: three-quarter)")
        ->type_name(alternatives(view_names) + "|X,Y,Z")
        ->group(group);
    const auto read_up = [&options](const std::string &text) {
        const auto up = parse_up(text);
        if (!up) {
            refuse_option("--up", "must be x, y or z, with or without a minus sign, or three numbers, not all 0", text);
        }
        options.up = *up;
    };
    command.add_option_function<std::string>("--up", read_up, "What is up in the data (default: z)")
        ->type_name("x|y|z|-x|-y|-z|X,Y,Z")
        ->group(group);
    add_name(command, "--projection", options.projection, &find_projection, "projection", projection_names,
             "Far balls look smaller, or as large as near ones (default: perspective)")
        ->group(group);
}

void add_look_options(CLI::App &command, FigureOptions &options) {
    const std::string group = "Look";
    add_name(command, "--style", options.style, &find_figure_style, "style", figure_style_names,
             "Surfaces and light; ambient-occlusion has light from all sides alone (default: matte)")
        ->group(group);
    command.add_flag("--outlines", options.has_outlines, "Draw dark lines round the balls")->group(group);
    command.add_flag("--floor", options.has_floor, "Put the data on a floor, on which their shadows fall")
        ->group(group);
    add_name(command, "--background", options.background, &find_figure_background, "background",
             figure_background_names, "What is behind (default: white)")
        ->group(group);
    add_name(command, "--box", options.shows_box, &find_box, "box", box_names,
             "The simulation box, where the file has one (default: lines)")
        ->group(group);
}

} // namespace

const char *const figure_help =
    "DATA is of a simulation, a molecule or a point cloud. The camera goes as near as it can with all of every ball "
    "in\n"
    "the picture. All lengths follow from the data, so that their units do not matter. Bonds are not drawn.\n\n"
    "The scene of --write-scene is the figure without its background, outlines and lines of the box, which are laid "
    "over\n"
    "the rendered picture: `pt render` makes the same .exr of it.\n";

void add_figure_options(CLI::App &command, FigureOptions &options) {
    command.add_option("DATA", options.data, "File of particles; - is standard input")->required()->type_name("DATA");
    add_output_options(command, options);
    add_data_options(command, options);
    add_particle_options(command, options);
    add_view_options(command, options);
    add_look_options(command, options);
    add_display_options(command, options.display, "");
    command.get_option("--exposure")
        ->description("Brighten the balls by EV stops; auto: as pt render does (default: 0)");
    const std::string samples = "Samples";
    add_whole_number<std::uint32_t>(command, "--spp", options.sample_count, 1, "Samples per pixel (default: 128)")
        ->group(samples);
    add_seed(command, options.seed)->group(samples)->description("Seed (default: 0)");
    add_device(command, options.device);
    add_reporting(command, options.progress, options.quiet);
}

} // namespace cli
