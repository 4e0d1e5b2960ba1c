#include "lib/film/film.h"

#include "lib/api/context.h"
#include "lib/api/guard.h"
#include "lib/base/rules.h"
#include "lib/base/struct_size.h"
#include "lib/base/work_progress.h"
#include "lib/film/pixel_format.h"
#include "lib/render/image.h"

#include <pt/film.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

struct pt_film {
    explicit pt_film(pt::Film source) : film(std::move(source)) {}

    pt::Film film;
};

namespace pt {

namespace {

std::span<const std::byte> film_bytes(const void *data, std::uint64_t size_bytes) {
    require_not_null(data, "data");
    return {static_cast<const std::byte *>(data), size_bytes};
}

const FilmTile &tile_of(const Film &film, std::uint32_t index) {
    const std::vector<FilmTile> &tiles = film.header().tiles;
    if (index >= tiles.size())
        refuse_argument("tile", "", std::to_string(index), "must be below " + std::to_string(tiles.size()));
    return tiles[index];
}

void write_nothing(const Image &image) {
    const auto &[pixels, quantity, format, row_bytes] = image.layout;
    const float value = quantity == PT_QUANTITY_STANDARD_ERROR ? std::numeric_limits<float>::infinity() : 0.0F;
    const std::vector<float> row(std::size_t{3} * pixels.width, value);
    for (std::uint32_t y = 0; y < pixels.height; ++y)
        write_pixels(row, format, image.data + y * row_bytes);
}

void write_image(const Film &film, const Image &image) {
    const ImageLayout &layout = image.layout;
    Rectangle pixels = layout.pixels;
    pixels.x += film.bounds().x;
    pixels.y += film.bounds().y;
    write_nothing(image);
    const auto write_row = [&](std::uint32_t x, std::uint32_t y, const std::vector<float> &values) {
        std::byte *const row = image.data + (y - pixels.y) * layout.row_bytes;
        write_pixels(values, layout.format, row + std::size_t{x - pixels.x} * pixel_bytes(layout.format));
    };
    film.read(pixels, layout.quantity, write_row);
}

pt_stats stats_of(const Film &film) {
    pt_stats stats{};
    stats.sample_count = static_cast<std::uint32_t>(film.sample_count());
    stats.max_sample_count = static_cast<std::uint32_t>(film.max_sample_count());
    stats.mean_sample_count =
        static_cast<double>(film.total_samples()) / static_cast<double>(film.bounds().pixel_count());
    stats.rejected_samples = film.rejected_samples();
    return stats;
}

// Writes the goals of all tiles. A tile outside the next step has its present number of samples as goal.
pt_result write_plan(Film &film, double target_error, std::uint32_t most, std::uint32_t *goals, std::uint32_t &count) {
    const std::size_t tile_count = film.tile_count();
    if (!goals) {
        count = static_cast<std::uint32_t>(tile_count);
        return PT_OK;
    }
    if (count != tile_count)
        refuse_argument("count", "", std::to_string(count),
                        "must be the number of tiles, " + std::to_string(tile_count));
    const TileSamples samples = film.samples_by_tile();
    const std::optional<TileStep> step = film.plan(samples, target_error, most);
    for (std::size_t tile = 0; tile < tile_count; ++tile)
        goals[tile] = static_cast<std::uint32_t>(samples.of(tile).count());
    if (!step)
        return PT_TARGET_REACHED;
    for (const std::uint32_t tile : step->tiles)
        goals[tile] = static_cast<std::uint32_t>(step->goal(tile));
    return step->tiles.empty() ? PT_OK : PT_PENDING;
}

void check_target_error(double target_error) {
    if (!(std::isfinite(target_error) && target_error > 0.0))
        refuse_argument("target_error", "", number_text(target_error), "must be finite and > 0");
}

pt_film_info info_of(const Film &film) {
    const FilmFacts &facts = film.facts();
    const Rectangle &bounds = film.bounds();
    return {.struct_size = sizeof(pt_film_info),
            .width = facts.width,
            .height = facts.height,
            .x = bounds.x,
            .y = bounds.y,
            .columns = bounds.width,
            .rows = bounds.height,
            .max_path_length = facts.max_path_length,
            .seed = facts.seed,
            .estimator = facts.estimator,
            .sampler = facts.sampler,
            .tile_count = static_cast<std::uint32_t>(film.header().tiles.size()),
            .lamp_sample_count = film.samples_for_lamps(),
            .device = facts.device.c_str(),
            .flags = facts.has_coverage ? std::uint32_t{PT_RENDER_COVERAGE} : 0,
            .reserved = 0};
}

template <typename Handle, typename Call>
pt_result guard_film(Handle *film, Call &&call) noexcept {
    return guard(thread_last_error, [&] {
        require_not_null(film, "film");
        return call(film->film);
    });
}

} // namespace

} // namespace pt

