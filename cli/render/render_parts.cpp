#include "cli/base/text.h"
#include "cli/film/film.h"
#include "cli/render/render_command.h"
#include "cli/scene/scene_writer.h"

#include <pt/devices.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

namespace cli {
namespace {

constexpr std::uint32_t tile_side = 8; // pixels

using Json = nlohmann::ordered_json;

Json facts_of(const RenderTask &task) {
    const Display &display = task.scene.display;
    return {{"width", task.render.width},
            {"height", task.render.height},
            {"first_sample", task.render.first_sample},
            {"samples", task.sample_count},
            {"target_error", task.options.stopping.target_error},
            {"sampling", task.options.sampling},
            {"exposure", display.exposure ? Json(*display.exposure) : Json("auto")},
            {"tonemap", tone_curves.name(display.curve)},
            {"gamma", display.gamma ? Json(*display.gamma) : Json(nullptr)}};
}

bool read_words(std::span<std::uint32_t> words) {
    return static_cast<bool>(
        std::cin.read(reinterpret_cast<char *>(words.data()), static_cast<std::streamsize>(words.size_bytes())));
}

struct Part {
    std::uint32_t first_sample;
    std::vector<std::uint32_t> tile_samples; // as in pt_accumulate_info; empty for a request of the scene
};

std::optional<Part> read_part(std::size_t all_tiles) {
    std::array<std::uint32_t, 3> header{};
    if (!read_words(header))
        return std::nullopt;
    const auto [first, end, count] = header;
    if (end == 0 && count == 0)
        return Part{};
    std::vector<std::uint32_t> tiles(std::min<std::size_t>(count, all_tiles));
    const bool is_whole = read_words(tiles);
    const bool has_tile = !tiles.empty() && *std::ranges::max_element(tiles) < all_tiles;
    refuse_if(end <= first || !has_tile || count > all_tiles || !is_whole,
              concat("--parts: a request must be of at least one sample and of 1 to ", all_tiles,
                     " tiles with indices below that, is of the samples from ", first, " to ", end, " of ", count,
                     " tiles"));
    Part part{first, std::vector<std::uint32_t>(all_tiles)};
    for (const std::uint32_t tile : tiles)
        part.tile_samples[tile] = end - first;
    return part;
}

void write_answer(std::uint32_t device_kind, std::span<const std::byte> film) {
    std::cout << device_kind << ' ' << film.size() << '\n';
    std::cout.write(reinterpret_cast<const char *>(film.data()), static_cast<std::streamsize>(film.size()));
    refuse_if(!std::cout.flush(), "--parts: the film of a part could not be written to standard output",
              ExitCode::file);
}

class PartsRender {
public:
    PartsRender(const RenderTask &task, ValidationLog &log) :
        context_(render_create_info(task.options, log)),
        task_(task) {
        context_.require(pt_get_context_device(context_.get(), &device_));
        describe_scene(context_, task.scene, [](double) { return true; });
        require(context_, task, pt_set_render(context_.get(), &task.render));
        context_.require(pt_prepare(context_.get()));
    }

    void answer(const Part &part) {
        pt_render render = task_.render;
        render.first_sample = part.first_sample;
        require(context_, task_, pt_set_render(context_.get(), &render));
        auto info = sized<pt_accumulate_info>();
        info.sample_count = *std::max_element(part.tile_samples.begin(), part.tile_samples.end());
        info.tile_samples = part.tile_samples.data();
        info.tile_count = static_cast<std::uint32_t>(part.tile_samples.size());
        require(context_, task_, pt_accumulate(context_.get(), &info));
        save_film(context_, film_);
        write_answer(device_.kind, film_);
    }

private:
    Context context_;
    const RenderTask &task_;
    pt_device_info device_{};
    std::vector<std::byte> film_;
};

} // namespace

int render_parts(const RenderTask &task, ValidationLog &log) {
    std::cout << facts_of(task).dump() << std::endl;
    const auto tiles = [](std::uint32_t pixels) { return (std::size_t{pixels} + tile_side - 1) / tile_side; };
    const std::size_t all_tiles = tiles(task.render.width) * tiles(task.render.height);
    std::optional<PartsRender> renderer;
    while (const std::optional<Part> part = read_part(all_tiles)) {
        if (part->tile_samples.empty()) {
            write_scene(std::cout, task.scene, task.render);
            continue;
        }
        if (!renderer)
            renderer.emplace(task, log);
        renderer->answer(*part);
    }
    return static_cast<int>(ExitCode::done);
}

} // namespace cli
