// The digest of a scene, by which films tell whether they show the same one.
#pragma once

#include "lib/base/digest.h"
#include "lib/scene/scene.h"

#include <string>

namespace pt {

// A digest like Digest::text, of the surfaces in their order and the material of each. It does not matter whether
// spheres came as structs or by columns, which unused materials there are, or in which order and how often materials
// are listed. Takes almost as long as pt_set_scene: 0.4 ms for 10,000 spheres.
std::string digest_of(const Scene &scene);

// Adds all of a material to a digest.
void add(Digest &digest, const Material &material);

} // namespace pt
