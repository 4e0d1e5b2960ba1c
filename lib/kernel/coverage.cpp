#include "lib/kernel/coverage.h"

#include "lib/kernel/point_sequence.h"
#include "lib/kernel/specialised_pipeline.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <vector>

namespace pt {

namespace {

constexpr std::uint64_t count_bytes = sizeof(std::uint32_t);
constexpr glm::uvec2 no_samples(1, 0);

PointLayout camera_layout(const Features &features) {
    const std::vector<std::uint32_t> blocks = camera_blocks(features);
    return {blocks, static_cast<std::uint32_t>(blocks.size()), 1};
}

std::array<std::uint32_t, gpu::CONSTANT_COUNT> coverage_specialization(const vulkan::Device &device,
                                                                       const Features &features) {
    auto constants = specialization_constants(features);
    set_device_constants(constants, device);
    constants[gpu::ID_TABLE_BLOCKS] =
        features[gpu::ID_SAMPLER] == PT_SAMPLER_RANDOM ? 0 : camera_layout(features).block_count();
    constants[gpu::ID_BRANCH_COUNT] = 1;
    return constants;
}

std::size_t most_ranges(const TileSamples &samples) {
    std::size_t most = 0;
    for (std::size_t tile = 0, count = samples.even() ? 1 : samples.grid().count(); tile < count; ++tile)
        most = std::max(most, samples.of(tile).ranges().size());
    return most;
}

std::vector<glm::uvec2> tile_ranges(const TileSamples &samples, std::size_t index) {
    std::vector<glm::uvec2> ranges;
    for (std::size_t tile = 0; tile < samples.grid().count(); ++tile) {
        const std::vector<SampleRange> &of_tile = samples.of(tile).ranges();
        ranges.push_back(index < of_tile.size() ? glm::uvec2(of_tile[index].first, of_tile[index].end - 1)
                                                : no_samples);
    }
    return ranges;
}

SampleRange hull_of_ranges(const std::vector<glm::uvec2> &ranges) {
    SampleRange hull;
    for (const glm::uvec2 &range : ranges)
        if (range.x <= range.y)
            hull = hull_of(hull, {range.x, std::uint64_t{range.y} + 1});
    return hull;
}

} // namespace

Coverage::Coverage(vulkan::Device &device, std::span<const std::uint32_t> code) :
    device_(device),
    kernel_(
        device, code,
        with_scene_bindings(
            {{gpu::BINDING_COVERED}, {gpu::BINDING_POINTS, vk::DescriptorType::eUniformBuffer}, {gpu::BINDING_TILES}}),
        sizeof(gpu::CoverageConstants)) {}

void Coverage::make_room(std::uint64_t pixels, std::size_t tiles) {
    const std::uint64_t bytes = (1 + pixels) * count_bytes;
    const std::uint64_t tile_bytes = tiles * sizeof(glm::uvec2);
    if (buffers_ && buffers_->covered.size() >= bytes && buffers_->tile_ranges.size() >= tile_bytes)
        return;
    using enum vulkan::BufferUse;
    buffers_.reset();
    buffers_.emplace(Buffers{{device_, Storage, bytes, "coverage"},
                             {device_, HostRead, bytes, "coverage"},
                             {device_, Streamed, device_.limits().max_uniform_range, "points of camera rays"},
                             {device_, Storage, tile_bytes, "samples of tiles"}});
}

std::uint64_t Coverage::samples_in_dispatch(const Features &features, double affordable) const {
    const std::uint64_t rows =
        device_.limits().max_uniform_range / sizeof(PointBlock) / camera_layout(features).row_blocks();
    const std::uint64_t loops = device_.limits().loop_trip_budget / (1 + loop_trips_per_walk(features));
    return std::max<std::uint64_t>(std::min({static_cast<std::uint64_t>(affordable), rows, loops}), 1);
}

void Coverage::read(const BoundScene &bound, const CoverageQuery &query, double tests_per_submission,
                    const Receive &receive) {
    const double rays = rays_for(tests_per_submission, bound.scene);
    const std::uint64_t total = query.pixels.pixel_count();
    const std::uint64_t most = kernel_.pixels_at_once(total, 1, rays);
    kernel_.fit(coverage_specialization(device_, bound.scene.features));
    make_room(most, query.samples.grid().count());
    const Look look{bound.scene.features, query, rays,
                    kernel_.bind(bound, {buffers_->covered, buffers_->points, buffers_->tile_ranges})};
    gpu::CoverageConstants constants{};
    constants.camera = bound.scene.frame.camera;
    constants.seed = bound.scene.frame.seed;
    constants.first_row = query.settings.first_row;
    constants.first_pixel = (query.settings.first_row + query.pixels.y) * constants.camera.width + query.pixels.x;
    constants.rectangle_width = query.pixels.width;
    std::vector<std::uint32_t> counts;
    for (std::uint64_t done = 0; done < total; done += constants.pixel_count) {
        constants.first_of_rectangle = static_cast<std::uint32_t>(done);
        constants.pixel_count = static_cast<std::uint32_t>(std::min(most, total - done));
        count(look, constants);
        counts.resize(1 + constants.pixel_count);
        std::memcpy(counts.data(), buffers_->host.host_memory().data(), counts.size() * count_bytes);
        require_all_met(counts.front());
        receive(std::span(counts).subspan(1));
    }
}

void Coverage::count(const Look &look, gpu::CoverageConstants constants) {
    const std::uint64_t bytes = (1 + std::uint64_t{constants.pixel_count}) * count_bytes;
    device_.submit([&](const auto &commands) { buffers_->covered.clear(commands, 0, bytes); });
    const TileSamples &samples = look.query.samples;
    const std::uint64_t most = samples_in_dispatch(look.features, look.rays / constants.pixel_count);
    for (std::size_t index = 0, ranges = most_ranges(samples); index < ranges; ++index) {
        const std::vector<glm::uvec2> of_tiles = tile_ranges(samples, index);
        buffers_->tile_ranges.upload(std::as_bytes(std::span(of_tiles)), 0);
        const SampleRange hull = hull_of_ranges(of_tiles);
        for (std::uint64_t first = hull.first; first < hull.end; first += most) {
            constants.first_sample = static_cast<std::uint32_t>(first);
            constants.last_sample = static_cast<std::uint32_t>(std::min(first + most, hull.end) - 1);
            take(look, constants);
        }
    }
    device_.submit(
        [&](const auto &commands) { buffers_->host.copy(commands, buffers_->covered, vk::BufferCopy{.size = bytes}); });
}

void Coverage::take(const Look &look, const gpu::CoverageConstants &constants) {
    if (look.features[gpu::ID_SAMPLER] != PT_SAMPLER_RANDOM) {
        std::vector<std::uint32_t> indices(constants.last_sample - constants.first_sample + 1);
        std::iota(indices.begin(), indices.end(), constants.first_sample);
        const std::vector<PointBlock> table =
            point_table(look.query.settings.sampler, look.query.settings.seed, indices, camera_layout(look.features));
        buffers_->points.upload(std::as_bytes(std::span(table)), 0);
    }
    device_.submit([&](const auto &commands) {
        kernel_.dispatch(commands, look.set, std::as_bytes(std::span(&constants, 1)), constants.pixel_count);
    });
}

} // namespace pt
