#include "lib/scene_file/scene_schema.h"

#include "lib/scene_file/scene_keys.h"
#include "lib/scene_file/text.h"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace pt {
namespace {

using Schema = nlohmann::ordered_json;
using Form = ValueRule::Form;

Schema any_of(std::initializer_list<Schema> schemas) {
    return {{"anyOf", Schema::array_t(schemas)}};
}

Schema number(const ValueRule &rule) {
    Schema schema{{"type", "number"}};
    if (std::isfinite(rule.largest)) {
        schema["minimum"] = rule.least;
        schema[rule.excludes_largest ? "exclusiveMaximum" : "maximum"] = rule.largest;
    }
    if (!rule.may_be_negative)
        return schema;
    return any_of({{{"const", 0}}, schema, {{"type", "number"}, {"minimum", -rule.largest}, {"maximum", -rule.least}}});
}

Schema array_of(const Schema &element, std::size_t count) {
    return {{"type", "array"}, {"items", element}, {"minItems", count}, {"maxItems", count}};
}

Schema value_of(const ValueRule &rule) {
    switch (rule.form) {
    case Form::whole_number:
        return {{"type", "integer"},
                {"minimum", static_cast<std::uint64_t>(rule.least)},
                {"maximum", largest_whole_number(rule)}};
    case Form::number_or_auto:
        return any_of({number(rule), {{"const", "auto"}}});
    case Form::boolean:
        return {{"type", "boolean"}};
    case Form::text:
        return {{"type", "string"}};
    case Form::name:
        return {{"enum", rule.names}};
    case Form::color:
        return any_of({number(rule), array_of(number(rule), 3)});
    case Form::numbers: {
        Schema array = array_of(number(rule), rule.count);
        if (rule.excludes_zeros)
            array["not"] = {{"items", {{"const", 0}}}};
        return array;
    }
    case Form::number:
        break;
    }
    return number(rule);
}

// With of_many, the center must be a file, and other properties may be files.
Schema object_of(const SceneSection &section, bool of_many) {
    const Schema file{{"type", "string"}, {"minLength", 1}};
    Schema schema{{"type", "object"}, {"additionalProperties", false}};
    for (const SceneKey &key : section.keys) {
        const bool is_file = of_many && key.name == "center";
        Schema value = is_file                            ? file
                       : of_many && key.column != nullptr ? any_of({value_of(key.rule), file})
                                                          : value_of(key.rule);
        const std::string words(is_file ? "NPY file with one for each of many spheres" : key.words);
        const std::string initial = key.initial.empty() ? "" : "; default: " + std::string(key.initial);
        if (!words.empty())
            value["description"] = words + initial;
        schema["properties"][std::string(key.name)] = std::move(value);
        if (key.is_required)
            schema["required"].push_back(key.name);
    }
    return schema;
}

Schema section_schema(const SceneSection &section) {
    const Schema object = object_of(section, false);
    Schema schema;
    switch (section.form) {
    case SectionForm::members:
        schema = object;
        break;
    case SectionForm::objects:
        schema = {{"type", "object"}, {"additionalProperties", object}};
        break;
    case SectionForm::array:
        schema = {{"type", "array"},
                  {"items", section.may_be_many() ? any_of({object, object_of(section, true)}) : object}};
        break;
    }
    schema["description"] = section.words;
    return schema;
}

Schema animation() {
    const Schema any_number{{"type", "number"}};
    const Schema value = any_of({any_number, {{"type", "array"}, {"items", any_number}}});
    const Schema frame = value_of(natural_number);
    const Schema key{{"type", "array"}, {"items", {frame, value}}, {"minItems", 2}, {"maxItems", 2}};
    std::vector<std::string> names;
    for (const SceneSection &section : scene_sections())
        if (section.may_move())
            names.emplace_back(section.name);
    return {{"description", "Key frames, [frame, value] each, of values by their paths like camera.position"},
            {"type", "object"},
            {"propertyNames", {{"pattern", "^(" + listed(names, "|") + ")[.[]"}}},
            {"additionalProperties", {{"type", "array"}, {"items", key}, {"minItems", 1}}}};
}

} // namespace

std::string scene_schema() {
    Schema schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
                  {"title", "Scene of pt"},
                  {"type", "object"},
                  {"additionalProperties", false}};
    for (const SceneSection &section : scene_sections())
        schema["properties"][std::string(section.name)] = section_schema(section);
    schema["properties"]["animation"] = animation();
    return schema.dump(2) + "\n";
}

} // namespace pt
