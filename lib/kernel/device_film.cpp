#include "lib/kernel/device_film.h"

#include "lib/base/error.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace pt {

namespace {

// Strips have whole rows of tiles if a row fits.
std::uint32_t strip_pixels(std::uint32_t width, std::uint32_t most) {
    const std::uint64_t row_of_tiles = std::uint64_t{width} * gpu::TILE_SIZE;
    return row_of_tiles > most ? most : static_cast<std::uint32_t>(most / row_of_tiles * row_of_tiles);
}

std::uint64_t word_offset(const DeviceFilm::Strip &strip, std::size_t plane, std::uint32_t pixel) {
    return (std::uint64_t{plane} * strip.pixel_count + (pixel - strip.first_pixel)) * sizeof(std::uint32_t);
}

void require_memory(const vulkan::Device &device, std::uint64_t bytes, const std::string &what) {
    const std::uint64_t in_use = device.allocated_bytes();
    if (!device.has_memory(in_use + bytes))
        throw Error(PT_ERROR_OUT_OF_DEVICE_MEMORY, what + " takes " + std::to_string(bytes) + " bytes beside the " +
                                                       std::to_string(in_use) + " in use, and the device has " +
                                                       std::to_string(device.info().memory_bytes));
}

} // namespace

PixelRange common_pixels(const PixelRange &a, const PixelRange &b) {
    const std::uint32_t first = std::max(a.first, b.first);
    const std::uint64_t end = std::min(std::uint64_t{a.first} + a.count, std::uint64_t{b.first} + b.count);
    return {first, end > first ? static_cast<std::uint32_t>(end - first) : 0};
}

std::uint32_t max_strip_pixels(const vulkan::Limits &limits, bool has_coverage) {
    const std::uint64_t bytes = std::min<std::uint64_t>(limits.max_storage_buffer_range, limits.max_allocation_bytes);
    const std::uint64_t pixels = bytes / DeviceFilm::bytes_per_pixel(has_coverage);
    const std::uint64_t dispatched = std::uint64_t{limits.max_workgroup_count} * gpu::WORKGROUP_SIZE;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>({pixels, dispatched, UINT32_MAX}));
}

DeviceFilm::DeviceFilm(vulkan::Device &device, std::uint32_t width, std::uint32_t height,
                       std::uint32_t max_strip_pixels, bool has_coverage) :
    grid_{width, height},
    has_coverage_(has_coverage) {
    for (std::uint32_t first = 0; first < pixel_count();) {
        const std::uint32_t count = std::min(strip_pixels(width, max_strip_pixels), pixel_count() - first);
        const std::uint64_t words_bytes = count * bytes_per_pixel();
        strips_.push_back({first, count, vulkan::Buffer(device, vulkan::BufferUse::Storage, words_bytes, "film")});
        first += count;
    }
}

void DeviceFilm::clear(const vk::raii::CommandBuffer &commands) const {
    for (const Strip &strip : strips_)
        strip.words.clear(commands, 0, strip.words.size());
}

void DeviceFilm::read(std::uint32_t first_pixel, PixelSums &sums) {
    for (Strip &strip : strips_) {
        const PixelRange pixels =
            common_pixels(strip.pixels(), {first_pixel, static_cast<std::uint32_t>(sums.pixel_count())});
        if (pixels.count == 0)
            continue;
        std::vector<vulkan::BufferPiece> pieces;
        for (std::size_t plane = 0; plane < std::min(sums.plane_count(), film_planes(has_coverage_)); ++plane)
            pieces.push_back(
                {std::as_writable_bytes(sums.plane(plane).subspan(pixels.first - first_pixel, pixels.count)),
                 word_offset(strip, plane, pixels.first)});
        strip.words.download(pieces);
    }
}

bool DeviceFilm::has_whole_tiles() const {
    return strips_.size() == 1 || strips_.front().pixel_count % (std::uint64_t{grid_.width} * gpu::TILE_SIZE) == 0;
}

void DeviceFilm::copy_to(const vk::raii::CommandBuffer &commands, const PixelRange &pixels,
                         const vulkan::Buffer &to) const {
    for (const Strip &strip : strips_) {
        const PixelRange overlap = common_pixels(strip.pixels(), pixels);
        if (overlap.count == 0)
            continue;
        std::vector<vk::BufferCopy> pieces;
        for (std::size_t plane = 0; plane < film_planes(has_coverage_); ++plane) {
            const std::uint64_t words = std::uint64_t{plane} * pixels.count + (overlap.first - pixels.first);
            pieces.push_back({.srcOffset = word_offset(strip, plane, overlap.first),
                              .dstOffset = words * sizeof(std::uint32_t),
                              .size = overlap.count * sizeof(std::uint32_t)});
        }
        to.copy(commands, strip.words, pieces);
    }
}

