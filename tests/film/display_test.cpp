#include "lib/display/tone_curve.h"
#include "lib/scene_file/enumerations.h"
#include "tests/support/sized.h"

#include <pt/display.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace {

using pt::apply_curve;
using pt::Color;

constexpr std::span<const std::uint32_t> all_curves = pt::curves.values();

constexpr double rounding = 1e-12;

void expect_color(const Color &color, const Color &expected, double tolerance) {
    for (std::size_t channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(color[channel], expected[channel], tolerance) << "channel " << channel;
}

bool is_nondecreasing(const std::function<double(double)> &curve) {
    double last = curve(0.0);
    for (int i = 0; i <= 20'000; ++i) {
        const double value = curve(std::exp2(-14.0 + i / 1000.0));
        if (!(value >= last))
            return false;
        last = value;
    }
    return true;
}

double encode(double light) {
    return pt::encode_srgb(std::min(light, 1.0));
}

TEST(ToneCurve, CurvesNeverFall) {
    EXPECT_TRUE(is_nondecreasing(&encode));
    for (const std::uint32_t curve : all_curves) {
        ASSERT_TRUE(pt::is_curve(curve)) << curve;
        EXPECT_TRUE(is_nondecreasing([curve](double x) {
            return apply_curve(curve, {x, x, x})[1];
        })) << "curve "
            << curve;
    }
    EXPECT_FALSE(is_nondecreasing([](double x) { return x - 2e-3 * std::sin(1e3 * x); })); // Negative control.
}

TEST(ToneCurve, CurvesStayInTheDisplayAndKeepBlack) {
    constexpr double brightest = std::numeric_limits<float>::max();
    for (const std::uint32_t curve : all_curves) {
        expect_color(apply_curve(curve, {0.0, 0.0, 0.0}), {0.0, 0.0, 0.0}, 0.0);
        for (const Color &color : {Color{brightest, 0.0, 0.0}, Color{brightest, brightest, brightest}})
            for (const double component : apply_curve(curve, color))
                EXPECT_TRUE(component >= 0.0 && component <= 1.0) << component;
    }
}

TEST(ToneCurve, ReinhardIsOnTheLuminance) {
    expect_color(apply_curve(PT_CURVE_REINHARD, {1.0, 1.0, 1.0}), {0.5, 0.5, 0.5}, rounding);
    const Color color = apply_curve(PT_CURVE_REINHARD, {1.0, 0.5, 0.25});
    EXPECT_NEAR(color[0] / color[1], 2.0, rounding); // would be 0.5 / 0.333 if each channel had its own curve
    EXPECT_NEAR(color[1] / color[2], 2.0, rounding);
}

TEST(ToneCurve, AcesAnchors) {
    expect_color(apply_curve(PT_CURVE_ACES, {1.0, 0.18, 0.0}), {2.54 / 3.16, 0.2668989203894968, 0.0}, rounding);
}

TEST(ToneCurve, AgxAnchors) {
    expect_color(apply_curve(PT_CURVE_AGX, {0.18, 0.18, 0.18}),
                 {0.21446743070720334, 0.21453266862054834, 0.21453672826813272}, rounding);
    expect_color(apply_curve(PT_CURVE_AGX, {1.0, 0.2, 0.05}),
                 {0.6533598827094625, 0.2536195947288043, 0.107880509867948}, rounding);
    // Sobotka's sigmoid maps middle grey to half the signal. The polynomial approximates it with a root mean square
    // error of sqrt(3.67e-6) = 0.0019.
    EXPECT_NEAR(std::pow(apply_curve(PT_CURVE_AGX, {0.18, 0.18, 0.18})[1], 1.0 / 2.2), 0.5, 3 * 0.0019);
}

TEST(ToneCurve, NeutralAnchors) {
    // The curve subtracts the 4% of Fresnel reflection. Near black it subtracts less.
    expect_color(apply_curve(PT_CURVE_NEUTRAL, {0.5, 0.3, 0.2}), {0.46, 0.26, 0.16}, rounding);
    expect_color(apply_curve(PT_CURVE_NEUTRAL, {0.05, 0.05, 0.05}), {0.015625, 0.015625, 0.015625}, rounding);
    expect_color(apply_curve(PT_CURVE_NEUTRAL, {1.0, 1.0, 1.0}),
                 {0.8690909090909091, 0.8690909090909091, 0.8690909090909091}, rounding);
    expect_color(apply_curve(PT_CURVE_NEUTRAL, {2.0, 0.5, 0.1}), {0.96, 0.3211357586512865, 0.15077196095829626},
                 rounding);
}

pt_display_info display_of(const std::vector<float> &radiance, std::uint32_t curve = PT_CURVE_NONE) {
    auto display = sized<pt_display_info>();
    display.curve = curve;
    display.pixel_count = radiance.size() / 3;
    display.radiance = radiance.data();
    return display;
}

template <typename Component>
std::vector<Component> pixels_of(pt_display_info display) {
    std::vector<Component> pixels(display.pixel_count * (display.alpha ? 4 : 3));
    display.bits = 8 * sizeof(Component);
    display.pixels = pixels.data();
    display.size_bytes = pixels.size() * sizeof(Component);
    EXPECT_EQ(pt_display(&display), PT_OK) << pt_last_error(nullptr);
    return pixels;
}

const auto read_bytes = &pixels_of<std::uint8_t>;
using Components = std::vector<std::uint8_t>;

TEST(Display, ExposureIsInStops) {
    const std::vector<float> color{0.125F, 0.25F, -1.0F}; // below 0 is black
    pt_display_info display = display_of(color);
    display.gamma = 1.0;
    display.exposure = 2.0;
    EXPECT_EQ(read_bytes(display), (Components{128, 255, 0}));
    display.exposure = -1.0;
    EXPECT_EQ(read_bytes(display), (Components{16, 32, 0})); // 15.94 and 31.88
}

// Pixels from 2^-16 to 2^4, and black.
std::vector<float> random_radiance(std::size_t pixels) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> stops(-16.0F, 4.0F);
    std::vector<float> radiance(3 * pixels);
    for (std::size_t i = 3; i < radiance.size(); ++i)
        radiance[i] = std::exp2(stops(random));
    return radiance;
}

