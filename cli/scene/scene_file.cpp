#include "cli/scene/scene_file.h"

#include "cli/base/exit_code.h"
#include "cli/base/field_names.h"
#include "cli/base/json_path.h"
#include "cli/base/json_value.h"
#include "cli/base/method_names.h"
#include "cli/base/report_file.h"
#include "cli/base/suggestion.h"
#include "cli/base/text_file.h"
#include "cli/scene/json_sections.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <system_error>
#include <unordered_map>

namespace cli {
namespace {

using nlohmann::json;

constexpr std::uint32_t largest_uint32 = std::numeric_limits<std::uint32_t>::max();

std::uint32_t read_uint32(const json &value, const JsonPlace &place, std::uint32_t smallest) {
    return static_cast<std::uint32_t>(read_whole_number(value, place, smallest, largest_uint32));
}

template <std::size_t Count>
std::uint32_t read_method(const json &value, const JsonPlace &place, std::string_view kind,
                          const MethodNames<Count> &methods) {
    const std::string_view name = read_text(value, place);
    const auto method = methods.find(name);
    if (!method) {
        refuse(place, unknown_name(kind, name, methods.names()));
    }
    return *method;
}

Exposure read_exposure(const json &value, const JsonPlace &place) {
    const bool is_text = value.is_string();
    const auto exposure = parse_exposure(is_text ? std::string(read_text(value, place)) : value.dump());
    if (!exposure || (is_text && exposure->stops)) {
        refuse(place, "must be a number from -64 to 64, or \"auto\", is " + value.dump());
    }
    return *exposure;
}

template <typename Number, std::size_t Count>
void store(const std::array<Number, Count> &from, Number (&destination)[Count]) {
    std::copy(from.begin(), from.end(), destination);
}

std::size_t hash_of(std::string_view text) {
    return std::hash<std::string_view>{}(text);
}

class SceneReader : public JsonSectionHandler {
public:
    explicit SceneReader(SceneFile &scene);

    void begin_section(const JsonPlace &place, json::value_t kind) override;
    void item(const JsonPlace &place, const json &value) override { (this->*read_item_)(place, value); }

    // Checks what can be known only at the end of the file, and resolves the names of materials.
    void finish();

private:
    using ItemReader = void (SceneReader::*)(const JsonPlace &, const json &);

    void camera_item(const JsonPlace &place, const json &value);
    void film_item(const JsonPlace &place, const json &value);
    void render_item(const JsonPlace &place, const json &value);
    void material(const JsonPlace &place, const json &value);
    void sphere(const JsonPlace &place, const json &value);
    void plane(const JsonPlace &place, const json &value);
    std::uint32_t material_number(const JsonPlace &place, const json &name);
    std::vector<std::uint32_t> material_indices() const;

    SceneFile &scene_;
    ItemReader read_item_ = nullptr;
    bool has_camera_ = false;
    bool has_position_ = false;
    bool has_look_at_ = false;

