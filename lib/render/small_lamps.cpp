#include "lib/render/small_lamps.h"

#include "lib/film/error_estimate.h"
#include "lib/scene/seen_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pt {

namespace {

// Expected meetings with the samples of a pixel: a standard error from 8 of them is off by a third. Calibrated.
constexpr double enough_meetings = 8.0;

constexpr double largest_size = enough_meetings / min_estimate_samples; // pixels

// A lamp's disc on the image, in pixels from its top left corner.
struct Disc {
    double x;
    double y;
    double radius; // of where it is seen
    double size;   // of the lamp: less than the disc if the camera spreads it
    glm::dvec3 emission;

    bool meets(std::uint32_t width, std::uint32_t height) const {
        return x + radius > 0.0 && x - radius < width && y + radius > 0.0 && y - radius < height;
    }
};

constexpr double never = std::numeric_limits<double>::infinity();

double ahead(double way) {
    if (way > 0.0)
        return way;
    return never;
}

// The distance from the origin, along a unit vector, at which a ray enters a ball, or leaves it if it begins inside;
// infinity if it misses. Of one that moves or is swept it is the first place, which hides no more than all of it does
// unless the ray begins inside.
double way_to(const MovingBall &ball, const glm::dvec3 &direction) {
    const double along = glm::dot(ball.open, direction);
    const double beside = glm::length(ball.open - along * direction);
    const bool has_way = ball.way != glm::dvec3(0.0);
    if (beside >= ball.radius || (has_way && may_hold_origin(ball)))
        return never;
    const double half_chord = std::sqrt((ball.radius - beside) * (ball.radius + beside));
    const double way = glm::length(ball.open) > ball.radius ? along - half_chord : along + half_chord;
    return ahead(way);
}

double way_to(const Plane &plane, const Camera &camera, const glm::dvec3 &direction) {
    const double height = glm::dot(plane.normal, camera.position) + plane.offset;
    return ahead(-height / glm::dot(plane.normal, direction));
}

// The distance to the first surface that the camera sees. start: the camera or, for parallel rays, where this ray
// begins.
double way_to_first(const PreparedScene &prepared, const Camera &start, const glm::dvec3 &direction) {
    const Scene &scene = prepared.scene;
    double first = never;
    for (const Plane &plane : scene.planes)
        if (!scene.materials[plane.material].hidden)
            first = std::min(first, way_to(plane, start, direction));
    for (const Sphere &sphere : scene.spheres)
        if (const Material &material = scene.materials[sphere.material]; !material.hidden)
            first = std::min(first, way_to(SeenSphere(sphere, material, start), direction));
    if (!prepared.tree)
        return first;
    const auto to_ball = [&](const MovingBall &ball) { return way_to(ball, direction); };
    const auto to_region = [&](const MovingBall &region) {
        return glm::length(region.open) > region.radius ? to_ball(region) : 0.0;
    };
    return std::min(first, prepared.tree->least(start, to_region, to_ball).number);
}

bool is_hidden(const SeenSphere &lamp, const PreparedScene &scene, const Camera &camera) {
    Camera start = camera;
    if (camera.is_orthographic())
        start.position += lamp.open - glm::dot(lamp.open, camera.forward) * camera.forward;
    const glm::dvec3 way = lamp.open + camera.position - start.position;
    return way_to_first(scene, start, glm::normalize(way)) < glm::length(way) - 2.0 * lamp.radius;
}

// Adds the pixels of a disc, in squares of so many that no disc has many: it is cut into thin lines, and each line is
// divided among the squares that it crosses.
void add_pieces(std::vector<LampPiece> &pieces, Disc disc, std::uint32_t width, std::uint32_t row_count) {
    constexpr double few = 4.0; // squares along a radius
    constexpr int lines = 256;
    const double side = std::max(std::ceil(disc.radius / few), 1.0);
    const double share = disc.size / (std::numbers::pi * disc.radius * disc.radius);
    disc = {disc.x / side, disc.y / side, disc.radius / side, disc.size, disc.emission};
    const double columns = std::ceil(width / side);
    const double rows = std::ceil(row_count / side);
    const auto middle = [side](double square, std::uint32_t end) {
        return std::min(static_cast<std::uint32_t>((square + 0.5) * side), end - 1);
    };
    const std::size_t first = pieces.size();
    for (int i = 0; i < lines; ++i) {
        const double across = (2.0 * i + 1.0) / lines - 1.0;
        const double half = disc.radius * std::sqrt((1.0 - across) * (1.0 + across));
        const double row = std::floor(disc.y + disc.radius * across);
        if (row < 0.0 || row >= rows)
            continue;
        const std::uint32_t y = middle(row, row_count);
        const auto begin = static_cast<std::uint32_t>(std::clamp(std::floor(disc.x - half), 0.0, columns));
        const auto end = static_cast<std::uint32_t>(std::clamp(std::ceil(disc.x + half), 0.0, columns));
        for (std::uint32_t column = begin; column < end; ++column) {
            const std::uint32_t x = middle(column, width);
            const double length = std::min(disc.x + half, column + 1.0) - std::max(disc.x - half, 1.0 * column);
            const auto is_there = [x, y](const LampPiece &piece) { return piece.x == x && piece.y == y; };
            auto piece = std::find_if(pieces.begin() + static_cast<std::ptrdiff_t>(first), pieces.end(), is_there);
            if (piece == pieces.end())
                piece = pieces.insert(piece, {x, y, 0.0, disc.size, disc.emission, side * side});
            piece->share += share * (length * 2.0 * disc.radius / lines);
        }
    }
}

} // namespace

