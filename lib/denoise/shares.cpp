#include "lib/denoise/shares.h"

#include "lib/denoise/terms.h"
#include "lib/film/tile_errors.h"

#include <algorithm>
#include <array>

namespace pt {

namespace {

enum Sum : std::size_t { gain, noise_square, free_products, limit_products, products, sum_count };

using Sums = std::array<double, sum_count>;

class Evidence {
public:
    explicit Evidence(const Halves &halves) : shares_(halves), sums_(shares_.numbers.size()), largest_(sums_.size()) {}

    void add_pixel(std::size_t tile, const Sums &pixel) {
        for (std::size_t sum = 0; sum < sum_count; ++sum)
            sums_[tile][sum] += pixel[sum];
        if (pixel[gain] > largest_[tile][gain])
            largest_[tile] = pixel;
    }

    // Lowers each share to the best share for all pixels, and to the best share without the pixel that gains most.
    void lower(Tiles &shares) {
        lower_by_sums(shares);
        for (std::size_t tile = 0; tile < sums_.size(); ++tile)
            for (std::size_t sum = 0; sum < sum_count; ++sum)
                sums_[tile][sum] -= largest_[tile][sum];
        lower_by_sums(shares);
    }

private:
    Tiles about(Sum sum) const {
        Tiles tiles = shares_;
        for (std::size_t tile = 0; tile < sums_.size(); ++tile)
            tiles.numbers[tile] = sums_[tile][sum];
        spread(tiles);
        return tiles;
    }

    void lower_by_sums(Tiles &shares) const {
        const std::array<Tiles, sum_count> near{about(gain), about(noise_square), about(free_products),
                                                about(limit_products), about(products)};
        for (std::size_t tile = 0; tile < sums_.size(); ++tile) {
            const auto of = [&](Sum sum) { return near[sum].numbers[tile]; };
            const double whole = of(noise_square) + faults(of(free_products), of(limit_products), of(products));
            const double best = whole > 0.0 ? std::max(of(gain) / whole, 0.0) : 0.0;
            shares.numbers[tile] = std::min(shares.numbers[tile], best);
        }
    }

    Tiles shares_;
    std::vector<Sums> sums_;
    std::vector<Sums> largest_;
};

} // namespace

Tiles best_shares(const Halves &halves) {
    Evidence absolute(halves);
    Evidence relative(halves);
    for_each_pixel(halves, [&](std::size_t tile, std::size_t x, std::size_t y) {
        Sums pixel{};
        Sums relative_pixel{};
        for (std::size_t channel = 0; channel < channel_count; ++channel) {
            const Terms terms = terms_at(halves, x, y, channel);
            const Sums value{-terms.noise * terms.noise_change(), squared(terms.noise_change()),
                             terms.first_free * terms.second_free,
                             (terms.first_move - terms.first_free) * (terms.second_move - terms.second_free),
                             terms.first_move * terms.second_move};
            for (std::size_t sum = 0; sum < sum_count; ++sum) {
                pixel[sum] += value[sum];
                relative_pixel[sum] += terms.weight * value[sum];
            }
        }
        absolute.add_pixel(tile, pixel);
        relative.add_pixel(tile, relative_pixel);
    });
    Tiles shares(halves);
    std::ranges::fill(shares.numbers, 1.0);
    absolute.lower(shares);
    relative.lower(shares);
    return shares;
}

} // namespace pt
