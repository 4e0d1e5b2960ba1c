#include "lib/render/film_identity.h"

#include "lib/view/camera_rules.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

namespace pt {

namespace {

std::string printable(std::string text) {
    std::ranges::replace_if(
        text, [](char letter) { return letter < ' ' || letter > '~'; }, '?');
    return text;
}

// llvmpipe's name has the width of its vectors, which does not change the bits.
std::string without_vector_width(std::string name) {
    const std::size_t end = name.rfind(" bits)");
    const std::size_t start = name.rfind(", ", end);
    if (name.starts_with("llvmpipe") && end != std::string::npos && start != std::string::npos)
        name.erase(start, end + std::string_view(" bits").size() - start);
    return name;
}

std::string text_of(const std::vector<pt_device_info> &devices) {
    std::set<std::string> models;
    for (const pt_device_info &device : devices)
        models.insert(printable(without_vector_width(device.name) + ", " + device.driver));
    std::string text;
    for (const std::string &model : models)
        text += (text.empty() ? "" : " and ") + model;
    return text;
}

} // namespace

FilmIdentity identity_of(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings,
                         const KernelCode &code, const std::vector<pt_device_info> &devices) {
    FilmIdentity identity{{"scene", scene.digest()},
                          {"camera", digest_of(camera)},
                          {"width", std::to_string(settings.width)},
                          {"height", std::to_string(settings.height)},
                          {"max_path_length", std::to_string(settings.max_path_length)},
                          {"seed", std::to_string(settings.seed)},
                          {"estimator", std::to_string(settings.estimator)},
                          {"sampler", std::to_string(settings.sampler)},
                          {"unit_exponent", std::to_string(std::ilogb(scene.film_unit))},
                          {"estimator_version", std::to_string(estimator_version)},
                          {"kernel", digest_of(code)},
                          {"device", text_of(devices)}};
    if (settings.coverage)
        identity.insert(std::ranges::find(identity, "unit_exponent", &FilmFact::name), {"coverage", "1"});
    return identity;
}

} // namespace pt
