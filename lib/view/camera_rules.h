#pragma once

#include "lib/scene/camera.h"

#include <string>

namespace pt {

// Throws PT_ERROR_INVALID_ARGUMENT with all broken rules.
Camera validated_camera(const pt_camera &given);

std::string digest_of(const Camera &camera);

} // namespace pt
