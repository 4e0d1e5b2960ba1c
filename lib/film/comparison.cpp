#include "lib/film/comparison.h"

#include "lib/film/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

namespace pt {

namespace {

constexpr std::size_t colors = 3;
constexpr double not_found = std::numeric_limits<double>::infinity();

constexpr std::uint32_t least_side = 16;
constexpr std::uint32_t reported_side = 32; // side of the regions of smallest_tile_change

// Differences up to this fraction of the light count as rounding errors. A lobe 2^x with x >= -100 has an error of up
// to 100 ln 2 * 18 u + 203 u = 8.7e-5, from x and from the power (accuracy.cpp, u = 2^-24).
constexpr double rounding_share = 1e-4;

// The constant of shaders/README.md, section 11.
constexpr double sign_constant = 3.178;

constexpr double quantile_99 = 2.326;

struct ChannelSums {
    double light = 0.0;
    double light_squares = 0.0;
    double difference = 0.0; // first minus second
    double squares = 0.0;
    double cubes = 0.0;
    double first_lit = 0.0;
    double second_lit = 0.0;

    void add_pixel(double first, double second) {
        const double change = first - second;
        add({second, second * second, change, change * change, change * change * change, first > 0.0 ? 1.0 : 0.0,
             second > 0.0 ? 1.0 : 0.0});
    }

    void add(const ChannelSums &other) {
        light += other.light;
        light_squares += other.light_squares;
        difference += other.difference;
        squares += other.squares;
        cubes += other.cubes;
        first_lit += other.first_lit;
        second_lit += other.second_lit;
    }
};

bool may_miss_lamps(const pt_compared_image &image) {
    constexpr std::uint32_t some_length = 2;
    return finds_lamps_by_chance(image.estimator, some_length);
}

// Whether a darker image is evidence. An estimator that finds lamps by chance may have missed light.
struct Knowledge {
    bool of_first;
    bool of_second;
};

Knowledge knowledge_of(const pt_compare_info &info) {
    const bool first_misses = may_miss_lamps(info.first);
    const bool second_misses = may_miss_lamps(info.second);
    return {!first_misses || second_misses, !second_misses || first_misses};
}

struct Region {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::array<ChannelSums, colors> channels{};

    double pixel_count() const { return static_cast<double>(width) * height; }
};

struct Level {
    std::uint32_t side;
    std::uint32_t columns;
    std::vector<Region> regions;
};

constexpr std::uint64_t quotient_up(std::uint64_t a, std::uint64_t b) {
    return a / b + (a % b != 0 ? 1 : 0);
}

Level level_of(const pt_compare_info &info, std::uint32_t side) {
    Level level{side, static_cast<std::uint32_t>(quotient_up(info.width, side)), {}};
    for (std::uint32_t y = 0; y < info.height; y += std::min(side, info.height - y))
        for (std::uint32_t x = 0; x < info.width; x += std::min(side, info.width - x))
            level.regions.push_back({x, y, std::min(side, info.width - x), std::min(side, info.height - y)});
    return level;
}

Level tiles_of(const pt_compare_info &info) {
    Level level = level_of(info, least_side);
    for (Region &region : level.regions)
        for (std::uint32_t y = region.y; y < region.y + region.height; ++y)
            for (std::uint32_t x = region.x; x < region.x + region.width; ++x)
                for (std::size_t channel = 0; channel < colors; ++channel) {
                    const std::size_t place = colors * (std::size_t{y} * info.width + x) + channel;
                    region.channels[channel].add_pixel(info.first.radiance[place], info.second.radiance[place]);
                }
    return level;
}

Level twice_as_large(const pt_compare_info &info, const Level &level) {
    Level larger = level_of(info, 2 * level.side);
    for (const Region &region : level.regions) {
        Region &holder = larger.regions[std::size_t{region.y / larger.side} * larger.columns + region.x / larger.side];
        for (std::size_t channel = 0; channel < colors; ++channel)
            holder.channels[channel].add(region.channels[channel]);
    }
    return larger;
}

std::vector<Level> levels_of(const pt_compare_info &info) {
    std::vector<Level> levels{tiles_of(info)};
    while (levels.back().regions.size() > 1)
        levels.push_back(twice_as_large(info, levels.back()));
    return levels;
}

double sample_ratio(const pt_compare_info &info) {
    const double first = info.first.min_samples;
    const double second = info.second.min_samples;
    return first > 0.0 && second > 0.0 ? std::max(first / second, second / first) : 1.0;
}

// The largest differences of single pixels. They may come from rare bright samples, which a region may lack by chance.
struct Events {
    double absolute = 0.0; // largest difference of pixels that differ by more than their darker value
    double relative = 0.0; // largest difference of other pixels, as a fraction of the darker value

