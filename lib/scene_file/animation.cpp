#include "lib/scene_file/animation.h"

#include "lib/scene_file/scene_file.h"
#include "lib/scene_file/scene_keys.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pt {
namespace {

using nlohmann::json;

bool can_move(const JsonPath &path) {
    const SceneSection *section = find_section(path[0].key);
    if (section == nullptr || !section->may_move() || path.back().in_array)
        return false;
    if (section->form == SectionForm::members)
        return path.size() == 2 && path[1].key != "shutter";
    return path.size() == 3 && path[1].in_array == (section->form == SectionForm::array);
}

KeyFrame read_key_frame(const json &value, const JsonPlace &place, AnimatedValue &animated) {
    constexpr ValueRule number{};
    if (!value.is_array() || value.size() != 2)
        refuse(place, "must be [frame, value]");
    check(natural_number, value[0], place.element(0));
    KeyFrame key{value[0].get<std::uint32_t>(), {}};
    const JsonPlace second = place.element(1);
    animated.is_array = value[1].is_array();
    const json numbers = animated.is_array ? value[1] : json::array({value[1]});
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        check(number, numbers[i], animated.is_array ? second.element(i) : second);
        key.numbers.push_back(numbers[i].get<double>());
    }
    return key;
}

json json_of(const AnimatedValue &value, const std::vector<double> &numbers) {
    return value.is_array ? json(numbers) : json(numbers.front());
}

bool is_center(const JsonPath &path) {
    return path[0].key == "spheres" && path[2].key == "center";
}

json way_of(const AnimatedValue &value, std::uint32_t frame) {
    const std::vector<double> begin = value.at(frame);
    std::vector<double> way = value.at(frame + 1.0);
    std::transform(way.begin(), way.end(), begin.begin(), way.begin(),
                   [](double to, double from) { return to - from; });
    return way;
}

} // namespace

std::vector<double> AnimatedValue::at(double time) const {
    const auto next = std::find_if(keys.begin(), keys.end(), [time](const KeyFrame &key) { return key.frame > time; });
    if (next == keys.begin() || next == keys.end())
        return next == keys.begin() ? keys.front().numbers : keys.back().numbers;
    const KeyFrame &before = *(next - 1);
    const double share = (time - before.frame) / (next->frame - before.frame);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < before.numbers.size(); ++i)
        numbers.push_back(std::lerp(before.numbers[i], next->numbers[i], share));
    return numbers;
}

AnimatedValue read_animated_value(const JsonPlace &place, const json &value) {
    const std::string name(place.key);
    const auto parsed = parse_path(name);
    if (!parsed || !parsed->rest.empty() || !can_move(parsed->path)) {
        refuse(place,
               "the name must be a key of the camera (except its shutter), of a material or of a surface, such as "
               "camera.position or spheres[0].center");
    }
    if (!value.is_array() || value.empty())
        refuse(place, "must be an array of key frames, [frame, value] each");
    AnimatedValue animated{name, parsed->path, false, {}};
    for (std::size_t i = 0; i < value.size(); ++i) {
        const JsonPlace element = place.element(i);
        const bool was_array = animated.is_array;
        animated.keys.push_back(read_key_frame(value[i], element, animated));
        if (i == 0)
            continue;
        const KeyFrame &before = animated.keys[i - 1];
        if (animated.is_array != was_array || animated.keys[i].numbers.size() != before.numbers.size())
            refuse(element.element(1), "must have as many numbers as the previous key frame");
        if (animated.keys[i].frame <= before.frame)
            refuse(element.element(0), "must be later than the previous key frame");
    }
    return animated;
}

std::vector<SceneOverride> overrides_of_frame(const SceneFile &scene, std::uint32_t frame) {
    const double middle = 0.5 * (scene.camera.shutter_open + scene.camera.shutter_close);
    std::vector<SceneOverride> overrides;
    for (const AnimatedValue &value : scene.animation) {
        const std::string source = scene.path + ": animation[\"" + value.name + "\"] in frame " + std::to_string(frame);
        const auto put = [&](const JsonPath &path, const json &number) {
            overrides.push_back({path, number, source, PT_ERROR_INVALID_SCENE});
        };
        if (is_center(value.path)) {
            JsonPath motion = value.path;
            motion.back().key = "motion";
            put(value.path, json_of(value, value.at(frame)));
            put(motion, way_of(value, frame));
        } else {
            put(value.path, json_of(value, value.at(frame + middle)));
        }
    }
    return overrides;
}

SceneFile scene_in_frame(const SceneFile &scene, std::uint32_t frame) {
    if (scene.animation.empty())
        throw Error(PT_ERROR_INVALID_SCENE, scene.path + ": has no animation, and therefore no frames");
    std::vector<SceneOverride> overrides = overrides_of_frame(scene, frame);
    overrides.insert(overrides.end(), scene.overrides.begin(), scene.overrides.end());
    SceneFile in_frame = scene_of_text(scene.text, scene.path, std::move(overrides));
    in_frame.render.seed += frame;
    return in_frame;
}

} // namespace pt