// Whether a component is a nearest integer of the exact number. pow and three other operations on numbers up to 65535
// have relative errors of up to 2^-52 each.
bool is_nearest(std::uint64_t component, long double exact) {
    return std::abs(static_cast<long double>(component) - exact) <= 0.5L + 65535.0L * 4.0L * 0x1p-52L;
}

// The exposure is a whole number, so the light before the curve is exact.
template <typename Component>
void expect_nearest(const pt_display_info &display) {
    const std::vector<Component> pixels = pixels_of<Component>(display);
    for (std::size_t i = 0; i < pixels.size(); i += 3) {
        Color color{};
        for (std::size_t channel = 0; channel < 3; ++channel)
            color[channel] = std::ldexp(display.radiance[i + channel], static_cast<int>(display.exposure));
        color = apply_curve(display.curve, color);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const long double light = color[channel];
            const long double signal = display.gamma != 0.0
                                           ? std::pow(light, 1.0L / static_cast<long double>(display.gamma))
                                       : light <= 0.0031308L ? 12.92L * light
                                                             : 1.055L * std::pow(light, 1.0L / 2.4L) - 0.055L;
            const long double exact = signal * std::numeric_limits<Component>::max();
            ASSERT_TRUE(is_nearest(pixels[i + channel], exact)) << i << ": " << exact;
            ASSERT_FALSE(is_nearest(pixels[i + channel] + 1U, exact)) << "negative control";
        }
    }
}

