#include "lib/render/film_identity.h"

#include "lib/base/digest.h"
#include "lib/base/error.h"
#include "lib/base/rules.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace pt {

namespace {

std::string digest_of(const Camera &camera) {
    Digest digest;
    for (const glm::dvec3 &vector : {camera.position, camera.right, camera.up, camera.forward})
        digest.add(vector);
    for (const double number : {camera.tan_half_fov, camera.shutter_open, camera.shutter_close})
        digest.add(number);
    return digest.text();
}

// Printable ASCII, as a film's header is.
std::string printable(std::string text) {
    std::ranges::replace_if(
        text, [](char letter) { return letter < ' ' || letter > '~'; }, '?');
    return text;
}

// Each model once.
std::string text_of(const std::vector<pt_device_info> &devices) {
    std::set<std::string> models;
    for (const pt_device_info &device : devices)
        models.insert(printable(std::string(device.name) + ", " + device.driver));
    std::string text;
    for (const std::string &model : models)
        text += (text.empty() ? "" : " and ") + model;
    return text;
}

} // namespace

FilmIdentity identity_of(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings,
                         const KernelCode &code, const std::vector<pt_device_info> &devices) {
    return {{"scene", scene.digest()},
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
}

void require_same(const FilmIdentity &film, const FilmIdentity &context) {
    Violations violations;
    const auto value_in = [](const FilmIdentity &identity, const std::string &name) {
        const auto fact = std::ranges::find(identity, name, &FilmFact::name);
        return fact == identity.end() ? std::string("nothing") : fact->value;
    };
    for (const FilmFact &fact : context)
        if (const std::string value = value_in(film, fact.name); value != fact.value)
            violations.add({.subject = "film",
                            .member = fact.name,
                            .value = value,
                            .rule = "must be " + fact.value + ", as in this context"});
    for (const FilmFact &fact : film)
        if (std::ranges::find(context, fact.name, &FilmFact::name) == context.end())
            violations.add({.subject = "film", .member = fact.name, .value = fact.value, .rule = "must not be there"});
    violations.throw_if_any(PT_ERROR_INCOMPATIBLE);
    if (film != context)
        throw Error(PT_ERROR_INCOMPATIBLE, "film: lines of its header are repeated, or in another order");
}

} // namespace pt
