// Tests of cli/byte_encoder: the table against the function that it stands for.
#include "cli/image/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using Encode = std::function<double(double)>;

std::uint8_t exact_byte(const Encode &encode, double light) {
    return static_cast<std::uint8_t>(std::lround(encode(light) * 255.0));
}

// Where bytes begin, beside that, and anywhere; small numbers as often as large ones.
void expect_exact(const Encode &encode, const std::string &name) {
    const cli::ByteEncoder byte_of(encode);
    const auto expect = [&](double light) {
        ASSERT_EQ(byte_of(light), exact_byte(encode, light)) << name << " of " << light;
    };
    std::mt19937_64 generator(2026);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 20'000; ++i) {
        expect(uniform(generator));
        expect(std::exp2(-100.0 * uniform(generator)));
    }
    for (const double light : {0.0, 1e-300, 0.5, 1.0, std::nextafter(1.0, 0.0)}) {
        expect(light);
    }
    for (int cell = 0; cell < 4096; ++cell) {
        expect(cell / 4096.0);
        expect(std::nextafter(cell / 4096.0, 1.0));
        expect(std::nextafter(cell / 4096.0, 0.0));
    }
    for (int byte = 1; byte < 256; ++byte) {
        double below = 0.0;
        double least = 1.0;
        while (std::nextafter(below, 1.0) < least) {
            const double middle = below + (least - below) / 2.0;
            (exact_byte(encode, middle) >= byte ? least : below) = middle;
        }
        expect(below);
        expect(least);
    }
}

TEST(ByteEncoder, IsExact) {
    expect_exact(&cli::encode_srgb, "sRGB");
    for (const double gamma : {0.1, 1.0, 2.2, 10.0}) {
        expect_exact([gamma](double light) { return std::pow(light, 1.0 / gamma); }, std::to_string(gamma));
    }
}

} // namespace