    // Spheres and planes may stand before the materials: names are numbered as they are met and looked up at the end.
    struct UsedName {
        std::string name;
        JsonPath first_place;
    };
    std::vector<UsedName> used_names_;
    std::unordered_map<std::string, std::uint32_t> used_name_numbers_;
};

SceneReader::SceneReader(SceneFile &scene) : scene_(scene) {
    scene_.camera = {};
    scene_.camera.struct_size = sizeof(pt_camera);
    scene_.camera.position[2] = 1.0; // a file without a camera looks from (0, 0, 1) at the origin
}

void SceneReader::begin_section(const JsonPlace &place, json::value_t kind) {
    struct Section {
        std::string_view name;
        json::value_t kind;
        ItemReader read_item;
    };
    static constexpr std::array<Section, 6> sections{{
        {"camera", json::value_t::object, &SceneReader::camera_item},
        {"film", json::value_t::object, &SceneReader::film_item},
        {"render", json::value_t::object, &SceneReader::render_item},
        {"materials", json::value_t::object, &SceneReader::material},
        {"spheres", json::value_t::array, &SceneReader::sphere},
        {"planes", json::value_t::array, &SceneReader::plane},
    }};
    const auto section = std::find_if(sections.begin(), sections.end(),
                                      [&](const Section &candidate) { return candidate.name == place.key; });
    if (section == sections.end()) {
        std::array<std::string_view, sections.size()> known;
        std::transform(sections.begin(), sections.end(), known.begin(), [](const Section &each) { return each.name; });
        refuse_unknown_key(*place.parent, place.key, known);
    }
    if (kind != section->kind) {
        refuse(place, "must be " + json_kind(section->kind) + ", is " + json_kind(kind));
    }
    read_item_ = section->read_item;
    has_camera_ = has_camera_ || place.key == "camera";
}

void SceneReader::camera_item(const JsonPlace &place, const json &value) {
    static constexpr std::array<std::string_view, 5> known{"position", "look_at", "up", "vertical_fov", "shutter"};
    pt_camera &camera = scene_.camera;
    if (place.key == "position") {
        store(read_vector(value, place), camera.position);
        has_position_ = true;
    } else if (place.key == "look_at") {
        store(read_vector(value, place), camera.target);
        has_look_at_ = true;
    } else if (place.key == "up") {
        const auto up = read_vector(value, place);
        if (up == std::array{0.0, 0.0, 0.0}) {
            refuse(place, "must not be [0, 0, 0]"); // pt.h takes it as "default"
        }
        store(up, camera.up);
    } else if (place.key == "vertical_fov") {
        const double degrees = read_number(value, place);
        // The library's rule, [1e-8, pi), in the file's unit; 0 would be pt.h's default.
        if (!(degrees >= 6e-7 && degrees < 180.0)) {
            refuse(place, "must be at least 6e-7 and less than 180 degrees, is " + value.dump());
        }
        camera.vertical_fov = degrees * (std::numbers::pi / 180.0);
    } else if (place.key == "shutter") {
        const auto [open, close] = read_pair(value, place);
        camera.shutter_open = open;
        // pt.h takes [0, 0] as its default, the whole of [0, 1]. Here it is the instant 0, and the smallest number
        // after 0 makes an interval in which nothing moves.
        camera.shutter_close = open == 0.0 && close == 0.0 ? std::numeric_limits<double>::denorm_min() : close;
    } else {
        refuse_unknown_key(*place.parent, place.key, known);
    }
}

void SceneReader::film_item(const JsonPlace &place, const json &value) {
    static constexpr std::array<std::string_view, 5> known{"width", "height", "exposure", "tonemap", "gamma"};
    if (place.key == "width") {
        scene_.width = read_uint32(value, place, 0);
    } else if (place.key == "height") {
        scene_.height = read_uint32(value, place, 0);
    } else if (place.key == "exposure") {
        scene_.exposure = read_exposure(value, place);
    } else if (place.key == "tonemap") {
        const std::string_view name = read_text(value, place);
        scene_.tone_curve = find_tone_curve(name);
        if (!scene_.tone_curve) {
            refuse(place, unknown_name("tone map", name, tone_curve_names));
        }
    } else if (place.key == "gamma") {
        scene_.gamma = read_number(value, place);
        if (!(*scene_.gamma >= least_gamma && *scene_.gamma <= largest_gamma)) {
            refuse(place, "must be a number from 0.1 to 10, is " + value.dump());
        }
    } else {
        refuse_unknown_key(*place.parent, place.key, known);
    }
}

void SceneReader::render_item(const JsonPlace &place, const json &value) {
    static constexpr std::array<std::string_view, 5> known{"max_path_length", "spp", "seed", "sampler", "estimator"};
    if (place.key == "max_path_length") {
        scene_.max_path_length = read_uint32(value, place, 1); // 0 would be pt.h's default
    } else if (place.key == "spp") {
        scene_.sample_count = read_uint32(value, place, 1);
    } else if (place.key == "seed") {
        scene_.seed = read_whole_number(value, place, 0, std::numeric_limits<std::uint64_t>::max());
    } else if (place.key == "sampler") {
        scene_.sampler = read_method(value, place, "sampler", samplers);
    } else if (place.key == "estimator") {
        scene_.estimator = read_method(value, place, "estimator", estimators);
    } else {
        refuse_unknown_key(*place.parent, place.key, known);
    }
}

void SceneReader::material(const JsonPlace &place, const json &value) {
    const JsonObject object(value, place, {"diffuse", "specular", "glossiness", "emission"});
    pt_material material{};
    if (const json *diffuse = object.find("diffuse")) {
        store(read_colour(*diffuse, place.member("diffuse")), material.diffuse);
    }
    if (const json *specular = object.find("specular")) {
        store(read_colour(*specular, place.member("specular")), material.specular);
    }
    if (const json *glossiness = object.find("glossiness")) {
        material.glossiness = read_float(*glossiness, place.member("glossiness"));
    }
    if (const json *emission = object.find("emission")) {
        store(read_colour(*emission, place.member("emission")), material.emission);
    }
    scene_.materials.push_back(material);
    scene_.material_names.emplace_back(place.key);
}

void SceneReader::sphere(const JsonPlace &place, const json &value) {
    const JsonObject object(value, place, {"center", "radius", "material", "motion"});
    pt_sphere sphere{};
    store(read_vector(object.require("center"), place.member("center")), sphere.center);
    sphere.radius = read_number(object.require("radius"), place.member("radius"));
    sphere.material = material_number(place.member("material"), object.require("material"));
    if (const json *motion = object.find("motion")) {
        store(read_vector(*motion, place.member("motion")), sphere.motion);
    }
    scene_.spheres.push_back(sphere);
}

void SceneReader::plane(const JsonPlace &place, const json &value) {
    const JsonObject object(value, place, {"normal", "offset", "material"});
    pt_plane plane{};
    store(read_vector(object.require("normal"), place.member("normal")), plane.normal);
    plane.offset = read_number(object.require("offset"), place.member("offset"));
    plane.material = material_number(place.member("material"), object.require("material"));
    scene_.planes.push_back(plane);
}

std::uint32_t SceneReader::material_number(const JsonPlace &place, const json &name) {
    const auto [entry, fresh] = used_name_numbers_.try_emplace(std::string(read_text(name, place)),
                                                               static_cast<std::uint32_t>(used_names_.size()));
    if (fresh) {
        used_names_.push_back({entry->first, place.path()});
    }
    return entry->second;
}

// used_names_ number -> index into scene_.materials.
std::vector<std::uint32_t> SceneReader::material_indices() const {
    std::unordered_map<std::string_view, std::uint32_t> defined;
    for (const std::string &name : scene_.material_names) {
        defined.emplace(name, static_cast<std::uint32_t>(defined.size()));
    }
    std::vector<std::uint32_t> indices;
    for (const UsedName &used : used_names_) {
        const auto found = defined.find(used.name);
        if (found == defined.end()) {
            const std::vector<std::string_view> known(scene_.material_names.begin(), scene_.material_names.end());
            throw JsonRefusal(used.first_place, unknown_name("material", used.name, known));
        }
        indices.push_back(found->second);
    }
    return indices;
}

void SceneReader::finish() {
    const JsonPlace root;
    if (has_camera_ && !has_position_) {
        refuse(root.member("camera"), "\"position\" is missing");
    }
    if (has_camera_ && !has_look_at_) {
        refuse(root.member("camera"), "\"look_at\" is missing");
    }
    const std::vector<std::uint32_t> indices = material_indices();
    for (pt_sphere &sphere : scene_.spheres) {
        sphere.material = indices[sphere.material];
    }
    for (pt_plane &plane : scene_.planes) {
        plane.material = indices[plane.material];
    }
}

// "scene.json:12: spheres[3].radius", without what is not known.
std::string place_text(const std::string &file, std::optional<std::size_t> line, const std::string &path) {
    std::string text = file;
    if (line) {
        text.append(":").append(std::to_string(*line));
    }
    if (!path.empty()) {
        text.append(": ").append(path);
    }
    return text;
}

// The text that was read, if the file still holds it: one that was edited does not, and a pipe is read once.
std::optional<std::string> read_again(const SceneFile &scene) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(scene.path, ignored)) {
        return std::nullopt;
    }
    try {
        std::string text = read_file(scene.path);
        return hash_of(text) == scene.text_hash ? std::optional(std::move(text)) : std::nullopt;
    } catch (const Failure &) {
        return std::nullopt;
    }
}

