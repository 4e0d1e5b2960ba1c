#include "cli/figure/figure_options.h"

#include "cli/base/common_options.h"
#include "cli/data/number_colours.h"
#include "cli/data/particle_condition.h"
#include "cli/data/particle_types.h"
#include "cli/scene/camera_section.h"

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

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
    const auto read_where = [&options](const std::string &text) {
        try {
            options.where.push_back(parse_condition(text).text);
        } catch (const std::invalid_argument &error) {
            throw CLI::ValidationError("--where", error.what());
        }
    };
    command
        .add_option_function<std::string>(
            "--where", read_where, "Show particles for which this holds, like \"z < 5\"; may be given again for more")
        ->trigger_on_parse()
        ->type_name("CONDITION")
        ->group(group);
    command.add_flag("--wrap", options.wraps, "Bring particles that have left a periodic box back into it")
        ->group(group);
}

constexpr double least_radius = 1e-18;
constexpr double largest_radius = 1e18;

[[noreturn]] void refuse_radius(const std::string &text) {
    refuse_option("--radius",
                  "must be a number from 1e-18 to 1e18, a column, covalent, van-der-waals or radii of types like "
                  "O=0.7,H=0.3",
                  text);
}

bool is_radius(const std::optional<double> &number) {
    return number && *number >= least_radius && *number <= largest_radius;
}

// "O=0.7,H=0.3".
std::map<std::string, double> parse_type_radii(const std::string &text) {
    std::map<std::string, double> radii;
    for (std::string_view rest = text; !rest.empty();) {
        const std::string_view each = rest.substr(0, rest.find(','));
        const std::size_t sign = each.find('=');
        const auto number = sign == std::string_view::npos ? std::nullopt : parse_number<double>(each.substr(sign + 1));
        if (!is_radius(number) || sign == 0 || !radii.emplace(each.substr(0, sign), *number).second) {
            refuse_radius(text);
        }
        rest.remove_prefix(std::min(each.size() + 1, rest.size()));
    }
    return radii;
}

ParticleRadius parse_radius(const std::string &text) {
    ParticleRadius radius;
    if (const auto number = parse_number<double>(text)) {
        if (!is_radius(number)) {
            refuse_radius(text);
        }
        radius.source = RadiusSource::constant;
        radius.scale = *number;
    } else if (text == "covalent" || text == "van-der-waals") {
        radius.source = text == "covalent" ? RadiusSource::covalent : RadiusSource::van_der_waals;
    } else if (text.find('=') != std::string::npos) {
        radius.source = RadiusSource::types;
        radius.types = parse_type_radii(text);
    } else {
        radius.source = RadiusSource::column;
        radius.column = text;
    }
    return radius;
}

// A column, or three with commas between them.
ParticleColour parse_colour(const std::string &text) {
    ParticleColour colour;
    std::istringstream names(text);
    for (std::string name; std::getline(names, name, ',');) {
        colour.columns.push_back(name);
    }
    if (colour.columns.size() != 3) {
        colour.columns = {text};
    }
    colour.source = colour.columns.size() == 3 ? ColourSource::components
                    : text == type_column      ? ColourSource::type
                                               : ColourSource::map;
    return colour;
}

std::array<double, 2> parse_range(const std::string &text) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const auto least = parse_number<double>(std::string_view(text).substr(0, comma));
    const auto largest = parse_number<double>(std::string_view(text).substr(std::min(comma + 1, text.size())));
    if (!least || !largest || !(*least < *largest)) {
        refuse_option("--color-range", "must be two numbers like -1,2.5, and the second must be larger", text);
    }
    return {*least, *largest};
}

void add_colour_options(CLI::App &command, FigureOptions &options, const std::string &group) {
    const auto read_colour = [&options](const std::string &text) {
        options.color = parse_colour(text);
        options.color_text = text;
    };
    command
        .add_option_function<std::string>(
            "--color", read_colour,
            "Column whose numbers or types the colours say, or three of red, green and blue (default: types, or the "
            "columns red, green and blue, where the file has them)")
        ->type_name("COLUMN|R,G,B")
        ->group(group);
    const auto find_map = [](std::string_view name) {
        const auto found = std::find(colour_map_names.begin(), colour_map_names.end(), name);
        return found == colour_map_names.end() ? std::nullopt : std::optional(std::string(*found));
    };
    add_name(command, "--colormap", options.colormap, find_map, "colour map", colour_map_names,
             "Colours of numbers, from the least to the largest (default: viridis)")
        ->group(group);
    const auto read_range = [&options](const std::string &text) { options.color_range = parse_range(text); };
    command
        .add_option_function<std::string>(
            "--color-range", read_range,
            "Numbers that the first and the last colour stand for, and all beyond (default: the least and the largest "
            "there are)")
        ->type_name("LO,HI")
        ->group(group);
}

void add_particle_options(CLI::App &command, FigureOptions &options) {
    const std::string group = "Particles";
    add_colour_options(command, options, group);
    const auto read_radius = [&options](const std::string &text) {
        options.radius = parse_radius(text);
        options.radius_text = text;
    };
    command
        .add_option_function<std::string>(
            "--radius", read_radius,
            "Radius of all, a column of radii, radii of elements in angstroms, or of each type (default: the column "
            "radius, else covalent for elements, else half of what most nearest neighbours are apart)")
        ->type_name("R|COLUMN|covalent|van-der-waals|TYPE=R,...")
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
        options.look.view = *view;
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
        options.look.up = *up;
    };
    command.add_option_function<std::string>("--up", read_up, "What is up in the data (default: z)")
        ->type_name("x|y|z|-x|-y|-z|X,Y,Z")
        ->group(group);
    add_name(command, "--projection", options.look.projection, &find_projection, "projection", projection_names,
             "Far balls look smaller, or as large as near ones (default: perspective)")
        ->group(group);
}

void add_look_options(CLI::App &command, FigureOptions &options) {
    const std::string group = "Look";
    add_name(command, "--style", options.look.style, &find_figure_style, "style", figure_style_names,
             "Surfaces and light; ambient-occlusion has light from all sides alone (default: matte)")
        ->group(group);
    command.add_flag("--outlines", options.has_outlines, "Draw dark lines round the balls")->group(group);
    command.add_flag("--floor", options.look.has_floor, "Put the data on a floor, on which their shadows fall")
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
