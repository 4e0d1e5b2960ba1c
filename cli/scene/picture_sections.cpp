#include "cli/scene/picture_sections.h"

#include "cli/base/method_names.h"
#include "cli/base/suggestion.h"

#include <array>
#include <limits>
#include <string>
#include <string_view>

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
    if (!method)
        refuse(place, unknown_name(kind, name, methods.names()));
    return *method;
}

Exposure read_exposure(const json &value, const JsonPlace &place) {
    const bool is_text = value.is_string();
    const auto exposure = parse_exposure(is_text ? std::string(read_text(value, place)) : value.dump());
    if (!exposure || (is_text && exposure->stops))
        refuse(place, "must be a number from -64 to 64, or \"auto\", is " + value.dump());
    return *exposure;
}

} // namespace

void read_film_item(SceneFile &scene, const JsonPlace &place, const json &value) {
    static constexpr std::array<std::string_view, 5> known{"width", "height", "exposure", "tonemap", "gamma"};
    if (place.key == "width") {
        scene.width = read_uint32(value, place, 0);
    } else if (place.key == "height") {
        scene.height = read_uint32(value, place, 0);
    } else if (place.key == "exposure") {
        scene.exposure = read_exposure(value, place);
    } else if (place.key == "tonemap") {
        const std::string_view name = read_text(value, place);
        scene.tone_curve = find_tone_curve(name);
        if (!scene.tone_curve)
            refuse(place, unknown_name("tone map", name, tone_curve_names));
    } else if (place.key == "gamma") {
        scene.gamma = read_number(value, place);
        if (!(*scene.gamma >= least_gamma && *scene.gamma <= largest_gamma))
            refuse(place, "must be a number from 0.1 to 10, is " + value.dump());
    } else {
        refuse_unknown_key(*place.parent, place.key, known);
    }
}

void read_render_item(SceneFile &scene, const JsonPlace &place, const json &value) {
    static constexpr std::array<std::string_view, 5> known{"max_path_length", "spp", "seed", "sampler", "estimator"};
    if (place.key == "max_path_length")
        scene.max_path_length = read_uint32(value, place, 1); // 0 would be pt.h's default
    else if (place.key == "spp")
        scene.sample_count = read_uint32(value, place, 1);
    else if (place.key == "seed")
        scene.seed = read_whole_number(value, place, 0, std::numeric_limits<std::uint64_t>::max());
    else if (place.key == "sampler")
        scene.sampler = read_method(value, place, "sampler", samplers);
    else if (place.key == "estimator")
        scene.estimator = read_method(value, place, "estimator", estimators);
    else
        refuse_unknown_key(*place.parent, place.key, known);
}

} // namespace cli