// Of what the file calls otherwise; empty if the file does not have it.
JsonPath renamed_path(const FieldName &name) {
    if (name.section.empty()) {
        return {};
    }
    JsonPath path{{std::string(name.section), 0, false}, {std::string(name.key), 0, false}};
    if (name.element) {
        path.push_back({{}, *name.element, true});
    }
    return path;
}

// Of what the file calls as pt.h does, but for materials, which have names there; empty if it is none of the file's.
JsonPath path_of_member(const SceneFile &scene, const BrokenRule &rule) {
    static constexpr std::array<std::string_view, 5> sections{"camera", "render", "materials", "spheres", "planes"};
    if (std::find(sections.begin(), sections.end(), rule.subject) == sections.end()) {
        return {};
    }
    JsonPath path{{rule.subject, 0, false}};
    if (rule.index) {
        const bool is_named = rule.subject == "materials" && *rule.index < scene.material_names.size();
        path.push_back(is_named ? JsonStep{scene.material_names[*rule.index], 0, false}
                                : JsonStep{{}, *rule.index, true});
    }
    path.push_back({rule.member, 0, false});
    return path;
}

JsonPath path_of(const SceneFile &scene, const BrokenRule &rule) {
    const FieldName *name = find_field_name(rule);
    JsonPath path = name != nullptr ? renamed_path(*name) : path_of_member(scene, rule);
    if (!path.empty() && rule.component) {
        path.push_back({{}, *rule.component, true});
    }
    return path;
}

