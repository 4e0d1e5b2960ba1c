#include "lib/render/first_hit_image.h"

#include "lib/render/image_rows.h"

#include <cstring>
#include <span>
#include <vector>

namespace pt {

void read_first_hits(const Image &image, const RenderSettings &settings, const std::shared_ptr<const GpuScene> &scene,
                     RenderDevice &device) {
    FirstHitQuery query{image.layout.pixels, image.layout.quantity, image.layout.format};
    query.pixels.y += settings.first_row;
    ImageRows rows(image);
    if (query.quantity != PT_QUANTITY_OBJECT) {
        device.read_first_hits(scene, settings, query, [&](std::span<const std::byte> pixels) { rows.put(pixels); });
        return;
    }
    std::vector<std::uint32_t> objects;
    device.read_first_hits(scene, settings, query, [&](std::span<const std::byte> surfaces) {
        objects.resize(surfaces.size() / sizeof(std::uint32_t));
        std::memcpy(objects.data(), surfaces.data(), surfaces.size());
        for (std::uint32_t &object : objects)
            object = scene->object_of(object);
        rows.put(std::as_bytes(std::span(objects)));
    });
}

} // namespace pt
