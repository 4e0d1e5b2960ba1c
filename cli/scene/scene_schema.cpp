#include "cli/scene/scene_schema.h"

#include "cli/base/method_names.h"
#include "cli/image/exposure.h"
#include "cli/image/tone_map.h"
#include "cli/scene/camera_section.h"

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace cli {
namespace {

using Schema = nlohmann::ordered_json;

// Of lengths, and of their squares in float32.
constexpr double least_length = 1e-18;
constexpr double largest_length = 1e18;

Schema described(const std::string &description, Schema schema) {
    schema["description"] = description;
    return schema;
}

Schema number(double least, double largest) {
    return {{"type", "number"}, {"minimum", least}, {"maximum", largest}};
}

Schema whole_number(std::uint64_t least, std::uint64_t largest) {
    return {{"type", "integer"}, {"minimum", least}, {"maximum", largest}};
}

Schema one_of(std::span<const std::string_view> names) {
    return {{"enum", names}};
}

Schema array_of(const Schema &element, int count) {
    return {{"type", "array"}, {"items", element}, {"minItems", count}, {"maxItems", count}};
}

Schema not_zero(Schema vector) {
    vector["not"] = {{"items", {{"const", 0}}}};
    return vector;
}

Schema object(Schema properties, Schema required = Schema::array()) {
    Schema schema{{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
    if (!required.empty())
        schema["required"] = std::move(required);
    return schema;
}

Schema length() {
    return {{"anyOf", {{{"const", 0}}, number(least_length, largest_length), number(-largest_length, -least_length)}}};
}

Schema vector() {
    return array_of(length(), 3);
}

Schema direction() {
    return not_zero(array_of({{"type", "number"}}, 3));
}

Schema colour() {
    return {{"anyOf", {number(0.0, largest_length), array_of(number(0.0, largest_length), 3)}}};
}

// Of light that is reflected.
Schema share_colour() {
    return {{"anyOf", {number(0.0, 1.0), array_of(number(0.0, 1.0), 3)}}};
}

Schema camera() {
    const Schema time = number(0.0, 1.0);
    return described(
        "Where the picture is seen from",
        object({{"position", described("Where it is", vector())},
                {"look_at", described("The point in the middle of the picture", vector())},
                {"up", described("What is up in the picture; default [0, 1, 0]", direction())},
                {"projection", described("Default perspective", one_of(projection_names))},
                {"vertical_fov", described("Angle of the picture's height in degrees; default 45",
                                           {{"type", "number"}, {"minimum", 6e-7}, {"exclusiveMaximum", 180}})},
                {"vertical_extent", described("Height of the view of an orthographic projection, in scene units",
                                              number(least_length, largest_length))},
                {"shutter", described("When it opens and closes; default [0, 1]", array_of(time, 2))}},
               {"position", "look_at"}));
}

Schema film() {
    const Schema side = whole_number(1, std::numeric_limits<std::uint32_t>::max());
    const Schema exposure{{"anyOf", {number(-largest_exposure, largest_exposure), {{"const", "auto"}}}}};
    return described(
        "The picture",
        object({{"width", described("Pixels; default 512", side)},
                {"height", described("Pixels; default 512", side)},
                {"exposure", described("Stops, or auto; default auto", exposure)},
                {"tonemap", described("Curve from radiance to light; default none", one_of(tone_curve_names))},
                {"gamma", described("Encode with the power 1 / gamma; default: the sRGB curve",
                                    number(least_gamma, largest_gamma))}}));
}

Schema render() {
    constexpr std::uint64_t most_samples = std::numeric_limits<std::uint32_t>::max();
    return described(
        "How the picture is made",
        object({{"max_path_length", described("Surfaces that light meets; default 6", whole_number(1, 1024))},
                {"spp", described("Samples per pixel; default 64", whole_number(1, most_samples))},
                {"seed", described("Chooses the random numbers; default 0",
                                   whole_number(0, std::numeric_limits<std::uint64_t>::max()))},
                {"sampler", described("Where the points of samples come from; default best", one_of(samplers.names()))},
                {"estimator", described("How light is looked for; default best", one_of(estimators.names()))}}));
}

Schema materials() {
    const Schema material =
        object({{"diffuse", described("Share of the light that is scattered evenly; default 0", colour())},
                {"specular", described("Weight of the lobe about the mirror direction; default 0", colour())},
                {"glossiness", described("The lobe's exponent; default 0", number(0.0, 1e9))},
                {"emission", described("Light of its own, a radiance; default 0", colour())},
                {"hidden_from_camera",
                 described("Whether the camera looks through it; default false", {{"type", "boolean"}})}});
    return {{"description", "By their names"}, {"type", "object"}, {"additionalProperties", material}};
}

Schema list_of(const std::string &description, const Schema &element) {
    return {{"description", description}, {"type", "array"}, {"items", element}};
}

Schema spheres() {
    const auto or_file = [](const Schema &value) {
        return Schema{{"anyOf", {value, {{"type", "string"}, {"minLength", 1}}}}};
    };
    const Schema radius = number(least_length, largest_length);
    const auto sphere = [&](const std::string &center_text, const Schema &center, const auto &column) {
        return object({{"center", described(center_text, center)},
                       {"radius", column(radius)},
                       {"material", {{"type", "string"}}},
                       {"motion", described("Way from time 0 to time 1; default [0, 0, 0]", column(vector()))},
                       {"color", described("Multiplies the material's diffuse; default 1", column(share_colour()))}},
                      {"center", "radius", "material"});
    };
    const Schema one = sphere("At time 0", vector(), [](const Schema &value) { return value; });
    const Schema many =
        sphere("NPY file with one for each of many spheres", {{"type", "string"}, {"minLength", 1}}, or_file);
    return list_of("Hollow, and seen from both sides", {{"anyOf", {one, many}}});
}

Schema planes() {
    return list_of("Where dot(normal, x) + offset = 0", object({{"normal", described("Of any length", direction())},
                                                                {"offset", {{"type", "number"}}},
                                                                {"material", {{"type", "string"}}}},
                                                               {"normal", "offset", "material"}));
}

Schema animation() {
    const Schema any_number{{"type", "number"}};
    const Schema value{{"anyOf", {any_number, {{"type", "array"}, {"items", any_number}}}}};
    const Schema frame = whole_number(0, std::numeric_limits<std::uint32_t>::max());
    const Schema key{{"type", "array"}, {"items", {frame, value}}, {"minItems", 2}, {"maxItems", 2}};
    return {{"description", "Key frames, [frame, value] each, of values by their paths like camera.position"},
            {"type", "object"},
            {"propertyNames", {{"pattern", "^(camera|materials|spheres|planes)[.[]"}}},
            {"additionalProperties", {{"type", "array"}, {"items", key}, {"minItems", 1}}}};
}

} // namespace

nlohmann::ordered_json scene_schema() {
    Schema schema = object({{"camera", camera()},
                            {"film", film()},
                            {"render", render()},
                            {"materials", materials()},
                            {"spheres", spheres()},
                            {"planes", planes()},
                            {"animation", animation()}});
    schema["$schema"] = "http://json-schema.org/draft-07/schema#";
    schema["title"] = "Scene of pt";
    return schema;
}

} // namespace cli
