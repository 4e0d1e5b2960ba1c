#include "lib/view/lamp_tree_words.h"

#include "lib/view/lamp_tree.h"
#include "lib/view/scene_blocks.h"
#include "shaders/gpu_layout.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pt {

namespace {

// Nodes must contain the lamps as the kernel sees them, in float32.
struct Ball {
    glm::vec3 open;
    glm::vec3 way{0.0F};
    float radius = 0.0F;

    std::array<glm::dvec3, 2> ends() const { return {glm::dvec3(open), glm::dvec3(open) + glm::dvec3(way)}; }
};

struct ScaledLamp {
    Ball ball;
    double power;
    std::uint32_t index;
};

struct Node {
    Ball ball;
    double power = 0.0;
    float spread = 0.0F;
};

Ball ball_of(const MovingBall &ball) {
    return {glm::vec3(ball.open), glm::vec3(ball.way), static_cast<float>(ball.radius)};
}

// Divides powers by the largest power. If the lamps' extent is above 1, multiplies powers by the extent. The kernel's
// quotients of power and squared distance are then between 1e-17 and 1e17.
std::vector<ScaledLamp> scaled_lamps(std::span<const Lamp> lamps) {
    double largest_power = 0.0;
    double size = 1.0;
    std::vector<ScaledLamp> scaled;
    scaled.reserve(lamps.size());
    for (const Lamp &lamp : lamps) {
        scaled.push_back({ball_of(lamp.bound), lamp.power(), lamp.number});
        largest_power = std::max(largest_power, scaled.back().power);
        size = std::max(size, glm::length(lamp.bound.open - lamps.front().bound.open));
    }
    const double unit = std::exp2(std::floor(std::log2(largest_power)));
    const double factor = std::exp2(std::floor(std::log2(size)));
    for (ScaledLamp &lamp : scaled)
        lamp.power = factor * std::max(lamp.power / unit, 0x1p-40);
    return scaled;
}

// The center is the mean weighted by power. Motions are straight, so distances from the center are largest at an end.
Node node_of(std::span<const ScaledLamp> lamps) {
    Node node;
    glm::dvec3 open(0.0);
    glm::dvec3 way(0.0);
    for (const ScaledLamp &lamp : lamps) {
        node.power += lamp.power;
        open += lamp.power * glm::dvec3(lamp.ball.open);
        way += lamp.power * glm::dvec3(lamp.ball.way);
    }
    node.ball.open = glm::vec3(open / node.power);
    node.ball.way = glm::vec3(way / node.power);
    const std::array middles = node.ball.ends();
    double radius = 0.0;
    std::array<double, 2> spreads{};
    for (const ScaledLamp &lamp : lamps) {
        const std::array centers = lamp.ball.ends();
        const double lamp_radius = lamp.ball.radius;
        for (std::size_t end = 0; end < 2; ++end) {
            const double distance = glm::length(centers[end] - middles[end]);
            radius = std::max(radius, distance + lamp_radius);
            spreads[end] += lamp.power * (distance * distance + 3.0 * lamp_radius * lamp_radius);
        }
    }
    // Between the ends of a motion, the kernel rounds positions to 2^-24 of their size.
    radius += 0x1p-21 * (std::max(glm::length(middles[0]), glm::length(middles[1])) + radius);
    const double spread = std::max(
        {spreads[0] / node.power, spreads[1] / node.power, radius * radius / gpu::LAMP_TREE_BALL * (1.0 + 0x1p-20)});
    node.spread = std::max(static_cast<float>(spread), 0x1p-120F);
    return node;
}

void write_node(std::span<glm::vec4> words, int place, const Node &node, bool motion) {
    for (int axis = 0; axis < 3; ++axis)
        words[static_cast<std::size_t>(axis)][place] = node.ball.open[axis];
    words[3][place] = static_cast<float>(node.power);
    words[4][place] = node.spread;
    for (int axis = 0; motion && axis < 3; ++axis)
        words[5 + static_cast<std::size_t>(axis)][place] = node.ball.way[axis];
}

} // namespace

std::uint64_t lamp_tree_words(std::uint32_t lamp_count, bool motion) {
    const LampTreeShape shape(lamp_count);
    return gpu::lamp_tree_group_words(motion ? 1 : 0) * shape.all_groups() + shape.slots() / 4 +
           (std::uint64_t{lamp_count} + 3) / 4;
}

void write_lamp_tree(std::span<glm::vec4> words, std::span<const Lamp> lamps, bool motion) {
    const LampTreeShape shape(static_cast<std::uint32_t>(lamps.size()));
    const std::vector<ScaledLamp> scaled = scaled_lamps(lamps);
    const std::uint64_t group_words = gpu::lamp_tree_group_words(motion ? 1 : 0);
    for (std::uint32_t level = 0; level <= shape.levels(); ++level) {
        const std::uint64_t nodes = 4 * shape.groups_of(level);
        const std::uint64_t slots_of_node = shape.slots() / nodes;
        for (std::uint64_t i = 0; i < nodes; ++i) {
            const std::uint32_t first = shape.first_lamp(i * slots_of_node);
            const std::uint32_t end = shape.first_lamp((i + 1) * slots_of_node);
            Node node{};
            if (level < shape.levels()) {
                node = node_of(std::span(scaled).subspan(first, end - first));
            } else if (first < end) {
                node = {scaled[first].ball, scaled[first].power, scaled[first].ball.radius};
            }
            write_node(words.subspan(group_words * (shape.groups_above(level) + i / 4)), static_cast<int>(i % 4), node,
                       motion);
        }
    }
    const std::span<glm::vec4> lamp_words = words.subspan(group_words * shape.all_groups());
    const std::span<glm::vec4> slot_words = lamp_words.subspan(shape.slots() / 4);
    for (std::uint64_t slot = 0; slot < shape.slots(); ++slot) {
        const std::uint32_t first = shape.first_lamp(slot);
        const bool is_taken = first < shape.first_lamp(slot + 1);
        write_number(lamp_words, slot, is_taken ? scaled[first].index : 0);
        if (is_taken)
            write_number(slot_words, scaled[first].index, static_cast<std::uint32_t>(slot));
    }
}

} // namespace pt
