#include "tests/support/light_in_double.h"
#include "tests/support/scene_of.h"

#include <pt/stats.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace opacity {

namespace {

using namespace light_in_double;

class Opacity : public LightInDouble {
protected:
    // Returns the fraction of a sky's light that black capsules let through. The sky's radiance is (3, 4, 5).
    double share_passed(const std::vector<Given::Capsule> &capsules) {
        return mean(image(under_sky(capsules), 256)) / 4.0;
    }

    static Given under_sky(const std::vector<Given::Capsule> &capsules) {
        Given given = black(capsules);
        given.spheres = {{{0, 0, 0}, 100.0, {0, 0, 0}, 2, 0}};
        return given;
    }

    double share_covered(const std::vector<Given::Capsule> &capsules) {
        const Given given = black(capsules);
        pt_render render = picture_of(PT_SAMPLER_SOBOL);
        render.flags = PT_RENDER_COVERAGE;
        render_image(context(), given.scene(), given.camera, render, 256);
        std::vector<float> covered(std::size_t{3} * picture.x * picture.y);
        const pt_image target = image_target(covered, PT_QUANTITY_COVERAGE);
        EXPECT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
        return mean(covered);
    }

    static double mean(const std::vector<float> &values) {
        return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    }

private:
    static Given black(const std::vector<Given::Capsule> &capsules) {
        Given given;
        for (pt_material &material : given.materials)
            std::ranges::fill(material.diffuse, 0.0F);
        given.planes.clear();
        given.camera = camera_at({0, 0, 8}, {0, 0, 0}, 0.05);
        given.capsules = capsules;
        return given;
    }
};

Given::Capsule ball_at(const glm::dvec3 &center, double radius, float opacity) {
    return {{center.x, center.y, center.z}, {center.x, center.y, center.z}, radius, 1, opacity};
}

Given::Capsule rod(const glm::dvec3 &from, const glm::dvec3 &to, float opacity, std::uint32_t material = 1) {
    return {{from.x, from.y, from.z}, {to.x, to.y, to.z}, 1.0, material, opacity};
}

// Five standard errors of 98,304 rays are at most .008. Negative control: opacities that are larger by 3%.
TEST_F(Opacity, IsTheShareOfRaysThatMeet) {
    const auto passed = [&](float first, float second) {
        const std::vector<Given::Capsule> row{ball_at({0, 0, 2}, 1.0, first), ball_at({0, 0, -2}, 1.0, second)};
        const double share = share_passed(row);
        EXPECT_EQ((stats().features & PT_FEATURE_OPACITY) != 0, std::min(first, second) < 1.0F);
        EXPECT_NEAR(share_covered(row), 1.0 - share, 0.008);
        return share;
    };
    EXPECT_NEAR(passed(0.4F, 0.2F), 0.48, 0.008);
    EXPECT_GT(std::abs(passed(0.412F, 0.206F) - 0.48), 0.008);
    EXPECT_NEAR(passed(0.6F, 0.0F), 0.4, 0.008);
    EXPECT_EQ(passed(1.0F, 0.5F), 0.0);
    EXPECT_NEAR(passed(0.0F, 0.0F), 1.0, 1e-6);
}

// The transmitted fractions multiply, even if the surfaces differ in one number. Negative control: duplicates, which
// count once.
TEST_F(Opacity, OfSurfacesThatDifferIsIndependent) {
    const glm::dvec3 atom(0, 0, 1);
    const Given::Capsule bond = rod(atom, {2, 0, 1}, 0.5F);
    const Given::Capsule ball = ball_at(atom, 1.0, 0.5F);
    const struct {
        const char *what;
        Given::Capsule first, second;
    } pairs[] = {{"directions", bond, rod(atom, {0, 2, 1}, 0.5F)},
                 {"swapped ends", bond, rod({2, 0, 1}, atom, 0.5F)},
                 {"opposite", bond, rod(atom, {-2, 0, 1}, 0.5F)},
                 {"a longer one", bond, rod(atom, {4, 0, 1}, 0.5F)},
                 {"an atom and its bond", bond, ball},
                 {"halves of a bond", rod({-2, 0, 1}, atom, 0.5F), bond},
                 {"materials", bond, rod(atom, {2, 0, 1}, 0.5F, 0)},
                 {"radii", ball, ball_at(atom, 1.5, 0.5F)}};
    for (const auto &[what, first, second] : pairs)
        EXPECT_NEAR(share_passed({first, second}), 0.25, 0.008) << what;
    EXPECT_NEAR(share_passed({bond, bond}), 0.5, 0.008) << "duplicates";
    // A larger scene stores places in larger steps.
    for (double extent = 4.0; extent < 100.0; extent *= 2.0)
        for (const glm::dvec3 &place : {glm::dvec3(0, 0, -1), {0, 0.5, 1}, {0.5, 0, 1}})
            EXPECT_NEAR(share_passed({ball, ball_at(place, 1.0, 0.5F), ball_at({extent, 0, 0}, 1.0, 0.0F)}), 0.25,
                        0.008)
                << extent;

    std::vector<Given::Capsule> star;
    for (int i = 0; i < 8; ++i)
        star.push_back(rod(atom, {2 * std::cos(i), 2 * std::sin(i), 1}, 0.1F));
    EXPECT_NEAR(share_passed(star), std::pow(1.0 - std::round(25.5) / 255.0, 8.0), 0.008);
}

TEST_F(Opacity, OfColorsAndMotionsIsIndependent) {
    Given given = under_sky({});
    given.camera.shutter_close = 1.0;
    struct Ball {
        double motion[3];
        float color[3];
    };
    const auto passed = [&](const std::vector<Ball> &balls) {
        static constexpr std::array center{0.0, 0.0, 1.0};
        static constexpr float radius = 1.0F, opacity = 0.5F;
        pt_sphere_array array =
            array_of(balls.size(), {center.data(), 0, PT_TYPE_FLOAT64}, {&radius, 0, PT_TYPE_FLOAT32});
        array.opacity = {&opacity, 0, PT_TYPE_FLOAT32};
        array.motion = {balls[0].motion, sizeof(Ball), PT_TYPE_FLOAT64};
        array.color = {balls[0].color, sizeof(Ball), PT_TYPE_FLOAT32};
        pt_scene scene = given.scene();
        scene.sphere_arrays = &array;
        scene.sphere_array_count = 1;
        return mean(render_image(context(), scene, given.camera, picture_of(PT_SAMPLER_SOBOL), 256)) / 4.0;
    };
    const Ball still{{0, 0, 0}, {1, 1, 1}};
    EXPECT_NEAR(passed({still, {{0, 0, 0}, {1, 0, 0}}}), 0.25, 0.008);
    EXPECT_NEAR(passed({still, {{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 1, 0}}}), 0.125, 0.008);
    EXPECT_NEAR(passed({still, {{0.1, 0, 0}, {1, 1, 1}}}), 0.25, 0.008);
    EXPECT_NEAR(passed({still, still}), 0.5, 0.008) << "duplicates";
}

// Every 16 consecutive points of a pixel's 256 fall into 16 equal intervals. The number of blocked rays then has a
// standard deviation of at most 2, and every pixel must be within five standard deviations. Negative control: random
// numbers, whose standard deviation is 8. Only one branch of a path casts a shadow ray, so these are 256 too.
TEST_F(Opacity, OfOneSurfaceIsEvenlySpreadOverRaysOfCamerasAndShadows) {
    const Given seen = under_sky({ball_at({0, 0, 1}, 1.0, 0.4F)});
    Given shadow;
    std::ranges::fill(shadow.materials[0].diffuse, 0.0F);
    shadow.spheres = {{{0, 50, 0}, 0.1, {0, 0, 0}, 2, 0}};
    shadow.camera = camera_at({0, 3, 4}, {0, -1.5, 0}, 0.05);
    shadow.capsules = {ball_at({0, 10, 0}, 1.0, 0.4F)};
    shadow.capsules.front().material = 0;
    for (const Given &given : {seen, shadow}) {
        const auto image_by = [&](const Given &of, std::uint32_t sampler) {
            return render_image(context(), of.scene(), of.camera, picture_of(sampler), 256);
        };
        Given clear = given;
        clear.capsules.front().opacity = 0.0F;
        const std::vector<float> light = image_by(clear, PT_SAMPLER_SOBOL);
        const auto largest_error = [&](std::uint32_t sampler) {
            const std::vector<float> veiled = image_by(given, sampler);
            double largest = 0.0;
            for (std::size_t i = 0; i < light.size(); ++i)
                largest = std::max(largest, std::abs(veiled[i] / light[i] - 0.6));
            return largest;
        };
        EXPECT_LE(largest_error(PT_SAMPLER_SOBOL), 10.0 / 256.0);
        EXPECT_LE(largest_error(PT_SAMPLER_HALTON_CP), 10.0 / 256.0);
        EXPECT_GT(largest_error(PT_SAMPLER_RANDOM), 20.0 / 256.0);
    }
}

// Every 16 samples have another lattice, so the mean square error falls as with independent samples. The stated error
// may be a tenth too small.
TEST_F(Opacity, OfTwoSurfacesHasManyLattices) {
    Given given = under_sky({ball_at({0, 0, 2}, 1.0, 0.4F), ball_at({0, 0, -2}, 1.0, 0.4F)});
    std::ranges::fill(given.materials[2].emission, 1.0F);
    pt_render render = picture_of(PT_SAMPLER_SOBOL);
    render.width = 96;
    render.height = 64;
    statistics::Moments first{};
    for (const std::uint32_t count : {16U, 64U, 1024U}) {
        std::vector<double> squares;
        for (const float value : render_image(context(), given.scene(), given.camera, render, count))
            squares.push_back((value - 0.36) * (value - 0.36) * count);
        const statistics::Moments found = statistics::moments(squares);
        if (count == 16)
            first = found;
        const double standard_error = std::sqrt((first.variance + found.variance) / (render.width * render.height));
        EXPECT_NEAR(found.mean, first.mean, 5.0 * standard_error) << count;
        EXPECT_GT(error().rmse, 0.9 * std::sqrt(found.mean / count)) << count;
    }
}

Given scaled(Given given, double by) {
    const auto scale = [by](double(&vector)[3]) {
        for (double &component : vector)
            component *= by;
    };
    for (pt_sphere &sphere : given.spheres) {
        scale(sphere.center);
        scale(sphere.motion);
        sphere.radius *= by;
    }
    for (Given::Capsule &capsule : given.capsules) {
        scale(capsule.center);
        scale(capsule.end);
        capsule.radius *= by;
    }
    for (pt_plane &plane : given.planes)
        plane.offset *= by;
    scale(given.camera.position);
    scale(given.camera.target);
    given.camera.aperture *= by;
    given.camera.focus *= by;
    return given;
}

// Short submissions, two devices, another unit of length and another order must keep the bits. Negative control: one
// sample fewer.
TEST_F(Opacity, LeavesNoBitToChance) {
    Given given = scene_of_rods(5, 60);
    for (std::size_t i = 0; i < given.capsules.size(); ++i) {
        given.capsules[i].opacity = static_cast<float>(i % 6) / 5.0F;
        if (i % 3 > 0)
            std::ranges::copy(given.capsules[i].center, given.capsules[i].end);
    }
    given.camera.aperture = 0.5;
    given.camera.focus = 7.0;
    const std::vector<float> whole = image(given, 16);
    EXPECT_NE(image(given, 15), whole);
    EXPECT_EQ(image(scaled(given, 0x1p20), 16), whole);
    Given reversed = given;
    std::ranges::reverse(reversed.capsules);
    EXPECT_EQ(image(reversed, 16), whole);

    const Context hurried = create_context([](pt_create_info &info) { info.submit_milliseconds = 1; });
    const Context shared = create_context([](pt_create_info &) {}, shared_by(2, true));
    for (pt_context *const other : {hurried.get(), shared.get()})
        EXPECT_EQ(render_image(other, given.scene(), given.camera, picture_of(PT_SAMPLER_SOBOL), 16), whole);
}

TEST_F(Opacity, IsRefusedWithTheReason) {
    Given given = scene_of_rods(5, 6);
    const auto refusal = [&] {
        const pt_scene scene = given.scene();
        EXPECT_EQ(pt_set_scene(context(), &scene), PT_ERROR_INVALID_SCENE);
        return std::string(pt_last_error(context()));
    };
    given.capsules[1].opacity = 0.9F;
    given.capsules[4].opacity = 1.5F;
    EXPECT_NE(refusal().find("sphere_arrays[0].opacity[4] = 1.5: must lie in [0, 1]"), std::string::npos);
    given.capsules[4].opacity = 0.5F;
    given.materials[1].flags = PT_MATERIAL_HIDDEN_FROM_CAMERA;
    EXPECT_NE(refusal().find("sphere_arrays[0].material[1] = 1: must be a material that neither emits nor is hidden"),
              std::string::npos);
}

} // namespace

} // namespace opacity
