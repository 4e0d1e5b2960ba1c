// The sections `materials`, `spheres` and `planes` of a scene file.
#pragma once

#include "cli/base/json_value.h"
#include "cli/scene/material_references.h"
#include "cli/scene/scene_file.h"

namespace cli {

class SurfaceSections {
public:
    explicit SurfaceSections(SceneFile &scene) : scene_(scene) {}

    void material(const JsonPlace &place, const nlohmann::json &value);
    void sphere(const JsonPlace &place, const nlohmann::json &value);
    void plane(const JsonPlace &place, const nlohmann::json &value);

    // At the end of the file: gives spheres and planes the indices of their materials.
    void resolve_materials();

private:
    SceneFile &scene_;
    MaterialReferences references_;
};

} // namespace cli
