#include "cli/import/nff_file.h"

#include "cli/data/text_number.h"
#include "cli/import/scene_words.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cli {
namespace {

struct NffName {
    std::string_view word;
    std::string_view thing;
};

constexpr std::array<NffName, 3> nff_other_shapes{
    {{"c", "a cone or cylinder"}, {"p", "a polygon"}, {"pp", "a polygonal patch"}}};

class NffReader {
public:
    NffReader(std::string_view text, const std::string &path) : words_(text, path) {}

    ForeignScene read() {
        while (const auto word = words_.next()) {
            read_entity(*word);
        }
        if (!has_view_) {
            words_.refuse("there is no viewpoint, \"v\"");
        }
        share_intensity();
        return std::move(scene_);
    }

private:
    void read_entity(std::string_view word) {
        if (word == "v") {
            read_view();
        } else if (word == "b") {
            scene_.background = words_.color("the background, \"b\",");
        } else if (word == "l") {
            read_light();
        } else if (word == "f") {
            read_fill();
        } else if (word == "s") {
            read_sphere();
        } else {
            refuse_entity(word);
        }
    }

    [[noreturn]] void refuse_entity(std::string_view word) const {
        const auto *found = std::find_if(nff_other_shapes.begin(), nff_other_shapes.end(),
                                         [word](const NffName &each) { return each.word == word; });
        if (found != nff_other_shapes.end()) {
            words_.refuse(quoted_text(word)
                              .append(" is ")
                              .append(found->thing)
                              .append(": of shapes, spheres alone can be rendered"));
        }
        words_.refuse(quoted_text(word) + ": must be one of v, b, l, f and s");
    }

    void expect(std::string_view word) {
        const std::string_view found = words_.require(word);
        if (found != word) {
            words_.refuse(quoted_text(found).append(" must be ").append(quoted_text(word)).append(" of a viewpoint"));
        }
    }

    void read_view() {
        if (std::exchange(has_view_, true)) {
            words_.refuse("there is a second viewpoint, \"v\"");
        }
        ForeignCamera &camera = scene_.camera;
        expect("from");
        camera.position = words_.vector("from");
        expect("at");
        camera.look_at = words_.vector("at");
        if (camera.look_at == camera.position) {
            words_.refuse("at: must not be where \"from\" is");
        }
        expect("up");
        camera.up = words_.direction("up");
        expect("angle");
        const double angle = words_.number("angle");
        if (!(angle > 0.0 && angle < 180.0)) {
            words_.refuse("angle: must be above 0 and below 180");
        }
        expect("hither");
        words_.number("hither");
        expect("resolution");
        scene_.width = words_.whole_number("resolution");
        scene_.height = words_.whole_number("resolution");
        camera.vertical_fov = fov_between_edges(angle, scene_.height);
    }

    // The angle of the file is that between the middles of the first and the last row of pixels.
    static double fov_between_edges(double angle, std::uint32_t height) {
        constexpr double degree = std::numbers::pi / 180.0;
        const double rows = height == 1 ? 1.0 : height - 1.0;
        return 2.0 / degree * std::atan(std::tan(0.5 * degree * angle) * height / rows);
    }

    void read_light() {
        ForeignLight light{words_.place(), false, words_.vector("a light, \"l\","), {}};
        constexpr std::string_view begins_of_numbers = "+-.0123456789";
        const std::string_view next = words_.peek();
        if (!next.empty() && begins_of_numbers.find(next.front()) != std::string_view::npos) {
            light.color = words_.color("the colour of a light, \"l\",");
        } else {
            lights_without_color_.push_back(scene_.lights.size());
        }
        scene_.lights.push_back(light);
    }

    // Where the file gives no intensities they are for the program to choose: more lights give more light, but not as
    // many times.
    void share_intensity() {
        for (const std::size_t index : lights_without_color_) {
            scene_.lights[index].color.fill(1.0 / std::sqrt(static_cast<double>(scene_.lights.size())));
        }
    }

    void read_fill() {
        const std::uint64_t line = words_.line();
        ForeignMaterial material{
            std::string("f:").append(std::to_string(line)), words_.color("the colour of a fill, \"f\","), {}, 0.0};
        const double diffuse = words_.number_from_0("Kd");
        for (double &component : material.diffuse) {
            component *= diffuse;
        }
        material.specular.fill(words_.number_from_0("Ks"));
        material.glossiness = words_.number_from_0("Shine");
        const double transmittance = words_.number_from_0("T");
        words_.number("the index of refraction");
        if (transmittance > 0.0 && !std::exchange(has_transmittance_, true)) {
            scene_.left_out.push_back(words_.place() + ": T: light through surfaces is left out, they are opaque");
        }
        scene_.materials.push_back(material);
    }

    void read_sphere() {
        if (scene_.materials.empty()) {
            words_.refuse("a sphere, \"s\", comes before the first fill, \"f\"");
        }
        const ForeignVector center = words_.vector("the centre of a sphere, \"s\",");
        // Of negative ones the inside is meant to be seen; here, both sides always are.
        const double radius = std::abs(words_.number("the radius of a sphere, \"s\","));
        if (radius == 0.0) {
            words_.refuse("the radius of a sphere, \"s\", must not be 0");
        }
        scene_.spheres.push_back({center, radius, scene_.materials.size() - 1});
    }

    SceneWords words_;
    ForeignScene scene_;
    std::vector<std::size_t> lights_without_color_;
    bool has_view_ = false;
    bool has_transmittance_ = false;
};

} // namespace

ForeignScene read_nff(std::string_view text, const std::string &path) {
    return NffReader(text, path).read();
}

} // namespace cli
