#include "lib/render/coverage_image.h"

#include "lib/film/pixel_format.h"
#include "lib/render/image_rows.h"

#include <cstddef>
#include <span>
#include <vector>

namespace pt {

// Both numbers are below 2^32, so the quotient in double, rounded to float, is the correctly rounded one, except within
// 2^-53 of the middle of two floats.
void read_coverage(const Image &image, const TileSamples &samples, const RenderSettings &settings,
                   const std::shared_ptr<const GpuScene> &scene, RenderDevice &device) {
    const Rectangle &pixels = image.layout.pixels;
    ImageRows rows(image);
    std::uint64_t done = 0;
    std::vector<float> values;
    std::vector<std::byte> bytes;
    device.read_coverage(scene, {pixels, samples, settings}, [&](std::span<const std::uint32_t> counts) {
        values.clear();
        for (const std::uint32_t count : counts) {
            const auto x = static_cast<std::uint32_t>(pixels.x + done % pixels.width);
            const auto y = static_cast<std::uint32_t>(pixels.y + done / pixels.width);
            const std::uint64_t all = samples.of(samples.grid().tile_at(x, y)).count();
            const double share = all > 0 ? static_cast<double>(count) / static_cast<double>(all) : 0.0;
            values.insert(values.end(), 3, static_cast<float>(share));
            ++done;
        }
        bytes.resize(counts.size() * pixel_bytes(image.layout.format));
        write_pixels(values, image.layout.format, bytes.data());
        rows.put(bytes);
    });
}

} // namespace pt