TEST(Display, ComponentsAreTheNearestIntegers) {
    const std::vector<float> radiance = random_radiance(2'000);
    for (const std::uint32_t curve : all_curves)
        for (const double gamma : {0.0, 1.0, 2.2})
            for (const double exposure : {-3.0, 0.0, 5.0}) {
                pt_display_info display = display_of(radiance, curve);
                display.gamma = gamma;
                display.exposure = exposure;
                expect_nearest<std::uint8_t>(display);
                expect_nearest<std::uint16_t>(display);
            }
}

TEST(Display, AlphaDividesTheRadianceAndIsNotEncoded) {
    const std::vector<float> opaque{0.5F, 0.25F, 0.125F, 0.5F, 0.25F, 0.125F, 9.0F, 9.0F, 9.0F};
    const std::vector<float> radiance{0.125F, 0.0625F, 0.03125F, 0.5F, 0.25F, 0.125F, 9.0F, 9.0F, 9.0F};
    const std::vector<float> alpha{0.25F, 1.0F, 0.0F};
    pt_display_info display = display_of(radiance);
    display.alpha = alpha.data();
    const Components color = read_bytes(display_of(opaque));
    EXPECT_EQ(read_bytes(display),
              (Components{color[0], color[1], color[2], 64, color[3], color[4], color[5], 255, 0, 0, 0, 0}));
    EXPECT_EQ(pixels_of<std::uint16_t>(display)[3], 16384); // 65535 / 4 = 16383.75
    const std::vector<float> largest(3, std::numeric_limits<float>::max());
    const std::vector<float> faint{0x1p-100F}; // the quotient is no float
    for (const std::uint32_t curve : all_curves) {
        display = display_of(largest, curve);
        display.alpha = faint.data();
        EXPECT_GT(read_bytes(display)[0], 150) << curve;
    }
}

TEST(Display, WhiteLightBecomesGreyOfItsLuminance) {
    const std::vector<float> radiance{1.0F, 0.5F, 0.25F};
    pt_display_info display = display_of(radiance);
    for (double &component : display.white)
        component = radiance[static_cast<std::size_t>(&component - display.white)];
    display.gamma = 1.0;
    constexpr double luminance = 0.2126 + 0.7152 * 0.5 + 0.0722 * 0.25;
    const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * luminance));
    EXPECT_EQ(read_bytes(display), (Components{grey, grey, grey}));
    const std::vector<float> many = random_radiance(1'000);
    pt_display_info neutral = display_of(many, PT_CURVE_AGX);
    const auto without = pixels_of<std::uint16_t>(neutral);
    std::fill(std::begin(neutral.white), std::end(neutral.white), 1.0);
    EXPECT_EQ(pixels_of<std::uint16_t>(neutral), without);
    neutral.white[2] = 0.9;
    EXPECT_NE(pixels_of<std::uint16_t>(neutral), without); // Negative control.
}

TEST(Display, PixelsNeedNoAlignmentAndNoMoreRoomThanTheyTake) {
    const std::vector<float> radiance = random_radiance(7);
    pt_display_info display = display_of(radiance);
    const auto expected = pixels_of<std::uint16_t>(display);
    std::vector<std::byte> room(2 * expected.size() + 2, std::byte{7});
    display.bits = 16;
    display.pixels = &room[1];
    display.size_bytes = 2 * expected.size();
    ASSERT_EQ(pt_display(&display), PT_OK);
    EXPECT_EQ(std::memcmp(&room[1], expected.data(), 2 * expected.size()), 0);
    EXPECT_TRUE(room.front() == std::byte{7} && room.back() == std::byte{7});
    display = display_of({});
    EXPECT_EQ(pt_display(&display), PT_OK) << "no pixels";
}

