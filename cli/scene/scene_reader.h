// Reads the sections of a scene file, each by its own class or function.
#pragma once

#include "cli/scene/animation_section.h"
#include "cli/scene/camera_section.h"
#include "cli/scene/json_sections.h"
#include "cli/scene/picture_sections.h"
#include "cli/scene/scene_file.h"
#include "cli/scene/surface_sections.h"

namespace cli {

// Throws JsonRefusal.
class SceneReader : public JsonSectionHandler {
public:
    explicit SceneReader(SceneFile &scene) : scene_(scene), camera_(scene.camera), surfaces_(scene) {}

    void begin_section(const JsonPlace &place, nlohmann::json::value_t kind) override;
    void item(const JsonPlace &place, const nlohmann::json &value) override { (this->*read_item_)(place, value); }

    // Checks what can be known only at the end of the file, and resolves the names of materials.
    void finish();

private:
    using ItemReader = void (SceneReader::*)(const JsonPlace &, const nlohmann::json &);

    void camera_item(const JsonPlace &place, const nlohmann::json &value) { camera_.item(place, value); }
    void film_item(const JsonPlace &place, const nlohmann::json &value) { read_film_item(scene_, place, value); }
    void render_item(const JsonPlace &place, const nlohmann::json &value) { read_render_item(scene_, place, value); }
    void animation_item(const JsonPlace &place, const nlohmann::json &value) {
        read_animation_item(scene_, place, value);
    }
    void material_item(const JsonPlace &place, const nlohmann::json &value) { surfaces_.material(place, value); }
    void sphere_item(const JsonPlace &place, const nlohmann::json &value) { surfaces_.sphere(place, value); }
    void plane_item(const JsonPlace &place, const nlohmann::json &value) { surfaces_.plane(place, value); }

    SceneFile &scene_;
    CameraSection camera_;
    SurfaceSections surfaces_;
    ItemReader read_item_ = nullptr;
};

} // namespace cli