DeviceFilm::NewSums::NewSums(vulkan::Device &device, DeviceFilm &film) : device_(device), film_(film) {
    const std::uint64_t bytes = film.pixel_count() * film.bytes_per_pixel();
    require_memory(device, bytes, "a sum of films");
    for (const Strip &strip : film.strips_)
        words_.emplace_back(device, vulkan::BufferUse::Storage, strip.words.size(), "sum of films");
}

void DeviceFilm::NewSums::write(std::uint32_t first_pixel, const PixelSums &sums) {
    for (std::size_t i = 0; i < words_.size(); ++i) {
        const Strip &strip = film_.strips_[i];
        const PixelRange pixels =
            common_pixels(strip.pixels(), {first_pixel, static_cast<std::uint32_t>(sums.pixel_count())});
        for (std::size_t plane = 0; plane < sums.plane_count() && pixels.count > 0; ++plane)
            words_[i].upload(std::as_bytes(sums.plane(plane).subspan(pixels.first - first_pixel, pixels.count)),
                             word_offset(strip, plane, pixels.first));
    }
}

void DeviceFilm::NewSums::replace() {
    device_.submit([&](const vk::raii::CommandBuffer &commands) {
        for (std::size_t i = 0; i < words_.size(); ++i)
            film_.strips_[i].words.copy(commands, words_[i], vk::BufferCopy{.size = words_[i].size()});
    });
}

std::uint64_t DeviceFilm::rejected_samples() {
    std::uint64_t total = 0;
    std::vector<std::uint32_t> plane;
    for (Strip &strip : strips_) {
        plane.resize(strip.pixel_count);
        for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part) {
            strip.words.download(
                std::as_writable_bytes(std::span(plane)),
                word_offset(strip, std::size_t{part} * gpu::FILM_WORDS + gpu::FILM_REJECTED, strip.first_pixel));
            total = std::accumulate(plane.begin(), plane.end(), total);
        }
    }
    return total;
}

namespace {

void require_all(const PixelSums &sums, std::size_t first, std::size_t count, const PartCounts &expected) {
    std::uint64_t others = 0;
    for (std::uint32_t part = 0; part < gpu::FILM_PARTS; ++part) {
        const std::uint32_t *const accepted = sums.plane(part, gpu::FILM_ACCEPTED).subspan(first).data();
        const std::uint32_t *const rejected = sums.plane(part, gpu::FILM_REJECTED).subspan(first).data();
        for (std::size_t i = 0; i < count; ++i)
            others |= (std::uint64_t{accepted[i]} + rejected[i]) ^ expected[part];
    }
    for (std::size_t i = 0; i < count && others != 0; ++i)
        require_samples(sums.samples_of(first + i), expected);
}

void require_all(const PixelSums &sums, std::uint32_t first_pixel, const TileSamples &samples) {
    std::vector<PartCounts> expected;
    for (const SampleSet &set : samples.sets())
        expected.push_back(part_counts(set));
    if (samples.even())
        require_all(sums, 0, sums.pixel_count(), expected.front());
    else
        samples.grid().for_each_run(first_pixel, sums.pixel_count(),
                                    [&](std::size_t first, std::size_t count, std::size_t tile) {
                                        require_all(sums, first, count, expected[samples.set_of(tile)]);
                                    });
}

void read_films(std::span<DeviceFilm *const> films, const TileSamples &samples, std::uint32_t first_pixel,
                PixelSums &sums, PixelSums &others) {
    films.front()->read(first_pixel, sums);
    for (DeviceFilm *film : films.subspan(1)) {
        others.resize(sums.pixel_count(), sums.has_coverage());
        film->read(first_pixel, others);
        sums.add(others);
    }
    require_all(sums, first_pixel, samples);
}

} // namespace

void read_films(std::span<DeviceFilm *const> films, const TileSamples &samples, std::uint32_t first_pixel,
                PixelSums &sums) {
    PixelSums others;
    read_films(films, samples, first_pixel, sums, others);
}

void read_films(std::span<DeviceFilm *const> films, const TileSamples &samples, const PixelRange &pixels,
                std::uint32_t most_pixels, const std::function<void(const PixelSums &)> &receive) {
    PixelSums sums;
    PixelSums others;
    for (std::uint32_t done = 0; done < pixels.count; done += static_cast<std::uint32_t>(sums.pixel_count())) {
        sums.resize(std::min(most_pixels, pixels.count - done), films.front()->has_coverage());
        read_films(films, samples, pixels.first + done, sums, others);
        receive(sums);
    }
}

} // namespace pt
