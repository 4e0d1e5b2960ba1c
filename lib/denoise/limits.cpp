#include "lib/denoise/limits.h"

#include "lib/denoise/surroundings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pt {

namespace {

float spread_at(const Halves &halves, std::size_t index) {
    return 0.5F * std::abs(halves.first[index] - halves.second[index]);
}

struct Support {
    float lowest;
    float highest;
};

Support support_about(const Halves &halves, std::size_t x, std::size_t y, std::size_t channel) {
    Support support{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    for_each_about(halves, x, y, channel, [&](std::size_t index) {
        support.lowest = std::min({support.lowest, halves.first[index], halves.second[index]});
        support.highest = std::max({support.highest, halves.first[index], halves.second[index]});
    });
    return support;
}

float reach_at(const Halves &halves, std::size_t x, std::size_t y, std::size_t channel) {
    constexpr float most_raised = 16.0F;
    constexpr float standard_errors = 2.0F * 1.41421356F;
    const float own = spread_at(halves, halves.index(x, y, channel));
    const float about = median_about(halves, x, y, channel, &spread_at);
    return standard_errors * std::max(own, std::min(about, most_raised * own));
}

float limited(float move, float value, float reach, const Support &support) {
    return std::clamp(move, std::max(-reach, support.lowest - value), std::min(reach, support.highest - value));
}

// Clips the moves in the direction of `sign` to a common length, so that sign * sum <= most. The sum is a concave,
// piecewise linear function of this length, so Newton's method from 0 approaches the length from below.
void shorten(std::vector<float> &moves, std::size_t channel, float sign, double most) {
    float longest = 0.0F;
    for (std::size_t longer_before = 0;;) {
        double sum = 0.0;
        std::size_t longer = 0;
        for (std::size_t i = channel; i < moves.size(); i += channel_count) {
            sum += std::min(sign * moves[i], longest);
            longer += sign * moves[i] > longest ? 1 : 0;
        }
        if (longer == longer_before)
            break;
        longer_before = longer;
        longest +=
            static_cast<float>(std::max(most - sum, 0.0) / static_cast<double>(std::max<std::size_t>(longer, 1)));
    }
    for (std::size_t i = channel; i < moves.size(); i += channel_count)
        moves[i] = sign * std::min(sign * moves[i], longest);
}

void keep_mean(std::vector<float> &moves, std::size_t channel, double standard_error) {
    double sum = 0.0;
    for (std::size_t i = channel; i < moves.size(); i += channel_count)
        sum += moves[i];
    if (std::abs(sum) > standard_error)
        shorten(moves, channel, sum > 0.0 ? 1.0F : -1.0F, standard_error);
}

} // namespace

void limit_moves(Halves &halves) {
    for (std::size_t y = 0; y < halves.height; ++y)
        for (std::size_t x = 0; x < halves.width; ++x)
            for (std::size_t channel = 0; channel < channel_count; ++channel) {
                const std::size_t index = halves.index(x, y, channel);
                const float reach = reach_at(halves, x, y, channel);
                const Support support = support_about(halves, x, y, channel);
                halves.first_move[index] = limited(halves.first_move[index], halves.first[index], reach, support);
                halves.second_move[index] = limited(halves.second_move[index], halves.second[index], reach, support);
            }
}

void keep_mean(Halves &halves) {
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
        double square = 0.0;
        for (std::size_t i = channel; i < halves.value_count(); i += channel_count)
            square += std::pow(double{spread_at(halves, i)}, 2);
        keep_mean(halves.first_move, channel, std::sqrt(square));
        keep_mean(halves.second_move, channel, std::sqrt(square));
    }
}

} // namespace pt
