#include "cli/image/tone_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace {

using cli::apply_curve;
using cli::Color;
using cli::ToneCurve;
using cli::ToneMap;

constexpr ToneCurve all_curves[] = {ToneCurve::none, ToneCurve::reinhard, ToneCurve::aces, ToneCurve::agx,
                                    ToneCurve::neutral};

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
    return cli::encode_srgb(std::min(light, 1.0));
}

TEST(ToneMap, SrgbAnchors) {
    EXPECT_EQ(cli::encode_srgb(0.0), 0.0);
    EXPECT_NEAR(cli::encode_srgb(1.0), 1.0, rounding);
    EXPECT_NEAR(cli::encode_srgb(0.5), 0.7353569830524495, rounding);
    EXPECT_NEAR(cli::encode_srgb(0.18), 0.46135612950044164, rounding);
    EXPECT_NEAR(cli::encode_srgb(0.001), 0.01292, rounding);
}

// The standard rounds the break point to 7 decimals. The gap is the slope times half a unit of the last decimal.
TEST(ToneMap, SrgbPiecesMeet) {
    constexpr double break_point = 0.0031308;
    const double above = cli::encode_srgb(std::nextafter(break_point, 1.0));
    EXPECT_NEAR(above, cli::encode_srgb(break_point), 12.92 * 0.5e-7);
    EXPECT_NE(above, cli::encode_srgb(break_point)); // Negative control: without the linear piece both sides agree.
}

TEST(ToneMap, CurvesNeverFall) {
    EXPECT_TRUE(is_nondecreasing(&encode));
    for (const ToneCurve curve : all_curves) {
        EXPECT_TRUE(is_nondecreasing([curve](double x) {
            return apply_curve(curve, {x, x, x})[1];
        })) << cli::tone_curves.name(curve);
    }
    EXPECT_FALSE(is_nondecreasing([](double x) { return x - 2e-3 * std::sin(1e3 * x); })); // Negative control.
}

TEST(ToneMap, CurvesStayInTheDisplayAndKeepBlack) {
    constexpr double brightest = std::numeric_limits<float>::max();
    for (const ToneCurve curve : all_curves) {
        expect_color(apply_curve(curve, {0.0, 0.0, 0.0}), {0.0, 0.0, 0.0}, 0.0);
        for (const Color &color : {Color{brightest, 0.0, 0.0}, Color{brightest, brightest, brightest}})
            for (const double component : apply_curve(curve, color))
                EXPECT_TRUE(component >= 0.0 && component <= 1.0) << component;
    }
}

TEST(ToneMap, NoneClamps) {
    expect_color(apply_curve(ToneCurve::none, {0.25, 1.0, 1.5}), {0.25, 1.0, 1.0}, 0.0);
}

TEST(ToneMap, ReinhardIsOnTheLuminance) {
    expect_color(apply_curve(ToneCurve::reinhard, {1.0, 1.0, 1.0}), {0.5, 0.5, 0.5}, rounding);
    const Color color = apply_curve(ToneCurve::reinhard, {1.0, 0.5, 0.25});
    EXPECT_NEAR(color[0] / color[1], 2.0, rounding); // 0.5 / 0.333 if each channel had its own curve
    EXPECT_NEAR(color[1] / color[2], 2.0, rounding);
}

TEST(ToneMap, AcesAnchors) {
    expect_color(apply_curve(ToneCurve::aces, {1.0, 0.18, 0.0}), {2.54 / 3.16, 0.2668989203894968, 0.0}, rounding);
}

TEST(ToneMap, AgxAnchors) {
    expect_color(apply_curve(ToneCurve::agx, {0.18, 0.18, 0.18}),
                 {0.21446743070720334, 0.21453266862054834, 0.21453672826813272}, rounding);
    expect_color(apply_curve(ToneCurve::agx, {1.0, 0.2, 0.05}),
                 {0.6533598827094625, 0.2536195947288043, 0.107880509867948}, rounding);
    // Sobotka's sigmoid maps middle grey to half the signal. The polynomial approximates it with a root mean square
    // error of sqrt(3.67e-6) = 0.0019.
    EXPECT_NEAR(std::pow(apply_curve(ToneCurve::agx, {0.18, 0.18, 0.18})[1], 1.0 / 2.2), 0.5, 3 * 0.0019);
}

