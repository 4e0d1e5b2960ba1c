#include "lib/view/displacement.h"

#include "lib/base/rules.h"
#include "lib/view/projection.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace pt {

namespace {

// In units of length + radius.
constexpr double rounding_of_capsules = 0x1p-21;
// In units of the radius. The last bits of the radius's float32 are the opacity.
constexpr double rounding_of_radii = 0.5 * (gpu::TREE_OPACITY_STEPS + 1) * 0x1p-23;

// Largest displacements by rounding, in scene units.
struct Losses {
    double of_center;
    double of_radius;
    double of_capsule;

    double all() const { return of_center + of_radius + of_capsule; }
};

Losses losses_of(const SphereTree *tree, double length, double radius) {
    const double half_diagonal = 0.5 * std::sqrt(3.0);
    return {tree ? half_diagonal * tree->grid().step : 0.0,
            tree && tree->has_opacities() ? rounding_of_radii * radius : 0.0,
            length > 0.0 ? rounding_of_capsules * (length + radius) : 0.0};
}

Losses losses_of(const SphereTree *tree, const MovingBall &surface) {
    return losses_of(tree, surface.kind != Kind::ball ? glm::length(surface.way) : 0.0, surface.radius);
}

class PixelSides {
public:
    explicit PixelSides(const Projection &projection) : projection_(projection) {}

    // Returns a lower bound, or infinity if the ball is out of view.
    double nearest(const MovingBall &ball) const { return at(projection_.least_depth(ball)); }

    // Returns a lower bound. Long capsules and motions are halved until the parts are short or far away. A camera
    // inside a ball sees the ball's wall.
    double of_surface(const MovingBall &surface) const {
        const double depth = projection_.least_depth(surface);
        const double smallest = projection_.pixel_side(0.0); // positive for parallel rays
        const double short_way =
            smallest > 0.0 ? smallest * projection_.height() : 0.25 * std::max(surface.radius, depth);
        if (depth == out_of_view || glm::length(surface.way) <= short_way)
            return at(std::max(depth, std::abs(surface.radius - least_distance(surface.open, surface.way))));
        const glm::dvec3 half = 0.5 * surface.way;
        const double first = of_surface({surface.open, half, surface.radius});
        if (first <= smallest)
            return first;
        return std::min(first, of_surface({surface.open + half, half, surface.radius}));
    }

private:
    double at(double depth) const { return depth == out_of_view ? out_of_view : projection_.pixel_side(depth); }

    const Projection &projection_;
};

std::string short_text(double number) {
    std::array<char, 32> text{};
    return {text.data(),
            std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::general, 4).ptr};
}

std::string short_text(const glm::dvec3 &vector) {
    return '(' + short_text(vector.x) + ", " + short_text(vector.y) + ", " + short_text(vector.z) + ')';
}

glm::dvec3 without_less_than(double rounding, const glm::dvec3 &vector) {
    return glm::mix(vector, glm::dvec3(0.0), glm::lessThanEqual(glm::abs(vector), glm::dvec3(rounding)));
}

struct Displaced {
    double pixels;
    SpherePlace place;
    MovingBall surface;
    Losses losses;
};

Displaced most_displaced(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings) {
    const std::unique_ptr<Projection> projection = projection_of(camera, settings.width, settings.height);
    const PixelSides sides(*projection);
    Displaced most{0.0, {}, {}, {}};
    const auto take = [&](const SpherePlace &place, const MovingBall &surface, const SphereTree *tree) {
        const Losses losses = losses_of(tree, surface);
        const double pixels = losses.all() / sides.of_surface(surface);
        if (pixels > most.pixels)
            most = {pixels, place, surface, losses};
    };
    const std::vector<Sphere> &spheres = scene.scene.spheres;
    for (std::size_t i = 0; i < spheres.size(); ++i)
        if (spheres[i].kind != Kind::ball && !scene.scene.materials[spheres[i].material].hidden)
            take(place_of_sphere(scene.scene, i), seen_ball(spheres[i].ball(), camera), nullptr);
    const SphereTree *tree = scene.tree.get();
    if (tree == nullptr)
        return most;
    const auto bounded = [](double ratio) {
        if (ratio < 1.0)
            return ratio;
        return out_of_view;
    };
    const SphereTree::Least least = tree->least(
        camera,
        [&](const MovingBall &region) {
            return bounded(sides.nearest(region) / losses_of(tree, 2.0 * region.radius, region.radius).all());
        },
        [&](const MovingBall &surface) { return bounded(sides.of_surface(surface) / losses_of(tree, surface).all()); });
    if (least.number < 1.0)
        take(place_of_index(scene.scene, least.sphere), least.surface, tree);
    return most;
}

BrokenRule rule_about(const SpherePlace &place, const char *member, const std::string &value, const std::string &rule) {
    return {.subject = place.subject,
            .index = place.index,
            .member = member,
            .component = place.component,
            .value = value,
            .rule = rule};
}

} // namespace

std::optional<BrokenRule> displaced_surface(const PreparedScene &scene, const Camera &camera,
                                            const RenderSettings &settings) {
    const Displaced most = most_displaced(scene, camera, settings);
    if (most.pixels <= 1.0)
        return std::nullopt;
    const auto &[pixels, place, surface, losses] = most;
    const std::string shift = " by up to " + short_text(pixels) + " pixels in the picture: ";
    if (losses.of_capsule >= std::max(losses.of_center, losses.of_radius))
        return rule_about(place, "end", short_text(surface.close() + camera.position),
                          "the capsule is " + short_text(glm::length(surface.way)) +
                              " long and stored to 2^-21 of its length, which moves it" + shift +
                              "divide it into shorter ones, or see it from farther away");
    if (losses.of_radius >= losses.of_center)
        return rule_about(place, "radius", short_text(surface.radius),
                          "in scenes with opacities radii are stored to 2^-16 of themselves, which moves the surface" +
                              shift + "make it smaller, or all spheres opaque");
    const SphereTree::Farthest farthest = scene.tree->farthest();
    const bool is_huge = farthest.surface.radius > 0.5 * farthest.distance;
    return rule_about(place_of_index(scene.scene, farthest.sphere), is_huge ? "radius" : "center",
                      is_huge ? short_text(farthest.surface.radius)
                              : short_text(without_less_than(losses.of_center, farthest.surface.open)),
                      "it reaches so far that centers are stored to " + short_text(losses.of_center) +
                          ", which moves some in view" + shift + "bring it nearer, make it smaller" +
                          (scene.tree->has_opacities() ? " or opaque" : ", or render it in a scene of its own"));
}

} // namespace pt
