#pragma once

#include "lib/scene/checked_scene.h"
#include "lib/view/gpu_scene.h"
#include "tests/support/checked_scene_of.h"
#include "tests/support/coursework_scene.h"

#include <memory>

inline std::shared_ptr<const pt::GpuScene> coursework_gpu_scene(const pt::RenderSettings &settings) {
    const CourseworkScene coursework;
    return std::make_shared<const pt::GpuScene>(
        pt::gpu_scene(pt::PreparedScene(pt::owned_scene(checked_scene_of(coursework.scene()))),
                      pt::validated_camera(CourseworkScene::camera()), settings));
}
