#include "cli/render/parts_command.h"

#include "cli/base/exit_code.h"
#include "cli/base/vector_width.h"
#include "cli/film/context_film.h"
#include "cli/scene/scene_setup.h"

#include <pt/devices.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {
namespace {

constexpr std::uint32_t tile_side = 8; // pixels

using Json = nlohmann::ordered_json;

Json facts_of(const RenderSettings &settings) {
    const pt_render &render = settings.render;
    const std::optional<double> &stops = settings.exposure.stops;
    return {{"width", render.width},
            {"height", render.height},
            {"first_sample", render.first_sample},
            {"samples", settings.sample_count},
            {"target_error", settings.target_error},
            {"sampling", settings.sampling},
            {"exposure", stops ? Json(*stops) : Json("auto")},
            {"tonemap", tone_curve_names.at(static_cast<std::size_t>(settings.tone_curve))},
            {"gamma", settings.gamma ? Json(*settings.gamma) : Json(nullptr)}};
}

bool read_words(std::span<std::uint32_t> words) {
    return static_cast<bool>(
        std::cin.read(reinterpret_cast<char *>(words.data()), static_cast<std::streamsize>(words.size_bytes())));
}

struct Part {
    std::uint32_t first_sample;
    std::vector<std::uint32_t> tile_samples; // as in pt_accumulate_info
};

// Nothing at the end of standard input.
std::optional<Part> read_part(std::size_t all_tiles) {
    std::array<std::uint32_t, 3> header{};
    if (!read_words(header))
        return std::nullopt;
    const auto [first, end, count] = header;
    std::vector<std::uint32_t> tiles(std::min<std::size_t>(count, all_tiles));
    const bool is_whole = read_words(tiles);
    if (end <= first || count == 0 || count > all_tiles || !is_whole ||
        std::any_of(tiles.begin(), tiles.end(), [&](std::uint32_t tile) { return tile >= all_tiles; })) {
        throw Failure(ExitCode::usage, "--parts: a request must be of at least one sample and of 1 to " +
                                           std::to_string(all_tiles) + " tiles with indices below that, is of the " +
                                           "samples from " + std::to_string(first) + " to " + std::to_string(end) +
                                           " of " + std::to_string(count) + " tiles");
    }
    Part part{first, std::vector<std::uint32_t>(all_tiles)};
    for (const std::uint32_t tile : tiles)
        part.tile_samples[tile] = end - first;
    return part;
}

void write_answer(std::uint32_t device_kind, std::span<const std::byte> film) {
    std::cout << device_kind << ' ' << film.size() << '\n';
    std::cout.write(reinterpret_cast<const char *>(film.data()), static_cast<std::streamsize>(film.size()));
    if (!std::cout.flush())
        throw Failure(ExitCode::file, "--parts: the film of a part could not be written to standard output");
}

class PartsRender {
public:
    PartsRender(const RenderOptions &options, const SceneFile &file, const RenderSettings &settings,
                ValidationLog &log) :
        context_(render_create_info(options, log)),
        file_(file),
        settings_(settings) {
        context_.require(pt_get_context_device(context_.get(), &device_));
        describe(context_, file, settings);
        context_.require(pt_prepare(context_.get()));
    }

    void answer(const Part &part) {
        settings_.render.first_sample = part.first_sample;
        require_render(context_, file_, settings_, pt_set_render(context_.get(), &settings_.render));
        pt_accumulate_info info{};
        info.struct_size = sizeof(pt_accumulate_info);
        info.sample_count = *std::max_element(part.tile_samples.begin(), part.tile_samples.end());
        info.tile_samples = part.tile_samples.data();
        info.tile_count = static_cast<std::uint32_t>(part.tile_samples.size());
        require_render(context_, file_, settings_, pt_accumulate(context_.get(), &info));
        save_film(context_, film_);
        write_answer(device_.kind, film_);
    }

private:
    Context context_;
    const SceneFile &file_;
    RenderSettings settings_;
    pt_device_info device_{};
    std::vector<std::byte> film_;
};

} // namespace

int render_parts(const RenderOptions &options, const SceneFile &file, const RenderSettings &settings,
                 ValidationLog &log) {
    std::cout << facts_of(settings).dump() << std::endl;
    const auto tiles = [](std::uint32_t pixels) { return (std::size_t{pixels} + tile_side - 1) / tile_side; };
    const std::size_t all_tiles = tiles(settings.render.width) * tiles(settings.render.height);
    std::optional<PartsRender> renderer;
    while (const std::optional<Part> part = read_part(all_tiles)) {
        if (!renderer) {
            choose_vector_width();
            renderer.emplace(options, file, settings, log);
        }
        renderer->answer(*part);
    }
    return static_cast<int>(ExitCode::done);
}

} // namespace cli
