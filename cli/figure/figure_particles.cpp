#include "cli/figure/figure_particles.h"

#include "cli/base/exit_code.h"
#include "cli/base/report_file.h"
#include "cli/data/number_colours.h"
#include "cli/data/particle_condition.h"

#include <algorithm>
#include <filesystem>

namespace cli {
namespace {

// As the scene that is written names it: by a path from its folder.
std::string path_from(const std::string &scene, const std::string &data) {
    const std::filesystem::path path(data);
    if (path.is_absolute() || scene.empty() || scene == standard_stream) {
        return data;
    }
    const std::filesystem::path folder = std::filesystem::absolute(scene).parent_path();
    return std::filesystem::absolute(path).lexically_normal().lexically_proximate(folder.lexically_normal()).string();
}

ParticleEntry entry_of(const FigureOptions &options) {
    ParticleEntry entry;
    entry.file = path_from(options.scene, options.data);
    entry.query.frame = options.frame;
    entry.query.where = options.where;
    entry.wraps = options.wraps;
    entry.radius = options.radius;
    entry.colour = options.color;
    if (entry.colour.source == ColourSource::map || entry.colour.source == ColourSource::components) {
        entry.colour.map = options.colormap.value_or(entry.colour.map);
        entry.colour.range = options.color_range;
    }
    return entry;
}

// That asks for a column.
std::string option_of(const FigureOptions &options, const std::string &column) {
    const auto has = [&column](const std::vector<std::string> &names) {
        return std::find(names.begin(), names.end(), column) != names.end();
    };
    for (const std::string &condition : options.where) {
        if (parse_condition(condition).column == column) {
            return "--where " + condition;
        }
    }
    return has(options.color.columns) ? "--color " + options.color_text : "--radius " + options.radius_text;
}

// Of a scale that other colours than those of numbers would leave out.
void require_numbers(const FigureOptions &options, const ParticleEntry &entry) {
    const ColourSource source = entry.shown_colour.source;
    const std::string column = options.color.columns.empty() ? "" : ", which " + options.color_text + " is not";
    if (options.colormap && source != ColourSource::map) {
        throw Failure(ExitCode::usage, "--colormap: needs --color and a column of numbers" + column);
    }
    if (options.color_range && source != ColourSource::map && source != ColourSource::components) {
        throw Failure(ExitCode::usage, "--color-range: needs --color and columns of numbers" + column);
    }
}

} // namespace

ParticleEntry read_figure_particles(const FigureOptions &options) {
    ParticleEntry entry = entry_of(options);
    try {
        load(entry, options.data);
    } catch (const UnknownColumn &unknown) {
        throw Failure(unknown.code(), option_of(options, unknown.name) + ": " + unknown.what());
    } catch (const RefusedLook &refused) {
        throw Failure(refused.code(),
                      (refused.of_radius ? "--radius " + options.radius_text : "--color") + ": " + refused.what());
    }
    if (entry.count() == 0) {
        throw Failure(ExitCode::file,
                      options.data + ": has no particles" + (options.where.empty() ? "" : " for which --where holds"));
    }
    require_numbers(options, entry);
    return entry;
}

Legend legend_of(const ParticleEntry &particles) {
    const ParticleColour &colour = particles.shown_colour;
    Legend legend;
    if (colour.source == ColourSource::map) {
        constexpr std::size_t colour_count = 256;
        ColourBar bar{(*colour.range)[0], (*colour.range)[1], {}};
        for (std::size_t i = 0; i < colour_count; ++i) {
            bar.colours.push_back(map_colour(colour.map, static_cast<double>(i) / (colour_count - 1)));
        }
        legend.bar = bar;
    }
    if (colour.source == ColourSource::map || colour.source == ColourSource::type) {
        legend.title = colour.columns[0];
    }
    std::transform(particles.types.begin(), particles.types.end(), std::back_inserter(legend.swatches),
                   [](const TypeColour &type) {
                       return Swatch{type.name, type.colour};
                   });
    return legend;
}

} // namespace cli
