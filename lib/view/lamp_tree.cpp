#include "lib/view/lamp_tree.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>

namespace pt {

namespace {

struct Place {
    glm::dvec3 at;
    std::uint32_t sphere;
};

int widest_axis(std::span<const Place> places) {
    glm::dvec3 low = places.front().at;
    glm::dvec3 high = low;
    for (const Place &place : places) {
        low = glm::min(low, place.at);
        high = glm::max(high, place.at);
    }
    const glm::dvec3 width = high - low;
    return width.x >= width.y && width.x >= width.z ? 0 : width.y >= width.z ? 1 : 2;
}

// Divides lamps along their largest extent into two parts that each fill whole nodes.
void split(const LampTreeShape &shape, std::span<Place> places, std::uint64_t first_slot, std::uint64_t slot_count) {
    if (slot_count == 1)
        return;
    const std::uint64_t power = std::bit_floor(slot_count);
    const std::uint64_t part = power == slot_count ? power / 2 : power;
    const std::uint32_t first = shape.first_lamp(first_slot);
    const std::uint32_t middle = shape.first_lamp(first_slot + part);
    const std::uint32_t end = shape.first_lamp(first_slot + slot_count);
    if (middle > first && end > middle) {
        const std::span<Place> range = places.subspan(first, end - first);
        const int axis = widest_axis(range);
        std::ranges::nth_element(range, range.begin() + static_cast<std::ptrdiff_t>(middle - first), {},
                                 [axis](const Place &place) { return place.at[axis]; });
    }
    split(shape, places, first_slot, part);
    split(shape, places, first_slot + part, slot_count - part);
}

} // namespace

LampTreeShape::LampTreeShape(std::uint32_t lamp_count) : lamp_count_(lamp_count) {
    while (lamp_count > std::uint64_t{16} << (2 * levels_))
        ++levels_;
    top_groups_ = gpu::lamp_tree_top_groups(lamp_count, levels_);
}

std::vector<std::uint32_t> order_in_lamp_tree(const Scene &scene) {
    std::vector<Place> places;
    for (std::size_t i = 0; i < scene.spheres.size(); ++i)
        if (const Sphere &sphere = scene.spheres[i]; emits(scene.materials[sphere.material]))
            places.push_back({sphere.center + 0.5 * sphere.motion, static_cast<std::uint32_t>(i)});
    if (!places.empty()) {
        const LampTreeShape shape(static_cast<std::uint32_t>(places.size()));
        split(shape, places, 0, shape.slots());
    }
    std::vector<std::uint32_t> order(places.size());
    std::ranges::transform(places, order.begin(), &Place::sphere);
    return order;
}

} // namespace pt
