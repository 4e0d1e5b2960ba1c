// The digest of a scene, by which films tell whether they show the same one.
#pragma once

#include "lib/scene/scene.h"

#include <string>

namespace pt {

// As Digest::text. Takes almost as long as pt_set_scene: 0.4 ms for 10,000 spheres.
std::string digest_of(const Scene &scene);

} // namespace pt
