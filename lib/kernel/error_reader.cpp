#include "lib/kernel/error_reader.h"

#include "lib/base/error.h"
#include "shaders/gpu_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace pt {

namespace {

constexpr std::uint32_t tiles_in_row = gpu::REGION_SIZE / gpu::TILE_SIZE;
constexpr std::uint32_t tiles_in_region = tiles_in_row * tiles_in_row;

std::uint32_t regions_of(std::uint32_t pixels) {
    return (pixels + gpu::REGION_SIZE - 1) / gpu::REGION_SIZE;
}

std::uint64_t tile_bytes(const DeviceFilm &film, const DeviceFilm::Strip &strip) {
    const std::uint64_t regions =
        std::uint64_t{regions_of(film.width())} * regions_of(strip.pixel_count / film.width());
    return regions * tiles_in_region * sizeof(gpu::TileError);
}

// The strips are of one size, but for the last, which is no larger.
std::uint64_t most_tile_bytes(DeviceFilm &film) {
    return tile_bytes(film, film.strips().front());
}

// How the kernel measures relative errors, so that all squares are normal floats.
struct RelativeUnits {
    float offset;  // in film units
    float scale;   // an error is below 2^FILM_MAX_EXPONENT, and divided by the offset and scaled below 2^60
    double factor; // of the squares, because the offset is another

    // An offset far above all that a film holds is the limit of all pixels: a smaller one, far above too, makes all
    // squares larger by the same factor.
    explicit RelativeUnits(double unit) {
        constexpr double far_above = 1e18;
        const double exact = std::sqrt(relative_offset) / unit;
        offset = static_cast<float>(std::min(exact, far_above));
        scale = std::min(1.0F, 0x1p32F * offset);
        factor = std::pow(std::max(exact / far_above, 1.0), 2.0);
    }
};

TileErrors errors_of(const gpu::TileError &tile, std::uint32_t pixel_count, double unit, const RelativeUnits &units) {
    if (tile.lost_pixels > 0)
        throw Error(PT_ERROR_INTERNAL, "the driver lost samples of " + std::to_string(tile.lost_pixels) + " pixels");
    TileErrors errors{};
    errors.value_count = 3.0 * pixel_count;
    errors.rejected = std::uint64_t{tile.rejected.y} << 32 | tile.rejected.x;
    const bool known = tile.unknown_pixels == 0;
    const double relative_scale = static_cast<double>(units.scale);
    const auto square = [&](double of_film, double factor) {
        return known ? of_film * factor : std::numeric_limits<double>::infinity();
    };
    errors.square = square(static_cast<double>(tile.square), unit * unit);
    errors.square_of_pixels = errors.square * errors.square * static_cast<double>(tile.square_shares);
    errors.relative_square =
        square(static_cast<double>(tile.relative_square), 1.0 / (relative_scale * relative_scale * units.factor));
    errors.relative_square_of_pixels =
        errors.relative_square * errors.relative_square * static_cast<double>(tile.relative_shares);
    errors.unseen = static_cast<double>(tile.unseen) / units.factor;
    return errors;
}

} // namespace

vulkan::ComputePipeline estimate_pipeline(vulkan::Device &device, std::span<const std::uint32_t> code) {
    constexpr std::array bindings = {vulkan::no_binding, vulkan::no_binding, vk::DescriptorType::eStorageBuffer,
                                     vk::DescriptorType::eStorageBuffer};
    static_assert(gpu::BINDING_FILM == 2 && gpu::BINDING_RESOLVED == 3);
    return {device, code, bindings, sizeof(gpu::EstimateConstants), {}};
}

ErrorReader::ErrorReader(vulkan::Device &device, const vulkan::ComputePipeline &estimate, DeviceFilm &film) :
    device_(device),
    estimate_(estimate),
    film_(film),
    tiles_(device, vulkan::BufferUse::Storage, most_tile_bytes(film), "error of an image"),
    host_(device, vulkan::BufferUse::HostRead, most_tile_bytes(film), "error of an image") {
    for (DeviceFilm::Strip &strip : film.strips()) {
        const std::array<vulkan::Buffer *, 4> buffers = {nullptr, nullptr, &strip.words, &tiles_};
        sets_.push_back(estimate.bind(buffers));
    }
}

void ErrorReader::read(double unit, const PartCounts &samples, const std::function<void(const TileErrors &)> &receive) {
    const RelativeUnits units(unit);
    const std::uint32_t width = film_.width();
    gpu::EstimateConstants constants{};
    constants.sample_counts = {static_cast<std::uint32_t>(samples[older_part]),
                               static_cast<std::uint32_t>(samples[newer_part])};
    constants.older_part = film_.parts().older();
    constants.film_width = width;
    constants.sample_count = static_cast<float>(samples[older_part] + samples[newer_part]);
    constants.relative_offset = units.offset;
    constants.relative_scale = units.scale;
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        const DeviceFilm::Strip &strip = film_.strips()[i];
        const std::uint32_t rows = strip.pixel_count / width;
        constants.strip_pixel_count = strip.pixel_count;
        constants.row_count = rows;
        device_.submit([&](const vk::raii::CommandBuffer &commands) {
            estimate_.dispatch(commands, sets_[i], std::as_bytes(std::span(&constants, 1)), regions_of(width), {},
                               regions_of(rows));
            vulkan::barrier_between_commands(commands);
            host_.copy(commands, tiles_, tile_bytes(film_, strip));
        });
        const auto *tile = reinterpret_cast<const gpu::TileError *>(host_.host_bytes().data());
        for (std::uint32_t top = 0; top < rows; top += gpu::REGION_SIZE)
            for (std::uint32_t left = 0; left < width; left += gpu::REGION_SIZE)
                for (std::uint32_t in_region = 0; in_region < tiles_in_region; ++in_region, ++tile) {
                    const std::uint32_t x = left + in_region % tiles_in_row * gpu::TILE_SIZE;
                    const std::uint32_t y = top + in_region / tiles_in_row * gpu::TILE_SIZE;
                    if (x < width && y < rows)
                        receive(errors_of(*tile,
                                          std::min(gpu::TILE_SIZE, width - x) * std::min(gpu::TILE_SIZE, rows - y),
                                          unit, units));
                }
    }
}

} // namespace pt
