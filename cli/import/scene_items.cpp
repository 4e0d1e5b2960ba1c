#include "cli/import/scene_items.h"

#include "cli/import/light_lamps.h"

#include <algorithm>

namespace cli {
namespace {

using nlohmann::json;

// Of the extent of the scene. A floor ends at the sky, by the height of the camera over this below the horizon: less
// than a pixel.
constexpr double sky_radius = 1e6;

class ItemWriter {
public:
    ItemWriter(ForeignScene &scene, JsonSectionHandler &handler) :
        scene_(scene),
        lamps_(lamps_of(scene, scene.left_out)),
        has_sky_(scene.background != ForeignVector{}),
        handler_(handler) {}

    void write() {
        write_camera();
        write_film();
        write_materials();
        write_spheres();
        write_planes();
    }

private:
    void begin(std::string_view section, json::value_t kind) {
        section_ = root_.member(section);
        handler_.begin_section(section_, kind);
    }

    void write_member(std::string_view key, const json &value) { handler_.item(section_.member(key), value); }
    void write_element(const json &value) { handler_.item(section_.element(count_++), value); }

    void write_camera() {
        const ForeignCamera &camera = scene_.camera;
        begin("camera", json::value_t::object);
        write_member("position", camera.position);
        write_member("look_at", camera.look_at);
        write_member("up", camera.up);
        if (camera.vertical_extent) {
            write_member("projection", "orthographic");
            write_member("vertical_extent", *camera.vertical_extent);
        } else {
            write_member("vertical_fov", camera.vertical_fov);
        }
    }

    void write_film() {
        begin("film", json::value_t::object);
        write_member("width", scene_.width);
        write_member("height", scene_.height);
    }

    static std::string lamp_name(std::size_t index) { return "light " + std::to_string(index + 1); }

    void write_materials() {
        begin("materials", json::value_t::object);
        for (const ForeignMaterial &material : scene_.materials) {
            write_member(
                material.name,
                {{"diffuse", material.diffuse}, {"specular", material.specular}, {"glossiness", material.glossiness}});
        }
        for (std::size_t i = 0; i < lamps_.size(); ++i) {
            write_member(lamp_name(i), {{"emission", lamps_[i].emission}, {"hidden_from_camera", lamps_[i].is_hidden}});
        }
        if (has_sky_) {
            write_member("sky", {{"emission", scene_.background}});
        }
    }

    void write_sphere(const ForeignVector &center, double radius, const std::string &material) {
        write_element({{"center", center}, {"radius", radius}, {"material", material}});
    }

    void write_spheres() {
        begin("spheres", json::value_t::array);
        count_ = 0;
        for (const ForeignSphere &sphere : scene_.spheres) {
            write_sphere(sphere.center, sphere.radius, scene_.materials[sphere.material].name);
        }
        for (std::size_t i = 0; i < lamps_.size(); ++i) {
            write_sphere(lamps_[i].center, lamps_[i].radius, lamp_name(i));
        }
        if (has_sky_) {
            write_sphere(scene_.camera.look_at, sky_radius * extent_of(scene_), "sky");
        }
    }

    void write_planes() {
        begin("planes", json::value_t::array);
        count_ = 0;
        for (const ForeignPlane &plane : scene_.planes) {
            write_element({{"normal", plane.normal},
                           {"offset", plane.offset},
                           {"material", scene_.materials[plane.material].name}});
        }
    }

    ForeignScene &scene_;
    std::vector<ForeignLamp> lamps_;
    bool has_sky_;
    JsonSectionHandler &handler_;
    JsonPlace root_;
    JsonPlace section_;
    std::size_t count_ = 0;
};

} // namespace

void hand_on(ForeignScene &scene, JsonSectionHandler &handler) {
    ItemWriter(scene, handler).write();
}

} // namespace cli
