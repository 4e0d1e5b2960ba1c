#include "lib/kernel/error_reader.h"

#include "lib/kernel/resolve.h"
#include "shaders/gpu_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pt {

namespace {

std::uint32_t groups_in_row(const TileGrid &grid) {
    return (grid.width + gpu::ESTIMATE_WORKGROUP_SIZE - 1) / gpu::ESTIMATE_WORKGROUP_SIZE;
}

// Units in which all squared relative errors are normal float32 numbers.
struct RelativeUnits {
    float offset;
    float scale; // errors are below 2^FILM_MAX_EXPONENT, so error * scale / offset < 2^60
    double factor;

    double undone() const { return 1.0 / (static_cast<double>(scale) * static_cast<double>(scale) * factor); }

    // An offset far above the film's values dominates the denominator, so limiting the offset scales all squares by the
    // same factor.
    explicit RelativeUnits(double unit) {
        constexpr double far_above = 1e13;
        const double exact = std::sqrt(relative_offset) / unit;
        offset = static_cast<float>(std::min(exact, far_above));
        scale = 0x1p32F * offset;
        factor = std::pow(std::max(exact / far_above, 1.0), 2.0);
    }
};

ErrorSquares squares_of(const gpu::ErrorSquares &found, double factor) {
    constexpr double values_of_tile = 3.0 * gpu::TILE_SIZE * gpu::TILE_SIZE;
    const double sum = static_cast<double>(found.sum) * factor;
    return {sum, sum * sum * static_cast<double>(found.pixel_shares),
            sum * sum * static_cast<double>(found.tile_shares),
            sum * static_cast<double>(found.part_share) * values_of_tile};
}

double squares_of_pieces(std::uint32_t pixels, std::uint32_t piece) {
    const double rest = pixels % piece;
    const std::uint32_t whole = pixels / piece;
    return static_cast<double>(whole) * piece * piece + rest * rest;
}

gpu::uvec2 counts_of(const SampleSet &set) {
    const auto [older, newer] = part_counts(set);
    return {static_cast<std::uint32_t>(older), static_cast<std::uint32_t>(newer)};
}

TileErrors errors_of(const gpu::TileErrors &found, std::uint32_t width, std::uint32_t height, double unit,
                     const RelativeUnits &units) {
    require_no_loss(found.lost_pixels);
    TileErrors errors;
    errors.value_count = 3.0 * width * height;
    errors.squares_of_tile_sizes =
        9.0 * squares_of_pieces(width, gpu::TILE_SIZE) * squares_of_pieces(height, gpu::TILE_SIZE);
    errors.square = squares_of(found.square, unit * unit);
    errors.relative_square = squares_of(found.relative_square, units.undone());
    errors.met_once = squares_of(found.met_once, units.undone());
    errors.as_lamps = squares_of(found.as_lamps, units.undone());
    errors.met_again = found.met_again;
    errors.unseen = static_cast<double>(found.unseen) / units.factor;
    errors.rejected = std::uint64_t{found.rejected.y} << 32 | found.rejected.x;
    if (found.unknown_pixels > 0)
        errors.square.sum = errors.relative_square.sum = std::numeric_limits<double>::infinity();
    return errors;
}

} // namespace

vulkan::ComputePipeline estimate_pipeline(vulkan::Device &device, std::span<const std::uint32_t> code) {
    constexpr vulkan::Binding bindings[] = {
        {gpu::BINDING_FILM}, {gpu::BINDING_RESOLVED}, {gpu::BINDING_TILE_COUNTS}, {gpu::BINDING_TILE_SQUARES}};
    return {device, code, bindings, sizeof(gpu::EstimateConstants), {}};
}

