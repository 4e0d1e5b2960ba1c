#include "lib/denoise/doubts.h"

#include "lib/denoise/terms.h"
#include "lib/film/tile_errors.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pt {

namespace {

constexpr std::size_t block_step = 16;

// The expected change of a pixel's squared error by its moves, summed over channels.
struct Change {
    std::size_t pixel;
    double window;
    double square;
    double relative_square;
};

using Measure = double Change::*;

std::vector<Change> changes_by_pixel(const Halves &halves) {
    std::vector<Change> changes;
    for (std::size_t y = 0; y < halves.height; ++y)
        for (std::size_t x = 0; x < halves.width; ++x) {
            Change change{changes.size(), 1.0, 0.0, 0.0};
            for (std::size_t channel = 0; channel < channel_count; ++channel) {
                const Terms terms = terms_at(halves, x, y, channel);
                change.square += terms.change();
                change.relative_square += terms.weight * terms.change();
            }
            changes.push_back(change);
        }
    return changes;
}

struct Blocks {
    explicit Blocks(std::size_t pixels) : pixel_count(pixels), count((pixels + block_step - 1) / block_step) {}

    std::size_t begin(std::size_t block) const { return std::max(block * block_step, block_step / 2) - block_step / 2; }
    std::size_t end(std::size_t block) const { return std::min(begin(block) + 2 * block_step, pixel_count); }

    double window(std::size_t block, std::size_t pixel) const {
        const double position = (static_cast<double>(pixel) + 0.5) / block_step - 0.5;
        const double inside = std::clamp(position, 0.0, static_cast<double>(count - 1));
        return std::max(1.0 - std::abs(inside - static_cast<double>(block)), 0.0);
    }

    std::size_t pixel_count;
    std::size_t count;
};

// Sorts changes by size. Returns the length of the longest prefix whose changes together do not raise the error.
std::ptrdiff_t harmless_count(std::vector<Change> &changes, Measure measure) {
    constexpr double standard_errors = 2.0;
    std::ranges::stable_sort(changes, {}, [=](const Change &change) { return std::abs(change.*measure); });
    std::ptrdiff_t harmless = 0;
    double sum = 0.0;
    double variance = 0.0;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        sum += changes[i].*measure;
        variance += squared(changes[i].*measure);
        if (sum + standard_errors * std::sqrt(variance) <= 0.0)
            harmless = static_cast<std::ptrdiff_t>(i) + 1;
    }
    return harmless;
}

// Removes changes until the rest raises neither the error nor the relative error.
void take_doubtful_out(std::vector<Change> &changes) {
    std::size_t before = 0;
    do {
        before = changes.size();
        for (const Measure measure : {&Change::square, &Change::relative_square})
            changes.erase(changes.begin() + harmless_count(changes, measure), changes.end());
    } while (changes.size() < before);
}

} // namespace

void take_back_doubtful_moves(Halves &halves) {
    const std::vector<Change> changes = changes_by_pixel(halves);
    std::vector<double> shares(changes.size());
    const Blocks columns(halves.width);
    const Blocks rows(halves.height);
    for (std::size_t row = 0; row < rows.count; ++row)
        for (std::size_t column = 0; column < columns.count; ++column) {
            std::vector<Change> of_block;
            for (std::size_t y = rows.begin(row); y < rows.end(row); ++y)
                for (std::size_t x = columns.begin(column); x < columns.end(column); ++x) {
                    Change change = changes[y * halves.width + x];
                    change.window = rows.window(row, y) * columns.window(column, x);
                    change.square *= change.window;
                    change.relative_square *= change.window;
                    of_block.push_back(change);
                }
            take_doubtful_out(of_block);
            for (const Change &change : of_block)
                shares[change.pixel] += change.window;
        }
    for (std::size_t i = 0; i < halves.value_count(); ++i) {
        const auto share = static_cast<float>(shares[i / channel_count]);
        halves.first_move[i] *= share;
        halves.second_move[i] *= share;
    }
}

} // namespace pt