std::vector<LampPiece> small_lamps_in_view(const PreparedScene &scene, const Camera &camera, std::uint32_t width,
                                           std::uint32_t height, std::uint32_t first_row, std::uint32_t row_count) {
    std::vector<LampPiece> pieces;
    for (const Sphere &sphere : scene.lamps()) {
        const Material &material = scene.scene.materials[sphere.material];
        const SeenSphere seen(sphere, material, camera);
        const double depth = glm::dot(seen.open, camera.forward);
        if (material.hidden || depth <= seen.radius || seen.way != glm::dvec3(0.0))
            continue;
        const double half_height =
            camera.is_orthographic() ? 0.5 * camera.vertical_extent : depth * camera.tan_half_fov;
        const double scale = 0.5 * height / half_height;
        // Each point of the lamp may be spread over a disc; the variances of both add up to that of a disc with the
        // root of the sum of their squares as its radius.
        const double radius = scale * seen.radius;
        const double spread = scale * camera.spread(depth);
        const Disc disc{0.5 * width + scale * glm::dot(seen.open, camera.right),
                        0.5 * height - scale * glm::dot(seen.open, camera.up) - first_row, std::hypot(radius, spread),
                        std::numbers::pi * radius * radius, material.emission};
        if (disc.size < largest_size && disc.meets(width, row_count) && !is_hidden(seen, scene, camera))
            add_pieces(pieces, disc, width, row_count);
    }
    return pieces;
}

UnmetSquares unmet_squares(const std::vector<LampPiece> &pieces, double offset, bool is_random,
                           const std::function<std::uint64_t(const LampPiece &)> &samples) {
    UnmetSquares all{0.0, 0.0};
    for (const LampPiece &piece : pieces) {
        const auto count = static_cast<double>(samples(piece));
        if (count * piece.lamp_size >= enough_meetings)
            continue;
        const double meetings = count * piece.share;
        const double random_variance = meetings * (1.0 - piece.share);
        const double variance = is_random ? random_variance : std::min(random_variance, 0.6 * std::sqrt(meetings));
        for (int channel = 0; channel < 3; ++channel) {
            const double emission = piece.emission[channel];
            const double square = piece.pixels * emission * emission * variance / (count * count);
            const double limit = piece.share * emission;
            all.square += square;
            all.relative_square += square / (limit * limit + offset);
        }
    }
    return all;
}

} // namespace pt
