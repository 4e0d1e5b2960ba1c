#pragma once

#include "lib/scene/checked_scene.h"
#include "lib/view/camera_rules.h"
#include "lib/view/view.h"
#include "tests/support/checked_scene_of.h"
#include "tests/support/coursework_scene.h"

#include <memory>

inline std::shared_ptr<const pt::View> coursework_view(const pt::RenderSettings &settings) {
    const CourseworkScene coursework;
    return std::make_shared<const pt::View>(
        pt::view_of(pt::PreparedScene(pt::owned_scene(checked_scene_of(coursework.scene()))),
                    pt::validated_camera(CourseworkScene::camera()), settings));
}
