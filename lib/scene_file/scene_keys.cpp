#include "lib/scene_file/scene_keys.h"

#include "lib/scene/view_sizes.h"
#include "lib/scene_file/enumerations.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numbers>

namespace pt {
namespace {

using nlohmann::json;
using Item = SceneItem &;
using Value = const json &;
using Form = ValueRule::Form;

constexpr double least_length = 1e-18;
constexpr double largest_length = 1e18;

constexpr ValueRule lengths{.form = Form::numbers,
                            .least = least_length,
                            .largest = largest_length,
                            .may_be_negative = true,
                            .is_of_library = true,
                            .count = 3};
constexpr ValueRule direction{.form = Form::numbers, .excludes_zeros = true, .count = 3};
constexpr ValueRule times{.form = Form::numbers, .least = 0.0, .largest = 1.0, .is_of_library = true, .count = 2};
constexpr ValueRule radiance{.form = Form::color, .least = 0.0, .largest = largest_length, .is_of_library = true};
constexpr ValueRule share{.form = Form::color, .least = 0.0, .largest = 1.0, .is_of_library = true};
constexpr ValueRule opacity_share{.least = 0.0, .largest = 1.0, .is_of_library = true};
constexpr ValueRule distance{.least = 0.0, .largest = largest_length, .is_of_library = true};
constexpr ValueRule radius{.least = least_length, .largest = largest_length, .is_of_library = true};
constexpr ValueRule white_point{.form = Form::numbers, .least = 1e-3, .largest = 1e3, .count = 3};
constexpr ValueRule boolean{.form = Form::boolean};
constexpr ValueRule material_name{.form = Form::text};

constexpr ValueRule number(double least, double largest) {
    return {.least = least, .largest = largest};
}

constexpr ValueRule whole_number(double least, double largest) {
    return {.form = Form::whole_number, .least = least, .largest = largest};
}

constexpr ValueRule one_of(std::string_view kind, std::span<const std::string_view> names) {
    return {.form = Form::name, .kind = kind, .names = names};
}

constexpr ViewSize widest_angle = widest_view(&pt_camera::vertical_fov);

constexpr double largest_uint32 = std::numeric_limits<std::uint32_t>::max();
constexpr double largest_uint64 = 0x1p64;

template <typename Numbers>
void put(Value value, Numbers &target) {
    for (std::size_t i = 0; i < std::size(target); ++i)
        (value.is_array() ? value[i] : value).get_to(target[i]);
}

constexpr bool required = true;
constexpr bool optional = false;

constexpr std::array camera_keys{
    SceneKey{"position", lengths, "Position", "", required,
             [](Item item, Value value) { put(value, item.scene.camera.position); }},
    SceneKey{"look_at", lengths, "Middle of the picture", "", required,
             [](Item item, Value value) { put(value, item.scene.camera.target); }},
    SceneKey{"up", direction, "Upward direction", "[0, 1, 0]", optional,
             [](Item item, Value value) { put(value, item.scene.camera.up); }},
    SceneKey{"projection", one_of("projection", projections.names()), "Rays from position, or parallel rays",
             "perspective", optional,
             [](Item item, Value value) {
                 item.scene.camera.projection = projections.find(value.get_ref<const std::string &>()).value();
             }},
    // From 1e-8 radians. libpt would take 0 as the default.
    SceneKey{"vertical_fov",
             {.least = 6e-7,
              .largest = widest_angle.largest * (180.0 / std::numbers::pi),
              .excludes_largest = widest_angle.excludes_largest,
              .unit = "degrees"},
             "Vertical angle of view (perspective)",
             "45",
             optional,
             [](Item item, Value value) {
                 item.scene.camera.vertical_fov = value.get<double>() * (std::numbers::pi / 180.0);
             }},
    SceneKey{"vertical_extent", number(least_length, largest_length),
             "Height of the view (orthographic); surfaces behind position are not seen", "", optional,
             [](Item item, Value value) { item.scene.camera.vertical_extent = value.get<double>(); }},
    SceneKey{"aperture", distance, "Diameter of the lens (perspective)", "0", optional,
             [](Item item, Value value) { item.scene.camera.aperture = value.get<double>(); }},
    SceneKey{"focus", distance, "Depth in focus; 0: the depth of look_at", "0", optional,
             [](Item item, Value value) { item.scene.camera.focus = value.get<double>(); }},
    SceneKey{"shutter", times, "Times of opening and closing", "[0, 1]", optional,
             [](Item item, Value value) {
                 std::tie(item.scene.camera.shutter_open, item.scene.camera.shutter_close) =
                     value.get<std::pair<double, double>>();
             }},
};

constexpr std::array film_keys{
    SceneKey{"width", whole_number(1, largest_uint32), "Width", "512", optional,
             [](Item item, Value value) { item.scene.render.width = value.get<std::uint32_t>(); }},
    SceneKey{"height", whole_number(1, largest_uint32), "Height", "512", optional,
             [](Item item, Value value) { item.scene.render.height = value.get<std::uint32_t>(); }},
    SceneKey{"exposure",
             {.form = Form::number_or_auto, .least = -64.0, .largest = 64.0, .unit = "stops"},
             "Brightness",
             "auto",
             optional,
             [](Item item, Value value) {
                 item.scene.display.automatic_exposure = value.is_number() ? 0 : 1;
                 item.scene.display.exposure = value.is_number() ? value.get<double>() : 0.0;
             },
             "--exposure"},
    SceneKey{"tonemap", one_of("tone map", curves.names()), "Curve from radiance to light", "none", optional,
             [](Item item, Value value) {
                 item.scene.display.curve = curves.find(value.get_ref<const std::string &>()).value();
             },
             "--tonemap"},
    SceneKey{"gamma", number(0.1, 10.0), "Power 1 / gamma instead of the sRGB curve", "the sRGB curve", optional,
             [](Item item, Value value) { item.scene.display.gamma = value.get<double>(); }, "--gamma"},
    SceneKey{"white", white_point, "Light shown as grey", "[1, 1, 1]", optional,
             [](Item item, Value value) { put(value, item.scene.display.white); }, "--white"},
};

constexpr std::array render_keys{
    SceneKey{"max_path_length", whole_number(1, 1024),
             "Most surfaces on a path to the camera: 1 shows only lamps, 2 adds direct light", "6", optional,
             [](Item item, Value value) { item.scene.render.max_path_length = value.get<std::uint32_t>(); },
             "--max-path-length"},
    SceneKey{"spp", whole_number(1, largest_uint32), "Samples per pixel", "64", optional,
             [](Item item, Value value) { item.scene.sample_count = value.get<std::uint32_t>(); }, "--spp"},
    SceneKey{"seed", whole_number(0, largest_uint64), "Chooses the random numbers", "0", optional,
             [](Item item, Value value) { item.scene.render.seed = value.get<std::uint64_t>(); }, "--seed"},
    SceneKey{"sampler", one_of("sampler", samplers.names()), "Source of sample points", "best", optional,
             [](Item item, Value value) {
                 item.scene.render.sampler = samplers.find(value.get_ref<const std::string &>()).value();
             },
             "--sampler"},
    SceneKey{"estimator", one_of("estimator", estimators.names()), "How paths find light", "best", optional,
             [](Item item, Value value) {
                 item.scene.render.estimator = estimators.find(value.get_ref<const std::string &>()).value();
             },
             "--estimator"},
};

constexpr std::array material_keys{
    SceneKey{"diffuse", radiance, "Fraction of light that is reflected diffusely", "0", optional,
             [](Item item, Value value) { put(value, item.material.diffuse); }},
    SceneKey{"specular", radiance,
             "Weight of the lobe about the mirror direction; a sum with diffuse above 1 adds light", "0", optional,
             [](Item item, Value value) { put(value, item.material.specular); }},
    SceneKey{"glossiness",
             {.least = 0.0, .largest = 1e9, .is_of_library = true, .is_float = true},
             "The lobe's exponent",
             "0",
             optional,
             [](Item item, Value value) { item.material.glossiness = value.get<float>(); }},
    SceneKey{"emission", radiance, "Emitted light, the same in all directions", "0", optional,
             [](Item item, Value value) { put(value, item.material.emission); }},
    SceneKey{
        "hidden_from_camera", boolean,
        "Only camera rays pass through: for invisible lamps, or a wall in front of a room", "false", optional,
        [](Item item, Value value) { item.material.flags = value.get<bool>() ? PT_MATERIAL_HIDDEN_FROM_CAMERA : 0; }},
};

template <auto member, pt_column pt_sphere_array::*column>
constexpr SceneKey column_key(std::string_view name, const ValueRule &rule, std::string_view words,
                              std::string_view initial, bool is_required) {
    const auto store = [](Item item, Value value) { put(value, item.sphere.*member); };
    return {name, rule, words, initial, is_required, store, "", column};
}

constexpr SceneKey radius_key =
    column_key<&SphereItem::radius, &pt_sphere_array::radius>("radius", radius, "", "", required);
constexpr SceneKey color_key = column_key<&SphereItem::color, &pt_sphere_array::color>(
    "color", share, "Multiplies the material's diffuse", "1", optional);
constexpr SceneKey opacity_key = column_key<&SphereItem::opacity, &pt_sphere_array::opacity>(
    "opacity", opacity_share, "Probability that a ray hits it", "1", optional);
constexpr SceneKey material_key{
    "material", material_name,
    "Name",     "",
    required,   [](Item item, Value value) { item.material_name = value.get_ref<const std::string &>(); }};

constexpr std::array sphere_keys{
    column_key<&SphereItem::center, &pt_sphere_array::center>("center", lengths, "Position at time 0", "", required),
    radius_key,
    material_key,
    column_key<&SphereItem::motion, &pt_sphere_array::motion>("motion", lengths, "Displacement from time 0 to time 1",
                                                              "[0, 0, 0]", optional),
    color_key,
    opacity_key};

constexpr std::array capsule_keys{
    column_key<&SphereItem::center, &pt_sphere_array::center>("center", lengths, "One end", "", required),
    column_key<&SphereItem::end, &pt_sphere_array::end>("end", lengths, "The other end", "", required),
    radius_key,
    material_key,
    color_key,
    opacity_key};

constexpr std::array plane_keys{
    SceneKey{"normal", direction, "Normal of any length", "", required,
             [](Item item, Value value) { put(value, item.plane.normal); }},
    SceneKey{"offset", ValueRule{}, "Offset", "", required,
             [](Item item, Value value) { item.plane.offset = value.get<double>(); }},
    material_key,
};

constexpr std::array<SceneSection, 7> sections{{
    {"camera", SectionForm::members, "A pinhole, a thin lens, or parallel rays", camera_keys},
    {"film", SectionForm::members, "The picture", film_keys},
    {"render", SectionForm::members, "The sampling", render_keys},
    {"materials", SectionForm::objects, "Materials by name", material_keys},
    {"spheres", SectionForm::array, "Spheres, of which both sides are visible, reflect and emit", sphere_keys},
    {"capsules", SectionForm::array, "Spheres swept along a segment; they neither emit nor move", capsule_keys},
    {"planes", SectionForm::array, "Planes of the points x with dot(normal, x) + offset = 0", plane_keys},
}};

template <typename Named>
const Named *find_named(std::span<const Named> all, std::string_view name) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Named &each) { return each.name == name; });
    return found == all.end() ? nullptr : &*found;
}

} // namespace

bool SceneSection::may_be_many() const {
    return std::ranges::any_of(keys, [](const SceneKey &key) { return key.column != nullptr; });
}

std::span<const SceneSection> scene_sections() {
    return sections;
}

const SceneSection *find_section(std::string_view name) {
    return find_named<SceneSection>(sections, name);
}

const SceneKey *find_key(const SceneSection &section, std::string_view name) {
    return find_named(section.keys, name);
}

std::vector<std::string_view> key_names(const SceneSection &section) {
    std::vector<std::string_view> names;
    for (const SceneKey &key : section.keys)
        names.push_back(key.name);
    return names;
}

} // namespace pt