// text: of the file, if it is known.
std::string explain_rule(const SceneFile &scene, const std::optional<std::string> &text, const BrokenRule &rule) {
    const JsonPath path = path_of(scene, rule);
    const auto number = text && !path.empty() ? find_line(*text, path) : std::nullopt;
    return rule_text(place_text(scene.path, number, path.empty() ? field_text(rule) : path_text(path)), rule);
}

} // namespace

pt_scene SceneFile::scene() const {
    pt_scene scene{};
    scene.struct_size = sizeof(pt_scene);
    scene.material_count = static_cast<std::uint32_t>(materials.size());
    scene.sphere_count = static_cast<std::uint32_t>(spheres.size());
    scene.plane_count = static_cast<std::uint32_t>(planes.size());
    scene.materials = materials.data();
    scene.spheres = spheres.data();
    scene.planes = planes.data();
    return scene;
}

std::string SceneFile::explain(const BrokenRule &rule) const {
    return explain_rule(*this, read_again(*this), rule);
}

std::string SceneFile::explain(const LibraryError &error) const {
    if (error.rules.empty()) {
        return path + ": " + error.message;
    }
    const std::optional<std::string> text = read_again(*this);
    return error.in_words([&](const BrokenRule &rule) { return explain_rule(*this, text, rule); });
}

SceneFile parse_scene(std::string_view text, const std::string &path) {
    SceneFile scene{};
    scene.path = path;
    scene.text_hash = hash_of(text);
    SceneReader reader(scene);
    const std::string_view json = require_text(text, path);
    try {
        parse_json_sections(json, path, reader);
        reader.finish();
    } catch (const JsonRefusal &refusal) {
        const auto line = find_line(json, refusal.path, refusal.occurrence);
        throw Failure(ExitCode::scene, place_text(path, line, path_text(refusal.path)) + ": " + refusal.what());
    }
    return scene;
}

SceneFile read_scene_file(const std::string &path) {
    return path == standard_stream ? parse_scene(read_standard_input(), "standard input")
                                   : parse_scene(read_file(path), path);
}

} // namespace cli
