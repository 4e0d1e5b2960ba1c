#include "lib/view/small_lamps.h"

#include "lib/view/lamp.h"
#include "lib/view/seen_scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace pt {

namespace {

// A lamp that covers a larger fraction of a pixel is hit often enough by 16 samples. Calibrated.
constexpr double largest_share = 0.5;

// Lengths are in pixels, x and y from the image's top left corner.
struct Disc {
    double x;
    double y;
    double radius; // radius with blur
    double size;   // area without blur

    double area() const { return std::numbers::pi * radius * radius; }
    bool overlaps(std::uint32_t width, std::uint32_t height) const {
        return x + radius > 0.0 && x - radius < width && y + radius > 0.0 && y - radius < height;
    }
};

constexpr double never = std::numeric_limits<double>::infinity();

double ahead(double way) {
    if (way > 0.0)
        return way;
    return never;
}

// Returns the distance along a unit vector at which a ray from the origin enters a ball, or leaves it if it starts
// inside; infinity if the ray misses. Only the first position of a moving ball is used. It never hides more than the
// whole path does.
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

double transmittance(const PreparedScene &prepared, const Camera &start, const glm::dvec3 &direction, double distance) {
    const Scene &scene = prepared.scene;
    double share = 1.0;
    const auto pass = [&](const MovingBall &ball, std::int16_t opacity) {
        if (way_to(ball, direction) < distance)
            share *= passing_share(opacity);
    };
    for (const Plane &plane : scene.planes)
        if (!scene.materials[plane.material].hidden && way_to(plane, start, direction) < distance)
            return 0.0;
    for (const Sphere &sphere : scene.spheres)
        if (const Material &material = scene.materials[sphere.material]; !material.hidden)
            pass(SeenSphere(sphere, material, start), sphere.opacity);
    const auto may_block = [&](const MovingBall &region) {
        return share > 0.0 && (glm::length(region.open) <= region.radius || way_to(region, direction) < distance);
    };
    if (prepared.tree)
        prepared.tree->visit(start, may_block, pass);
    return share;
}

double visible_share(const PreparedScene &scene, const Projection &projection, const glm::dvec3 &center,
                     double radius) {
    const glm::dvec3 &position = projection.camera().position;
    Camera start = projection.camera();
    start.position += projection.origin(center);
    const glm::dvec3 way = center + position - start.position;
    return transmittance(scene, start, glm::normalize(way), glm::length(way) - 2.0 * radius);
}

struct Window {
    std::uint32_t width;
    std::uint32_t first_row;
    std::uint32_t row_count;
};

// Squares of radius and blur are added, because they are proportional to variances.
Disc disc_of(const ImagePlace &place, double radius, const Window &window) {
    const double seen_radius = place.scale * radius;
    return {place.x, place.y - window.first_row, std::hypot(seen_radius, place.blur),
            std::numbers::pi * seen_radius * seen_radius};
}

// Adds the pixels of a disc. Large discs are divided into squares of several pixels, to limit the number of pieces.
// `of_disc` has the fraction of samples in the disc that hit the lamp.
void add_pieces(std::vector<LampPiece> &pieces, std::size_t first, Disc disc, int lines, const LampPiece &of_disc,
                const Window &window) {
    constexpr double few = 4.0; // squares along a radius
    const double side = std::max(std::ceil(disc.radius / few), 1.0);
    disc = {disc.x / side, disc.y / side, disc.radius / side, disc.size};
    const double columns = std::ceil(window.width / side);
    const double rows = std::ceil(window.row_count / side);
    const auto middle = [side](double square, std::uint32_t end) {
        return std::min(static_cast<std::uint32_t>((square + 0.5) * side), end - 1);
    };
    const double pixels = side * side * of_disc.pixels;
    for (int i = 0; i < lines; ++i) {
        const double across = (2.0 * i + 1.0) / lines - 1.0;
        const double half = disc.radius * std::sqrt((1.0 - across) * (1.0 + across));
        const double row = std::floor(disc.y + disc.radius * across);
        if (row < 0.0 || row >= rows)
            continue;
        const std::uint32_t y = middle(row, window.row_count);
        const auto begin = static_cast<std::uint32_t>(std::clamp(std::floor(disc.x - half), 0.0, columns));
        const auto end = static_cast<std::uint32_t>(std::clamp(std::ceil(disc.x + half), 0.0, columns));
        for (std::uint32_t column = begin; column < end; ++column) {
            const std::uint32_t x = middle(column, window.width);
            const double length = std::min(disc.x + half, column + 1.0) - std::max(disc.x - half, 1.0 * column);
            const auto is_there = [=](const LampPiece &piece) {
                return piece.x == x && piece.y == y && piece.pixels == pixels;
            };
            auto piece = std::find_if(pieces.begin() + static_cast<std::ptrdiff_t>(first), pieces.end(), is_there);
            if (piece == pieces.end())
                piece =
                    pieces.insert(piece, {x, y, 0.0, of_disc.lamp_share, of_disc.emission, pixels, of_disc.is_spread});
            piece->share += of_disc.share * (length * 2.0 * disc.radius / lines);
            piece->lamp_share = std::max(piece->lamp_share, of_disc.lamp_share);
        }
    }
}

// A moving lamp counts at several times while the shutter is open. If it moves by more than a pixel between two times,
// its disc at each time also stands for the pixels between.
void add_lamp(std::vector<LampPiece> &pieces, const PreparedScene &scene, const Projection &projection,
              const Window &window, const Lamp &lamp) {
    const MovingBall &ball = lamp.bound;
    constexpr double most_moments = 64.0;
    constexpr int all_lines = 256;
    constexpr int least_lines = 16;
    const auto seen = [&](const glm::dvec3 &center) { return disc_of(projection.place(center), ball.radius, window); };
    if (!projection.is_ahead(ball.open, ball.radius) || !projection.is_ahead(ball.close(), ball.radius))
        return;
    const double path = std::hypot(seen(ball.close()).x - seen(ball.open).x, seen(ball.close()).y - seen(ball.open).y);
    const double moments = std::clamp(std::ceil(path), 1.0, most_moments);
    const double apart = std::max(path / moments, 1.0);
    const bool is_veiled = scene.tree && scene.tree->has_opacities();
    const std::size_t first = pieces.size();
    for (int moment = 0; moment < static_cast<int>(moments); ++moment) {
        const glm::dvec3 center = ball.open + (moment + 0.5) / moments * ball.way;
        const Disc disc = seen(center);
        if (!disc.overlaps(window.width, window.row_count))
            continue;
        const double bare_share = disc.size / std::max(disc.area() + 2.0 * disc.radius * path, 1.0);
        if (bare_share >= largest_share && !is_veiled)
            continue;
        const double light = visible_share(scene, projection, center, ball.radius);
        const double lamp_share = light * bare_share;
        if (light == 0.0 || lamp_share >= largest_share)
            continue;
        const bool is_spread = disc.area() > 1.5 * disc.size || path > disc.radius;
        add_pieces(
            pieces, first, disc, std::max(static_cast<int>(all_lines / moments), least_lines),
            {0, 0, light * disc.size / disc.area() / (moments * apart), lamp_share, lamp.emission, apart, is_spread},
            window);
    }
}

} // namespace

