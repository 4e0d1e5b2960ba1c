#pragma once

#include "lib/view/prepared_scene.h"

#include <cstdint>
#include <utility>

inline pt::CheckedScene checked_scene_of(const pt_scene &scene) {
    pt::WorkProgress nobody;
    return pt::checked_scene(scene, nobody);
}

inline pt::PreparedScene prepared_scene_of(pt::CheckedScene checked, std::uint32_t tree_from) {
    pt::WorkProgress nobody;
    return {std::move(checked), tree_from, nullptr, nobody};
}