pt_result pt_open_film(const void *data, uint64_t size_bytes, pt_film **film) {
    return pt::guard(pt::thread_last_error, [&] {
        pt::require_not_null(film, "film");
        *film = nullptr;
        *film = std::make_unique<pt_film>(pt::Film(pt::film_bytes(data, size_bytes))).release();
    });
}

void pt_close_film(pt_film *film) {
    delete film;
}

pt_result pt_merge_film(pt_film *film, const void *data, uint64_t size_bytes) {
    return pt::guard_film(film, [&](pt::Film &opened) { opened.add(pt::Film(pt::film_bytes(data, size_bytes))); });
}

pt_result pt_write_film(const pt_film *film, void *data, uint64_t *size_bytes) {
    return pt::guard_film(film, [&](const pt::Film &opened) {
        pt::require_not_null(size_bytes, "size_bytes");
        const std::uint64_t needed = pt::FilmLayout(opened.header()).size_bytes();
        if (data) {
            pt::require_room(*size_bytes, needed);
            opened.write({static_cast<std::byte *>(data), needed});
        }
        *size_bytes = needed;
    });
}

pt_result pt_stream_film(const pt_film *film, pt_take_bytes_fn take, void *user) {
    return pt::guard_film(film, [&](const pt::Film &opened) {
        pt::require_not_null(reinterpret_cast<const void *>(take), "take");
        try {
            opened.stream([&](std::span<const std::byte> piece) {
                if (take(user, piece.data(), piece.size()) != 0)
                    throw pt::Cancelled();
            });
            return PT_OK;
        } catch (const pt::Cancelled &) {
            return PT_CANCELLED;
        }
    });
}

pt_result pt_read_film(const pt_film *film, const pt_image *image) {
    return pt::guard_film(film, [&](const pt::Film &opened) {
        const pt_image target = pt::copy_in(image, "image");
        const pt::Rectangle &bounds = opened.bounds();
        const pt::Image valid = pt::validated_image(target, bounds.width, bounds.height, pt::ImageSource::Samples);
        pt::require_coverage(valid.layout.quantity, opened.facts().has_coverage);
        pt::write_image(opened, valid);
    });
}

pt_result pt_get_film_info(const pt_film *film, pt_film_info *info) {
    return pt::guard_film(film, [&](const pt::Film &opened) { pt::copy_out(pt::info_of(opened), info, "info"); });
}

pt_result pt_get_film_tile(const pt_film *film, uint32_t index, pt_film_tile *tile) {
    return pt::guard_film(film, [&](const pt::Film &opened) {
        const auto &[pixels, samples] = pt::tile_of(opened, index);
        pt::copy_out(pt_film_tile{.struct_size = sizeof(pt_film_tile),
                                  .x = pixels.x,
                                  .y = pixels.y,
                                  .width = pixels.width,
                                  .height = pixels.height,
                                  .range_count = static_cast<std::uint32_t>(samples.ranges().size())},
                     tile, "tile");
    });
}

pt_result pt_get_film_ranges(const pt_film *film, uint32_t tile, pt_sample_range *ranges, uint32_t *count) {
    return pt::guard_film(film, [&](const pt::Film &opened) {
        pt::require_not_null(count, "count");
        const std::vector<pt::SampleRange> &all = pt::tile_of(opened, tile).samples.ranges();
        const auto available = static_cast<std::uint32_t>(all.size());
        *count = ranges ? std::min(*count, available) : available;
        for (std::uint32_t i = 0; ranges && i < *count; ++i)
            ranges[i] = {all[i].first, all[i].end};
    });
}

pt_result pt_get_film_stats(const pt_film *film, pt_stats *stats) {
    return pt::guard_film(film, [&](const pt::Film &opened) { pt::copy_out(pt::stats_of(opened), stats, "stats"); });
}

pt_result pt_get_film_error_estimate(const pt_film *film, pt_error_estimate *error) {
    return pt::guard_film(film, [&](const pt::Film &opened) {
        pt::struct_size_of(error, "error");
        pt::copy_out(pt::stated(opened.error()), error, "error");
    });
}

pt_result pt_plan_film(pt_film *film, double target_error, uint32_t most, uint32_t *goals, uint32_t *count) {
    return pt::guard_film(film, [&](pt::Film &opened) {
        pt::require_not_null(count, "count");
        pt::check_target_error(target_error);
        return pt::write_plan(opened, target_error, most, goals, *count);
    });
}
