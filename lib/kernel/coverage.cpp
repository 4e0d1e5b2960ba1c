#include "lib/kernel/coverage.h"

#include "lib/base/error.h"
#include "lib/kernel/device_constants.h"
#include "lib/kernel/point_sequence.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

namespace pt {

namespace {

constexpr std::array coverage_bindings = {vk::DescriptorType::eUniformBuffer,
                                          vk::DescriptorType::eStorageBuffer,
                                          vulkan::no_binding,
                                          vk::DescriptorType::eStorageBuffer,
                                          vk::DescriptorType::eUniformBuffer,
                                          vk::DescriptorType::eUniformTexelBuffer,
                                          vk::DescriptorType::eUniformTexelBuffer,
                                          vk::DescriptorType::eStorageBuffer};
static_assert(gpu::BINDING_COVERED == 3 && gpu::BINDING_POINTS == 4 && gpu::BINDING_TREE_NODES == 5 &&
              gpu::BINDING_TREE_SPHERES == 6 && gpu::BINDING_TILES == 7);

constexpr std::uint64_t most_covered_pixels = 1U << 18; // of a piece
constexpr std::uint64_t count_bytes = sizeof(std::uint32_t);
constexpr glm::uvec2 no_samples(1, 0);

// A camera ray takes only the first blocks of its sample's numbers.
PointLayout camera_layout(const Features &features) {
    const std::vector<std::uint32_t> blocks = camera_blocks(features);
    return {blocks, static_cast<std::uint32_t>(blocks.size()), 1};
}

std::array<std::uint32_t, gpu::CONSTANT_COUNT> coverage_specialization(const vulkan::Device &device,
                                                                       const Features &features) {
    auto constants = specialization_constants(features);
    constants[gpu::ID_TABLE_BLOCKS] =
        features[gpu::ID_SAMPLER] == PT_SAMPLER_RANDOM ? 0 : camera_layout(features).block_count();
    constants[gpu::ID_BRANCH_COUNT] = 1;
    set_device_constants(constants, device.policy());
    constants[gpu::ID_POINT_BLOCKS] = device.limits().max_uniform_range / std::uint32_t{sizeof(PointBlock)};
    return constants;
}

gpu::CoverageConstants coverage_constants(const gpu::FrameConstants &frame) {
    gpu::CoverageConstants constants{};
    constants.camera = frame.camera;
    constants.seed = frame.seed;
    return constants;
}

// The largest number of ranges in the samples of any tile.
std::size_t most_ranges(const TileSamples &samples) {
    std::size_t most = 0;
    for (std::size_t tile = 0, count = samples.even() ? 1 : samples.grid().count(); tile < count; ++tile)
        most = std::max(most, samples.of(tile).ranges().size());
    return most;
}

// For each tile one of its ranges, as the kernel reads it.
std::vector<glm::uvec2> tile_ranges(const TileSamples &samples, std::size_t index) {
    std::vector<glm::uvec2> ranges;
    for (std::size_t tile = 0; tile < samples.grid().count(); ++tile) {
        const std::vector<SampleRange> &of_tile = samples.of(tile).ranges();
        ranges.push_back(index < of_tile.size() ? glm::uvec2(of_tile[index].first, of_tile[index].end - 1)
                                                : no_samples);
    }
    return ranges;
}

// From the first sample of all ranges to the last.
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
    kernel_(device, {code, coverage_bindings, sizeof(gpu::CoverageConstants)}) {}

void Coverage::show(const std::shared_ptr<const GpuScene> &scene, const vulkan::Buffer *tree) {
    if (kernel_.shows(scene))
        return;
    buffers_.reset(); // bound to the scene before
    kernel_.show(scene, tree, coverage_specialization(device_, scene->features));
    constants_ = coverage_constants(scene->frame);
    features_ = scene->features;
}

Coverage::Buffers &Coverage::buffers(std::uint64_t pixels, std::size_t tiles) {
    const std::uint64_t bytes = (1 + pixels) * count_bytes;
    const std::uint64_t tile_bytes = tiles * sizeof(glm::uvec2);
    if (buffers_ && buffers_->covered.size() >= bytes && buffers_->tile_ranges.size() >= tile_bytes)
        return *buffers_;
    using enum vulkan::BufferUse;
    buffers_.reset();
    Buffers made{{device_, Storage, bytes, "coverage"},
                 {device_, HostRead, bytes, "coverage"},
                 {device_, Streamed, device_.limits().max_uniform_range, "points of camera rays"},
                 {device_, Storage, tile_bytes, "samples of tiles"},
                 {}};
    std::array<vulkan::BufferRange, coverage_bindings.size()> ranges;
    kernel_.bind_scene(ranges);
    ranges[gpu::BINDING_COVERED] = vulkan::BufferRange(made.covered);
    ranges[gpu::BINDING_POINTS] = vulkan::BufferRange(made.points);
    ranges[gpu::BINDING_TILES] = vulkan::BufferRange(made.tile_ranges);
    made.set = kernel_.pipeline().bind(ranges);
    return buffers_.emplace(std::move(made));
}

// As many samples as fit the time, the table of points, and the number of loop trips that drivers put up with.
std::uint64_t Coverage::samples_in_dispatch(double affordable) const {
    const std::uint64_t rows =
        device_.limits().max_uniform_range / sizeof(PointBlock) / camera_layout(features_).row_blocks();
    const std::uint64_t loops = device_.limits().loop_trip_budget / (1 + loop_trips_per_walk(features_));
    const auto worth = static_cast<std::uint64_t>(affordable);
    return std::max<std::uint64_t>(std::min({worth, rows, loops}), 1);
}

void Coverage::read(const CoverageQuery &query, double tests_per_submission, const Receive &receive) {
    const std::uint64_t total = query.pixels.pixel_count();
    const std::uint64_t dispatched = std::uint64_t{device_.limits().max_workgroup_count} * gpu::WORKGROUP_SIZE;
    const auto affordable = static_cast<std::uint64_t>(kernel_.rays_for(tests_per_submission));
    const std::uint64_t most =
        std::min({std::max<std::uint64_t>(affordable, gpu::WORKGROUP_SIZE), dispatched, most_covered_pixels, total});
    Buffers &buffers = this->buffers(most, query.samples.grid().count());
    gpu::CoverageConstants constants = constants_;
    constants.first_row = query.settings.first_row;
    constants.first_pixel = (query.settings.first_row + query.pixels.y) * constants.camera.width + query.pixels.x;
    constants.rectangle_width = query.pixels.width;
    std::vector<std::uint32_t> counts;
    for (std::uint64_t done = 0; done < total; done += constants.pixel_count) {
        constants.first_of_rectangle = static_cast<std::uint32_t>(done);
        constants.pixel_count = static_cast<std::uint32_t>(std::min(most, total - done));
        count(query, constants, tests_per_submission, buffers);
        const std::span<const std::byte> found = buffers.host.host_bytes();
        std::uint32_t lost_rays = 0;
        std::memcpy(&lost_rays, found.data(), sizeof lost_rays);
        if (lost_rays > 0)
            throw Error(PT_ERROR_INTERNAL, "the driver stopped camera rays of " + std::to_string(lost_rays) +
                                               " pixels before they had met anything");
        counts.resize(constants.pixel_count);
        std::memcpy(counts.data(), &found[count_bytes], counts.size() * count_bytes);
        receive(counts);
    }
}

// Counts a piece: one range of its tiles after the other, each in as many dispatches as it needs.
void Coverage::count(const CoverageQuery &query, gpu::CoverageConstants constants, double tests_per_submission,
                     Buffers &buffers) {
    const std::uint64_t bytes = (1 + std::uint64_t{constants.pixel_count}) * count_bytes;
    device_.submit([&](const auto &commands) { buffers.covered.clear(commands, 0, bytes); });
    const std::uint64_t most =
        samples_in_dispatch(kernel_.rays_for(tests_per_submission) / static_cast<double>(constants.pixel_count));
    for (std::size_t index = 0, ranges = most_ranges(query.samples); index < ranges; ++index) {
        const std::vector<glm::uvec2> of_tiles = tile_ranges(query.samples, index);
        buffers.tile_ranges.upload(std::as_bytes(std::span(of_tiles)), 0);
        const SampleRange hull = hull_of_ranges(of_tiles);
        for (std::uint64_t first = hull.first; first < hull.end; first += most) {
            constants.first_sample = static_cast<std::uint32_t>(first);
            constants.last_sample = static_cast<std::uint32_t>(std::min(first + most, hull.end) - 1);
            take(query, constants, buffers);
        }
    }
    device_.submit([&](const auto &commands) { buffers.host.copy(commands, buffers.covered, bytes); });
}

void Coverage::take(const CoverageQuery &query, const gpu::CoverageConstants &constants, Buffers &buffers) {
    if (features_[gpu::ID_SAMPLER] != PT_SAMPLER_RANDOM) {
        std::vector<std::uint32_t> indices(constants.last_sample - constants.first_sample + 1);
        std::iota(indices.begin(), indices.end(), constants.first_sample);
        const std::vector<PointBlock> table =
            point_table(query.settings.sampler, query.settings.seed, indices, camera_layout(features_));
        buffers.points.upload(std::as_bytes(std::span(table)), 0);
    }
    device_.submit([&](const auto &commands) {
        kernel_.pipeline().dispatch(commands, buffers.set, std::as_bytes(std::span(&constants, 1)),
                                    (constants.pixel_count + gpu::WORKGROUP_SIZE - 1) / gpu::WORKGROUP_SIZE);
    });
}

} // namespace pt