ErrorReader::ErrorReader(vulkan::Device &device, const vulkan::ComputePipeline &estimate, DeviceFilm &film) :
    device_(device),
    estimate_(estimate),
    film_(film),
    errors_(device, vulkan::BufferUse::HostRead,
            std::size_t{groups_in_row(grid_of(0))} * grid_of(0).rows() * sizeof(gpu::TileErrors), "error of an image"),
    tile_counts_(device, vulkan::BufferUse::HostWritten, film.grid().count() * sizeof(gpu::uvec2), "samples of tiles"),
    tile_squares_(device, vulkan::BufferUse::HostRead, film.grid().count() * sizeof(glm::vec2), "errors of tiles") {
    for (const DeviceFilm::Strip &strip : film.strips())
        sets_.push_back(
            estimate.bind(std::array<vulkan::BufferRange, 4>{strip.words, errors_, tile_counts_, tile_squares_}));
}

TileGrid ErrorReader::grid_of(std::size_t strip) const {
    return {film_.width(), film_.strips()[strip].pixel_count / film_.width()};
}

// No kernel may be using this memory.
void ErrorReader::list_counts(const TileSamples &samples) {
    if (samples.even())
        return;
    std::vector<gpu::uvec2> of_sets;
    for (const SampleSet &set : samples.sets())
        of_sets.push_back(counts_of(set));
    auto *const counts = reinterpret_cast<gpu::uvec2 *>(tile_counts_.host_memory().data());
    for (std::size_t tile = 0; tile < samples.grid().count(); ++tile)
        counts[tile] = of_sets[samples.set_of(tile)];
}

void ErrorReader::collect_tiles(const ErrorQuery &query) const {
    const RelativeUnits units(query.unit);
    const auto *const of_tiles = reinterpret_cast<const glm::vec2 *>(tile_squares_.host_memory().data());
    for (std::size_t tile = 0; tile < query.by_tile.size(); ++tile)
        query.by_tile[tile] = static_cast<double>(of_tiles[tile].x) * units.undone() +
                              static_cast<double>(of_tiles[tile].y) / units.factor;
}

void ErrorReader::read(const ErrorQuery &query, const Receive &receive) {
    list_counts(query.samples);
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        device_.submit([&](const vk::raii::CommandBuffer &commands) { record_strip(commands, i, query); });
        collect_strip(i, query, receive);
    }
    collect_tiles(query);
}

void ErrorReader::record(const vk::raii::CommandBuffer &commands, const ErrorQuery &query) {
    list_counts(query.samples);
    record_strip(commands, 0, query);
}

void ErrorReader::collect(const ErrorQuery &query, const Receive &receive) const {
    collect_strip(0, query, receive);
    collect_tiles(query);
}

void ErrorReader::record_strip(const vk::raii::CommandBuffer &commands, std::size_t strip,
                               const ErrorQuery &query) const {
    const RelativeUnits units(query.unit);
    const TileGrid grid = grid_of(strip);
    gpu::EstimateConstants constants{};
    constants.film_width = grid.width;
    constants.strip_pixel_count = film_.strips()[strip].pixel_count;
    constants.row_count = grid.height;
    constants.first_tile =
        static_cast<std::uint32_t>(film_.grid().tile_at(0, film_.strips()[strip].first_pixel / grid.width));
    constants.sample_counts =
        query.samples.even() ? counts_of(query.samples.sets().front()) : gpu::uvec2(gpu::ANY_COUNT);
    constants.by_tile = query.by_tile.empty() ? 0 : 1;
    constants.relative_offset = units.offset;
    constants.relative_scale = units.scale;
    estimate_.dispatch(commands, sets_[strip], std::as_bytes(std::span(&constants, 1)), groups_in_row(grid), {},
                       grid.rows());
}

void ErrorReader::collect_strip(std::size_t strip, const ErrorQuery &query, const Receive &receive) const {
    const RelativeUnits units(query.unit);
    const TileGrid grid = grid_of(strip);
    const auto *found = reinterpret_cast<const gpu::TileErrors *>(errors_.host_memory().data());
    for (std::uint32_t y = 0; y < grid.height; y += gpu::TILE_SIZE)
        for (std::uint32_t x = 0; x < grid.width; x += gpu::ESTIMATE_WORKGROUP_SIZE)
            receive(errors_of(*found++, std::min(gpu::ESTIMATE_WORKGROUP_SIZE, grid.width - x),
                              std::min(gpu::TILE_SIZE, grid.height - y), query.unit, units));
}

} // namespace pt