TEST(Display, ARefusalNamesFieldValueAndRule) {
    std::vector<float> radiance{1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F};
    std::vector<float> alpha{1.0F, 0.5F};
    Components bytes(8, 7);
    const auto refusal = [&](const std::function<void(pt_display_info &)> &change) {
        pt_display_info display = display_of(radiance);
        display.alpha = alpha.data();
        display.pixels = bytes.data();
        display.size_bytes = bytes.size();
        change(display);
        EXPECT_EQ(pt_display(&display), PT_ERROR_INVALID_ARGUMENT);
        EXPECT_EQ(bytes, Components(8, 7));
        return std::string(pt_last_error(nullptr));
    };
    using Info = pt_display_info &;
    EXPECT_EQ(refusal([](Info display) { display.curve = std::uint32_t{all_curves.size()}; }),
              "display.curve = " + std::to_string(all_curves.size()) + ": must be a PT_CURVE_* of pt/display.h");
    EXPECT_EQ(refusal([](Info display) { display.bits = 10; }), "display.bits = 10: must be 8 or 16, or 0");
    EXPECT_EQ(refusal([](Info display) { display.exposure = 64.5; }), "display.exposure = 64.5: must be in [-64, 64]");
    EXPECT_EQ(refusal([](Info display) { display.exposure = std::nan(""); }),
              "display.exposure = nan: must be in [-64, 64]");
    EXPECT_EQ(refusal([](Info display) {
                  display.exposure = 1.0;
                  display.automatic_exposure = 1;
              }),
              "display.exposure = 1: must be 0, since automatic_exposure is set");
    EXPECT_EQ(refusal([](Info display) { display.gamma = 0.05; }), "display.gamma = 0.05: must be in [0.1, 10], or 0");
    EXPECT_EQ(refusal([](Info display) { display.white[1] = 1.0; }),
              "display.white[0] = 0: must be in [0.001, 1000], or all must be 0\n"
              "display.white[2] = 0: must be in [0.001, 1000], or all must be 0");
    EXPECT_EQ(refusal([](Info display) { display.size_bytes = 7; }),
              "display.size_bytes = 7: must be >= pixel_count times 3, or 4 with alpha, times bits / 8");
    EXPECT_EQ(refusal([](Info display) { display.pixels = nullptr; }), "display.pixels = NULL: must not be NULL");
    EXPECT_EQ(refusal([](Info display) { display.radiance = nullptr; }), "display.radiance = NULL: must not be NULL");
    EXPECT_EQ(refusal([](Info display) { display.struct_size = 2; }).find("display.struct_size = 2"), 0U);
    EXPECT_EQ(refusal([](Info display) { display.pixel_count = UINT64_MAX; }).find("display.pixel_count = 1.8446"), 0U);
    alpha[1] = 1.5F;
    EXPECT_EQ(refusal([](Info) {}), "display.alpha[1] = 1.5: must lie in [0, 1]");
    radiance[4] = std::numeric_limits<float>::infinity();
    EXPECT_EQ(refusal([](Info display) { display.alpha = nullptr; }), "display.radiance[4] = inf: must be finite");
    double exposure = 7.0;
    EXPECT_EQ(pt_automatic_exposure(radiance.data(), 2, &exposure), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(pt_last_error(nullptr), "display.radiance[4] = inf: must be finite");
    EXPECT_EQ(exposure, 7.0);
    EXPECT_EQ(pt_automatic_exposure(radiance.data(), 1, nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(pt_display(nullptr), PT_ERROR_INVALID_ARGUMENT);
}

double automatic_exposure(std::span<const float> radiance) {
    double exposure = -1000.0;
    EXPECT_EQ(pt_automatic_exposure(radiance.data(), radiance.size() / 3, &exposure), PT_OK);
    return exposure;
}

std::vector<float> grey(std::initializer_list<float> pixels) {
    std::vector<float> radiance;
    for (const float pixel : pixels)
        radiance.insert(radiance.end(), 3, pixel);
    return radiance;
}

// Black pixels do not count. Pixels below 1/128 of the mean have less weight: a value v gets the weight 128 v / mean.
TEST(Exposure, TheAverageOfLogarithmsBecomesMiddleGrey) {
    const std::pair<std::vector<float>, double> cases[] = {
        {grey({0.72F}), -2.0},
        {grey({0.09F, 0.36F}), 0.0},
        {grey({0x1p-20F * 0.09F, 0x1p-20F * 0.36F}), 20.0},
        {grey({0.18F, 0x1p-40F, 0.18F, 0x1p-60F}), 0.0},
        {grey({0.0F, 0.72F, 0.0F, 0.0F}), -2.0},
        {grey({0.0F, 0.0F}), 0.0},
        {{}, 0.0},
        {{0.0F, 0.0F, 0.54F}, 0.0}, // the mean of the channels; the luminance would be 0.039
        {{-5.0F, 0.54F, 0.0F}, 0.0},
        {grey({0.5F}), -1.47}, // log2(0.18 / 0.5) = -1.474
        {grey({std::numeric_limits<float>::max()}), -64.0},
        {grey({std::numeric_limits<float>::denorm_min()}), 64.0},
    };
    for (const auto &[radiance, expected] : cases)
        EXPECT_EQ(automatic_exposure(radiance), expected) << testing::PrintToString(radiance);
}

// A hundredth of the pixels are 2^20 times as bright. These pixels alone would give the level 2^20 / 100^4.
TEST(Exposure, HardlyDependsOnLamps) {
    std::vector<float> radiance = grey({0x1p20F * 0.18F});
    radiance.resize(3 * 100, 0.18F);
    EXPECT_NEAR(automatic_exposure(radiance), -20.0 / 100.0, 0.01);
}

TEST(Exposure, OfADisplayIsThatOfItsPixels) {
    const std::vector<float> radiance = random_radiance(500);
    pt_display_info display = display_of(radiance);
    const Components without = read_bytes(display);
    display.exposure = automatic_exposure(radiance);
    const Components expected = read_bytes(display);
    display.exposure = 0.0;
    display.automatic_exposure = 1;
    EXPECT_EQ(read_bytes(display), expected);
    EXPECT_NE(expected, without); // Negative control.
}

} // namespace
