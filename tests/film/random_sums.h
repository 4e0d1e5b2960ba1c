#pragma once

#include "lib/film/pixel_sums.h"
#include "lib/film/quotient.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

struct ResolvedPart {
    pt::WideSum sums[3];
    std::uint32_t accepted;
    std::uint32_t done = 100; // accepted and rejected
};

struct ResolvedPixel {
    ResolvedPart parts[2];
};

class RandomSums {
public:
    std::uint32_t count(std::uint32_t most) {
        switch (kind_(generator_)) {
        case 0:
            return 1;
        case 1:
            return most;
        default:
            return std::max(static_cast<std::uint32_t>(generator_()) >>
                                std::uniform_int_distribution(0, 31)(generator_),
                            1U) %
                       most +
                   1;
        }
    }

    pt::WideSum sum(std::uint32_t count) {
        const pt::WideSum most =
            (pt::WideSum{count} << (pt::gpu::FILM_MAX_EXPONENT + pt::gpu::FILM_FRACTION_BITS)) - count;
        switch (kind_(generator_)) {
        case 0:
            return 0;
        case 1:
            return 1;
        case 2:
            return most;
        case 3:
        case 4:
        case 5: { // a tie between the mantissas m and m + 1, count * (m + 1/2) 2^k, or a neighbor of it
            const pt::WideSum half = 2 * (generator_() % (1U << 23) + (1U << 23)) + 1;
            const int shift = std::uniform_int_distribution(0, 60)(generator_);
            return (half * count << shift) + generator_() % 3 - 1;
        }
        default: {
            const pt::WideSum bits = pt::WideSum{generator_()} << 64 | pt::WideSum{generator_()};
            return (bits >> std::uniform_int_distribution(0, 127)(generator_)) % most;
        }
        }
    }

    ResolvedPixel pixel() {
        const std::uint32_t first = count(UINT32_MAX - 1);
        const std::uint32_t second = count(UINT32_MAX - first);
        ResolvedPixel pixel{{{{sum(first), sum(first), sum(first)}, first}, {{sum(second), 0, 0}, second}}};
        const pt::WideSum nearly = pixel.parts[0].sums[1] / first * second;
        pixel.parts[1].sums[1] = nearly + kind_(generator_) % 2;
        pixel.parts[1].sums[2] = sum(second);
        return pixel;
    }

    std::vector<ResolvedPixel> pixels(std::size_t count) {
        std::vector<ResolvedPixel> pixels(count);
        std::ranges::generate(pixels, [&] { return pixel(); });
        return pixels;
    }

private:
    std::mt19937_64 generator_{2026};
    std::uniform_int_distribution<int> kind_{0, 15};
};

inline pt::PixelSums film_of(const std::vector<ResolvedPixel> &pixels) {
    pt::PixelSums sums;
    sums.resize(pixels.size());
    for (std::uint32_t part = 0; part < pt::gpu::FILM_PARTS; ++part)
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const auto &[of_channels, accepted, done] = pixels[i].parts[part];
            for (std::size_t word = 0; word < 3 * pt::gpu::FILM_SUM_WORDS; ++word)
                sums.plane(part, word)[i] =
                    static_cast<std::uint32_t>(of_channels[word / pt::gpu::FILM_SUM_WORDS] >> 32 * (word % 4));
            sums.plane(part, pt::gpu::FILM_ACCEPTED)[i] = accepted;
            sums.plane(part, pt::gpu::FILM_REJECTED)[i] = done - accepted;
        }
    return sums;
}
