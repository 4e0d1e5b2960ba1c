#include "lib/view/lamp.h"

#include "lib/view/prepared_scene.h"

namespace pt {

std::vector<Lamp> lamps_of(const PreparedScene &scene, const Camera &camera) {
    std::vector<Lamp> lamps;
    const auto add = [&](const Sphere &sphere) {
        lamps.push_back(lamp_of(sphere, scene.scene.materials[sphere.material], camera));
    };
    for (const Sphere &sphere : scene.scene.spheres)
        if (emits(scene.scene.materials[sphere.material]))
            add(sphere);
    for (std::uint32_t lamp = 0; scene.tree && lamp < scene.tree->lamp_materials().size(); ++lamp)
        add(scene.tree->lamp(lamp));
    return lamps;
}

} // namespace pt