std::vector<LampPiece> small_lamps_in_view(const PreparedScene &scene, const Projection &projection,
                                           std::uint32_t first_row, std::uint32_t row_count) {
    std::vector<LampPiece> pieces;
    for (const Lamp &lamp : lamps_of(scene, projection.camera()))
        if (!lamp.hidden)
            add_lamp(pieces, scene, projection, {projection.width(), first_row, row_count}, lamp);
    return pieces;
}

double LampPiece::enough_samples(bool is_random) const {
    return (is_random || is_spread ? 8.0 : 3.0) / lamp_share;
}

std::uint64_t samples_to_hit(const LampPiece &piece, double offset, bool is_random) {
    constexpr double negligible = 0.01;
    const double brightest = piece.share * std::max({piece.emission.r, piece.emission.g, piece.emission.b});
    if (brightest * brightest < negligible * (brightest * brightest + offset))
        return 0;
    return static_cast<std::uint64_t>(std::clamp(std::ceil(piece.enough_samples(is_random)), 1.0, 4294967295.0));
}

namespace {

struct UnmetPiece {
    double hits;
    double square;
    double relative_square;
    double lack; // squared error if no sample hits
    double relative_lack;
};

UnmetPiece unmet_piece(const LampPiece &piece, double count, double offset, bool is_random) {
    const double hits = count * piece.share;
    const double random_variance = hits * (1.0 - piece.share);
    const double variance =
        is_random || piece.is_spread ? random_variance : std::min(random_variance, 0.6 * std::sqrt(hits));
    const glm::dvec3 limits = piece.share * piece.emission;
    const glm::dvec3 lacks = limits * limits;
    const glm::dvec3 expected = variance / (hits * hits) * lacks;
    const auto sum = [&](const glm::dvec3 &values) { return piece.pixels * (values.r + values.g + values.b); };
    return {piece.pixels * hits, sum(expected), sum(expected / (lacks + offset)), sum(lacks),
            sum(lacks / (lacks + offset))};
}

void add(ExpectedSquares &to, double square, double hits) {
    to.sum += square;
    to.variance += square * square / hits;
}

} // namespace

// The number of hits has a Poisson distribution. The pieces with the largest errors count as missed, as long as their
// expected hits sum to less than one.
UnmetSquares unmet_squares(const std::vector<LampPiece> &pieces, double offset, bool is_random,
                           const std::function<std::uint64_t(const LampPiece &)> &samples) {
    std::vector<UnmetPiece> unmet;
    for (const LampPiece &piece : pieces)
        if (const std::uint64_t count = samples(piece); samples_to_hit(piece, offset, is_random) > count)
            unmet.push_back(unmet_piece(piece, static_cast<double>(count), offset, is_random));
    std::ranges::sort(unmet, std::greater(),
                      [](const UnmetPiece &piece) { return piece.relative_square / piece.hits; });
    UnmetSquares all;
    double hits = 0.0;
    for (const UnmetPiece &piece : unmet) {
        hits += piece.hits;
        const bool is_hit = hits >= 1.0;
        const double rests_on = is_hit ? piece.hits : 1.0;
        add(all.square, is_hit ? piece.square : piece.lack, rests_on);
        add(all.relative_square, is_hit ? piece.relative_square : piece.relative_lack, rests_on);
    }
    return all;
}

} // namespace pt