TEST(ToneMap, NeutralAnchors) {
    // The curve subtracts the 4% of Fresnel reflection. Near black it subtracts less.
    expect_color(apply_curve(ToneCurve::neutral, {0.5, 0.3, 0.2}), {0.46, 0.26, 0.16}, rounding);
    expect_color(apply_curve(ToneCurve::neutral, {0.05, 0.05, 0.05}), {0.015625, 0.015625, 0.015625}, rounding);
    expect_color(apply_curve(ToneCurve::neutral, {1.0, 1.0, 1.0}),
                 {0.8690909090909091, 0.8690909090909091, 0.8690909090909091}, rounding);
    expect_color(apply_curve(ToneCurve::neutral, {2.0, 0.5, 0.1}), {0.96, 0.3211357586512865, 0.15077196095829626},
                 rounding);
}

TEST(ToneMap, EightBits) {
    ToneMap map;
    const float color[] = {0.0F, 0.5F, 2.0F};
    // 0.7353569830524495 * 255 = 187.5
    EXPECT_EQ(cli::map_to_bytes(color, map), (std::vector<std::uint8_t>{0, 188, 255}));
    map.gamma = 1.0;
    EXPECT_EQ(cli::map_to_bytes(color, map), (std::vector<std::uint8_t>{0, 128, 255})); // 127.5 rounds up
    map.gamma = 2.2;                                                                    // 255 * 0.5^(1 / 2.2) = 186.08
    EXPECT_EQ(cli::map_to_bytes(color, map), (std::vector<std::uint8_t>{0, 186, 255}));
}

TEST(ToneMap, ExposureIsInStops) {
    ToneMap map;
    map.gamma = 1.0;
    map.exposure = 2.0;
    const float color[] = {0.125F, 0.25F, 0.0F};
    EXPECT_EQ(cli::map_to_bytes(color, map), (std::vector<std::uint8_t>{128, 255, 0}));
    map.exposure = -1.0;
    EXPECT_EQ(cli::map_to_bytes(color, map), (std::vector<std::uint8_t>{16, 32, 0})); // 15.94 and 31.88
}

using cli::automatic_exposure;

std::vector<float> grey(std::initializer_list<float> pixels) {
    std::vector<float> radiance;
    for (const float pixel : pixels)
        radiance.insert(radiance.end(), 3, pixel);
    return radiance;
}

TEST(Exposure, TheAverageOfLogarithmsBecomesMiddleGrey) {
    EXPECT_EQ(automatic_exposure(grey({0.18F})), 0.0);
    EXPECT_EQ(automatic_exposure(grey({0.72F})), -2.0);
    EXPECT_EQ(automatic_exposure(grey({0.09F, 0.36F})), 0.0);
    EXPECT_EQ(automatic_exposure(grey({0x1p-20F * 0.09F, 0x1p-20F * 0.36F})), 20.0) << "moves with the picture";
}

// A hundredth of the pixels is 2^20 times as bright. The level would be 2^20 / 100^4 from these pixels alone.
TEST(Exposure, HardlyDependsOnLamps) {
    std::vector<float> radiance = grey({0x1p20F * 0.18F});
    radiance.resize(3 * 100, 0.18F);
    EXPECT_NEAR(automatic_exposure(radiance), -20.0 / 100.0, 0.01);
}

// Half of the picture is at most 2^-40. The weight of this half is 128 * 2^-40 / level.
TEST(Exposure, WhatLooksBlackDoesNotCount) {
    EXPECT_EQ(automatic_exposure(grey({0.18F, 0x1p-40F, 0.18F, 0x1p-60F})), 0.0);
}

TEST(Exposure, APixelIsTheMeanOfItsChannels) {
    EXPECT_EQ(automatic_exposure(std::array{0.0F, 0.0F, 0.54F}), 0.0); // the luminance would be 0.039
    EXPECT_EQ(automatic_exposure(std::array{0.54F, 0.0F, 0.0F}), 0.0);
}

TEST(Exposure, BlackPixelsDoNotCount) {
    EXPECT_EQ(automatic_exposure(grey({0.0F, 0.72F, 0.0F, 0.0F})), -2.0);
    EXPECT_EQ(automatic_exposure(grey({0.0F, 0.0F})), 0.0);
    EXPECT_EQ(automatic_exposure({}), 0.0);
}

TEST(Exposure, IsRoundedAndStaysAmongWhatCanBeGiven) {
    EXPECT_EQ(automatic_exposure(grey({0.5F})), -1.47); // log2(0.18 / 0.5) = -1.474
    EXPECT_EQ(automatic_exposure(grey({std::numeric_limits<float>::max()})), -64.0);
    EXPECT_EQ(automatic_exposure(grey({std::numeric_limits<float>::denorm_min()})), 64.0);
}

} // namespace
