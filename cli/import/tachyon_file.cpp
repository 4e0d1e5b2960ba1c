#include "cli/import/tachyon_file.h"

#include "cli/data/text_number.h"
#include "cli/import/tachyon_camera.h"
#include "cli/import/tachyon_textures.h"
#include "cli/import/view_target.h"

#include <algorithm>
#include <optional>

namespace cli {
namespace {

struct TachyonName {
    std::string_view word;
    std::string_view thing;
};

constexpr std::array<TachyonName, 21> tachyon_other_things{{{"TRI", "a triangle"},
                                                            {"STRI", "a smooth triangle"},
                                                            {"VCSTRI", "a smooth triangle"},
                                                            {"VERTEXARRAY", "a mesh of triangles"},
                                                            {"CYLINDER", "a cylinder"},
                                                            {"FCYLINDER", "a finite cylinder"},
                                                            {"POLYCYLINDER", "a chain of cylinders"},
                                                            {"RING", "a ring"},
                                                            {"BOX", "a box"},
                                                            {"QUADRIC", "a quadric surface"},
                                                            {"SCAPE", "a landscape"},
                                                            {"SCALARVOL", "a volume"},
                                                            {"TPOLYFILE", "a file of triangles"},
                                                            {"MGFFILE", "a file of shapes"},
                                                            {"IMAGEDEF", "an image"},
                                                            {"SPOTLIGHT", "a spotlight"},
                                                            {"SKY_LIGHT", "light from all sides"},
                                                            {"BACKGROUND_GRADIENT", "a background of two colours"},
                                                            {"FOG", "fog"},
                                                            {"START_CLIPGROUP", "a cut through shapes"},
                                                            {"INCLUDE", "another file"}}};

class TachyonReader {
public:
    TachyonReader(std::string_view text, const std::string &path) : words_(text, path), textures_(words_, scene_) {}

    ForeignScene read() {
        words_.expect("BEGIN_SCENE");
        words_.expect("RESOLUTION");
        scene_.width = words_.whole_number("RESOLUTION");
        scene_.height = words_.whole_number("RESOLUTION");
        for (std::string word; word != "END_SCENE";) {
            word = words_.keyword("END_SCENE");
            read_object(word);
        }
        if (!camera_) {
            words_.refuse("there is no CAMERA");
        }
        scene_.camera = camera_->camera;
        scene_.camera.look_at = view_target(scene_, camera_->camera.position, camera_->view);
        return std::move(scene_);
    }

private:
    void read_object(const std::string &word) {
        if (word == "SPHERE") {
            read_sphere();
        } else if (word == "PLANE") {
            read_plane();
        } else if (word == "TEXDEF") {
            textures_.define();
        } else if (word == "TEXALIAS") {
            textures_.define_alias();
        } else if (word == "LIGHT") {
            read_light();
        } else if (word == "DIRECTIONAL_LIGHT") {
            read_directional_light();
        } else if (word == "CAMERA") {
            read_camera();
        } else if (word == "BACKGROUND") {
            scene_.background = words_.color("BACKGROUND");
        } else if (word == "SHADER_MODE") {
            read_shader_mode();
        } else if (word != "END_SCENE") {
            refuse_object(word);
        }
    }

    [[noreturn]] void refuse_object(const std::string &word) const {
        const auto *found = std::find_if(tachyon_other_things.begin(), tachyon_other_things.end(),
                                         [&word](const TachyonName &each) { return each.word == word; });
        if (found != tachyon_other_things.end()) {
            words_.refuse(word + " is " + std::string(found->thing) +
                          ": spheres, planes, lights and a camera alone can be rendered");
        }
        words_.refuse(quoted_text(word) +
                      ": must be CAMERA, BACKGROUND, LIGHT, DIRECTIONAL_LIGHT, TEXDEF, TEXALIAS, SPHERE, PLANE, "
                      "SHADER_MODE or END_SCENE");
    }

    void read_camera() {
        if (camera_) {
            words_.refuse("there is a second CAMERA");
        }
        camera_ = read_tachyon_camera(words_, static_cast<double>(scene_.width) / scene_.height, scene_.left_out);
    }

    void read_sphere() {
        words_.expect("CENTER");
        const ForeignVector center = words_.mirrored("CENTER");
        words_.expect("RAD");
        const double radius = words_.number("RAD");
        if (!(radius > 0.0)) {
            words_.refuse("RAD: must be above 0");
        }
        scene_.spheres.push_back({center, radius, textures_.read_reference()});
    }

    void read_plane() {
        words_.expect("CENTER");
        const ForeignVector point = words_.mirrored("CENTER");
        words_.expect("NORMAL");
        const ForeignVector normal = words_.mirrored_direction("NORMAL");
        const double offset = -(normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2]);
        scene_.planes.push_back({normal, offset, textures_.read_reference()});
    }

    void read_light() {
        ForeignLight light{words_.place(), false, {}, {}};
        words_.expect("CENTER");
        light.place = words_.mirrored("CENTER");
        words_.expect("RAD");
        light.radius = words_.number_from_0("RAD");
        if (words_.take_if("ATTENUATION")) {
            constexpr std::array<const char *, 3> names{"CONSTANT", "LINEAR", "QUADRATIC"};
            for (std::size_t i = 0; i < names.size(); ++i) {
                words_.expect(names[i]);
                light.attenuation[i] = words_.number_from_0(names[i]);
            }
            if (light.attenuation == ForeignVector{}) {
                words_.refuse("ATTENUATION: must not be 0 0 0");
            }
        }
        words_.expect("COLOR");
        light.color = words_.color("COLOR");
        scene_.lights.push_back(light);
    }

    void read_directional_light() {
        ForeignLight light{words_.place(), true, {}, {}};
        words_.expect("DIRECTION");
        const ForeignVector way = words_.mirrored_direction("DIRECTION"); // of the light
        light.place = {-way[0], -way[1], -way[2]};
        words_.expect("COLOR");
        light.color = words_.color("COLOR");
        scene_.lights.push_back(light);
    }

    // How Tachyon shades, which is not how light is found here.
    void read_shader_mode() {
        for (std::string word; word != "END_SHADER_MODE";) {
            word = words_.keyword("END_SHADER_MODE");
            if (word == "AMBIENT_OCCLUSION") {
                scene_.left_out.push_back(words_.place() + ": AMBIENT_OCCLUSION: its light from all sides is left out");
            }
        }
    }

    TachyonWords words_;
    ForeignScene scene_;
    TachyonTextures textures_;
    std::optional<TachyonCamera> camera_;
};

} // namespace

ForeignScene read_tachyon(std::string_view text, const std::string &path) {
    return TachyonReader(text, path).read();
}

} // namespace cli
