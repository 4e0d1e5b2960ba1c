#include "lib/tree/cuts.h"

#include <algorithm>
#include <array>
#include <limits>

namespace pt {

namespace {

constexpr int most_bins = 16;

int bins_for(std::size_t spheres) {
    return spheres > 64 ? most_bins : 8;
}

// Bins of equal width along the longest axis. In large parts, cuts along other axes are hardly better.
class Bins {
public:
    explicit Bins(const Part &part) :
        axis_(part.centers.longest_axis()),
        count_(bins_for(part.items.size())),
        low_(part.centers.low[axis_]),
        scale_(static_cast<float>(count_) / part.centers.extent(axis_)) {}

    int count() const { return count_; }

    int bin_of(const TreeItem &item) const {
        return std::min(static_cast<int>((item.center_radius[axis_] - low_) * scale_), count_ - 1);
    }

    bool is_before(const TreeItem &item, int bin) const {
        return (item.center_radius[axis_] - low_) * scale_ < static_cast<float>(bin);
    }

private:
    std::size_t axis_;
    int count_;
    float low_;
    float scale_;
};

struct BinCut {
    float cost = std::numeric_limits<float>::infinity();
    int bin = 0;
    float first_surface = 0.0F;
    float second_surface = 0.0F;
};

struct BinContents {
    std::array<Box, most_bins> balls;
    std::array<std::size_t, most_bins> counts{};
    std::size_t all = 0;

    void add(const TreeItem &item, const Bins &bins) {
        const auto bin = static_cast<std::size_t>(bins.bin_of(item));
        balls[bin].add_ball(item);
        ++counts[bin];
        ++all;
    }
};

BinCut best_cut(const BinContents &contents, const Bins &bins) {
    std::array<float, most_bins> surfaces_from{};
    Box after;
    for (int bin = bins.count() - 1; bin > 0; --bin) {
        after.add(contents.balls[static_cast<std::size_t>(bin)]);
        surfaces_from[static_cast<std::size_t>(bin)] = after.surface();
    }
    BinCut best;
    Box before;
    std::size_t count = 0;
    for (int bin = 1; bin < bins.count(); ++bin) {
        const auto i = static_cast<std::size_t>(bin);
        before.add(contents.balls[i - 1]);
        count += contents.counts[i - 1];
        if (count == 0 || count == contents.all)
            continue;
        const float first = before.surface();
        const float cost = first * nodes_for(count) + surfaces_from[i] * nodes_for(contents.all - count);
        if (cost < best.cost)
            best = {cost, bin, first, surfaces_from[i]};
    }
    return best;
}

// If all spheres of the sample are in one bin, uses all spheres of the part.
BinCut best_cut(const Part &part, const Bins &bins) {
    BinContents sample;
    for_each_or_sample(part.items, [&](const TreeItem &item) { sample.add(item, bins); });
    const BinCut cut = best_cut(sample, bins);
    if (cut.bin > 0)
        return cut;
    BinContents all;
    for (const TreeItem &item : part.items)
        all.add(item, bins);
    return best_cut(all, bins);
}

} // namespace

// The loop has no branches, because they would be mispredicted.
PartHalves binned_halves(const Part &part) {
    const Bins bins(part);
    const BinCut cut = best_cut(part, bins);
    std::size_t count = 0;
    for (TreeItem &item : part.items) {
        const TreeItem looked_at = item;
        item = part.items[count];
        part.items[count] = looked_at;
        count += bins.is_before(looked_at, cut.bin) ? 1 : 0;
    }
    const Items first = part.items.first(count);
    const Items second = part.items.subspan(count);
    return {{first, centers_of(first), cut.first_surface}, {second, centers_of(second), cut.second_surface}};
}

// Sorts by counting, because branches would be mispredicted.
PartHalves swept_halves(const Part &part) {
    const std::size_t count = part.items.size();
    std::array<TreeItem, most_swept> best_items{};
    std::size_t best_count = 0;
    float best_cost = std::numeric_limits<float>::infinity();
    float first_surface = 0.0F;
    float second_surface = 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<std::uint32_t, most_swept> places{};
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t other = 0; other < i; ++other) {
                const bool is_before = part.items[other].center_radius[axis] <= part.items[i].center_radius[axis];
                places[i] += is_before ? 1 : 0;
                places[other] += is_before ? 0 : 1;
            }
        std::array<TreeItem, most_swept> items;
        for (std::size_t i = 0; i < count; ++i)
            items[places[i]] = part.items[i];
        std::array<float, most_swept> surfaces_from{};
        Box after;
        for (std::size_t i = count - 1; i > 0; --i) {
            after.add_ball(items[i]);
            surfaces_from[i] = after.surface();
        }
        Box before;
        for (std::size_t i = 1; i < count; ++i) {
            before.add_ball(items[i - 1]);
            const float first = before.surface();
            const float cost = first * nodes_for(i) + surfaces_from[i] * nodes_for(count - i);
            if (cost < best_cost && items[i - 1].center_radius[axis] < items[i].center_radius[axis]) {
                best_items = items;
                best_count = i;
                best_cost = cost;
                first_surface = first;
                second_surface = surfaces_from[i];
            }
        }
    }
    std::copy_n(best_items.begin(), count, part.items.begin());
    const Items first = part.items.first(best_count);
    const Items second = part.items.subspan(best_count);
    return {{first, centers_of(first), first_surface}, {second, centers_of(second), second_surface}};
}

} // namespace pt
