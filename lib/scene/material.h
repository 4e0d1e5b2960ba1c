#pragma once

#include "shaders/specialization.h"

#include <pt/pt.h>

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace pt {

struct Material {
    glm::vec3 diffuse;
    glm::vec3 specular;
    glm::vec3 emission;
    float glossiness;
    bool hidden = false; // hidden from the camera
};

inline bool emits(const Material &material) {
    return material.emission != glm::vec3(0.0F);
}

inline bool is_glossy(const Material &material) {
    return material.specular != glm::vec3(0.0F);
}

// A sphere's own properties, which change its material.
struct Look {
    glm::vec3 color{1.0F};
};

// The square root resolves dark colors better.
inline std::uint32_t color_word(const glm::vec3 &color) {
    const glm::uvec3 steps(glm::sqrt(glm::clamp(color, 0.0F, 1.0F)) * float{gpu::TREE_COLOR_STEPS} + 0.5F);
    return steps.r | steps.g << 10 | steps.b << 20;
}

struct LookColumn {
    pt_column pt_sphere_array::*column;
    std::uint32_t constant; // kernel constant; 1 if tree spheres have the column
    void (*change)(Material &material, const Look &look);
    std::uint32_t (*word)(const Look &look); // in the tree
};

inline constexpr std::array look_columns{
    LookColumn{&pt_sphere_array::color, gpu::ID_TREE_COLORS,
               [](Material &material, const Look &look) { material.diffuse *= look.color; },
               [](const Look &look) { return color_word(look.color); }},
};

} // namespace pt