    void add_pixel(double first, double second, double ratio) {
        const double event = ratio * std::abs(first - second);
        const double light = std::max(std::min(first, second), 0.0);
        if (event > light)
            absolute = std::max(absolute, event);
        relative = std::max(relative, event < light ? event / light : event > 0.0 ? 1.0 : 0.0);
    }
};

using ChannelEvents = std::array<Events, colors>;

ChannelEvents largest_events(const pt_compare_info &info) {
    ChannelEvents events{};
    const std::size_t value_count = colors * info.width * info.height;
    const double ratio = sample_ratio(info);
    const double samples = std::min(info.first.min_samples, info.second.min_samples);
    for (std::size_t i = 0; i < value_count; ++i) {
        const double first = info.first.radiance[i];
        const double second = info.second.radiance[i];
        Events &channel = events[i % colors];
        channel.add_pixel(first, second, ratio);
        if (samples > 0.0)
            channel.absolute = std::max(channel.absolute, std::max(first, second) / samples);
    }
    return events;
}

struct Difference {
    double z;        // difference in standard deviations
    double event;    // largest event in standard deviations
    double skewness; // skewness towards the other sign, >= 0

    // Returns an upper bound for the probability of this difference if the light is equal.
    double probability() const {
        const double by_noise = event > 0.0 ? std::min(z, 1.0 / event) : z;
        const double by_events = event > 0.0 ? (z - by_noise) / event : 0.0;
        const double skewed = skewness > 0.0 ? std::min(by_noise, 1.0 / skewness) : by_noise;
        const double tail = sign_constant * std::erfc(skewed / std::sqrt(2.0));
        return std::min(1.0, tail * std::exp(skewness * skewed * skewed * skewed / 3.0 - by_events));
    }
};

class Evidence {
public:
    Evidence(const ChannelSums &sums, const Events &events, const Knowledge &knowledge, double pixel_count) :
        sums_(sums),
        knowledge_(knowledge),
        pixel_count_(pixel_count),
        event_(std::max(events.absolute, events.relative * std::max(sums.light, 0.0) / pixel_count)),
        deviation_(std::sqrt(sums.squares)) {}

    double probability() const {
        const double sign = sums_.difference < 0.0 ? -1.0 : 1.0;
        const double excess = std::abs(sums_.difference) - rounding_share * std::abs(sums_.light);
        const double met = sign < 0.0 ? met_by_first() : met_by_second();
        return excess > 0.0 ? probability_of(excess, deviation_, event_, skewness(sign), met) : 1.0;
    }

    // Returns the smallest change, as a fraction of the light, that is found with 99% probability at this rate. If
    // light changes by the factor 1 + a, noise and events grow by up to this factor. The sum of squared differences
    // grows by a^2 times the sum of squared light.
    double smallest_change(double rate) const {
        const double worst_skewness = std::max(skewness(-1.0), skewness(1.0));
        const double met = std::min(met_by_first(), met_by_second());
        const auto is_found = [&](double change) {
            const double growth = 1.0 + change;
            const double deviation = std::sqrt(growth * growth * sums_.squares + change * change * sums_.light_squares);
            const double excess = (change - rounding_share) * sums_.light - quantile_99 * deviation;
            return excess > 0.0 && probability_of(excess, deviation, growth * event_, worst_skewness, met) <= rate;
        };
        if (!is_found(1.0))
            return not_found;
        double low = 0.0;
        double high = 1.0;
        constexpr int halvings = 24;
        for (int i = 0; i < halvings; ++i) {
            const double middle = 0.5 * (low + high);
            (is_found(middle) ? high : low) = middle;
        }
        return high;
    }

private:
    // Lower bounds for the number of events in an image. 0 if a darker image is no evidence.
    double met_by_first() const { return knowledge_.of_first ? events_in(sums_.first_lit) : 0.0; }
    double met_by_second() const { return knowledge_.of_second ? events_in(sums_.second_lit) : 0.0; }
    double events_in(double lit) const { return pixel_count_ * -std::log1p(-lit / pixel_count_); }

