// From the numbers that a kernel gives to surfaces to those of the objects in the caller's scene. Made when objects are
// asked for.
#pragma once

#include "lib/kernel/prepared_scene.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pt {

class ObjectNumbers {
public:
    ObjectNumbers(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings);

    // Of a surface (shaders/scene.glsl), or PT_NO_OBJECT of none.
    std::uint32_t of_surface(std::uint32_t surface) const;

private:
    std::shared_ptr<const SphereTree> tree_; // NULL without
    std::vector<std::uint32_t> numbers_;     // of the surfaces that are not in the tree
};

} // namespace pt