    double skewness(double sign) const {
        return deviation_ > 0.0 ? std::max(0.0, -sign * sums_.cubes / std::pow(deviation_, 3.0)) : 0.0;
    }

    // `met` is the number of events in the darker image.
    static double probability_of(double excess, double deviation, double event, double skewness, double met) {
        const Difference difference{excess / deviation, event / deviation, skewness};
        return std::max(difference.probability(), std::exp(-met / 6.0));
    }

    const ChannelSums &sums_;
    Knowledge knowledge_;
    double pixel_count_;
    double event_;
    double deviation_;
};

pt_compared_region compared(const Region &region, const ChannelEvents &events, const Knowledge &knowledge, double rate,
                            double test_count) {
    pt_compared_region result{};
    result.x = region.x;
    result.y = region.y;
    result.width = region.width;
    result.height = region.height;
    result.probability = 1.0;
    result.smallest_change = not_found;
    for (std::size_t channel = 0; channel < colors; ++channel) {
        const ChannelSums &sums = region.channels[channel];
        const double pixel_count = region.pixel_count();
        result.light[channel] = sums.light / pixel_count;
        result.difference[channel] = sums.difference / pixel_count;
        result.deviation[channel] = std::sqrt(sums.squares) / pixel_count;
        const Evidence evidence(sums, events[channel], knowledge, pixel_count);
        result.probability = std::min(result.probability, test_count * evidence.probability());
        result.smallest_change = std::min(result.smallest_change, evidence.smallest_change(rate / test_count));
    }
    return result;
}

bool are_equal_bits(const pt_compare_info &info) {
    const std::size_t bytes = colors * sizeof(float) * info.width * info.height;
    return std::memcmp(info.first.radiance, info.second.radiance, bytes) == 0;
}

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::uint32_t light_of(const pt_compare_info &info, const pt_comparison &verdict) {
    if (are_equal_bits(info))
        return PT_LIGHT_EQUAL_BITS;
    if (verdict.probability <= verdict.rate)
        return PT_LIGHT_DIFFERENT;
    return verdict.smallest_change <= info.min_change ? PT_LIGHT_SAME : PT_LIGHT_UNDECIDED;
}

} // namespace

Comparison compare_light(const pt_compare_info &info) {
    const double look = info.look;
    const double rate = info.look > 0 ? info.rate / (look * (look + 1.0)) : info.rate;
    const ChannelEvents events = largest_events(info);
    const std::vector<Level> levels = levels_of(info);
    Comparison comparison;
    pt_comparison &verdict = comparison.verdict;
    verdict.rate = rate;
    verdict.probability = 1.0;
    verdict.smallest_change = not_found;
    verdict.smallest_tile_change = not_found;
    for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
        std::vector<double> changes;
        const double test_count = static_cast<double>(colors * level->regions.size() * levels.size());
        for (const Region &region : level->regions) {
            const pt_compared_region &result =
                comparison.regions.emplace_back(compared(region, events, knowledge_of(info), rate, test_count));
            verdict.probability = std::min(verdict.probability, result.probability);
            verdict.smallest_change = std::min(verdict.smallest_change, result.smallest_change);
            changes.push_back(result.smallest_change);
        }
        if (level->side == reported_side || levels.size() == 1)
            verdict.smallest_tile_change = median_of(std::move(changes));
    }
    verdict.light = light_of(info, verdict);
    const std::string summary = summary_of(comparison, info.min_change);
    std::copy_n(summary.begin(), std::min(summary.size(), sizeof verdict.summary - 1), verdict.summary);
    return comparison;
}

std::uint32_t region_count_of(const pt_compare_info &info) {
    std::uint32_t count = 0;
    for (std::uint64_t side = least_side;; side *= 2) {
        const auto regions = quotient_up(info.width, side) * quotient_up(info.height, side);
        count += static_cast<std::uint32_t>(regions);
        if (regions == 1)
            return count;
    }
}

} // namespace pt
