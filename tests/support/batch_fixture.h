#pragma once

#include "tests/support/context_fixture.h"
#include "tests/support/statistics.h"

#include <cmath>
#include <span>
#include <vector>

struct Estimate {
    double mean;
    double standard_error;
};

// For each batch, the red means of all blocks.
using Batches = std::vector<std::vector<double>>;

inline Estimate estimate_over(const Batches &batches, std::span<const std::size_t> pixels) {
    std::vector<double> values;
    for (const std::vector<double> &image : batches) {
        double sum = 0.0;
        for (const std::size_t pixel : pixels)
            sum += image[pixel];
        values.push_back(sum / static_cast<double>(pixels.size()));
    }
    const statistics::Moments moments = statistics::moments(values);
    return {moments.mean, std::sqrt(moments.variance / static_cast<double>(values.size()))};
}

inline Estimate estimate_of_pixel(const Batches &batches, std::size_t pixel) {
    return estimate_over(batches, std::span(&pixel, 1));
}

// Two-sided quantile of Student's t by Wallace's approximation (Ann. Math. Statist. 30, 1959). From 8 degrees of
// freedom on, its error is at most 0.02.
inline double student_bound(double false_alarm, std::size_t batch_count) {
    const double degrees = static_cast<double>(batch_count) - 1.0;
    const double z = statistics::normal_quantile(0.5 * false_alarm) * (8.0 * degrees + 3.0) / (8.0 * degrees + 1.0);
    return std::sqrt(degrees * std::expm1(z * z / degrees));
}

class BatchFixture : public ContextFixture {
protected:
    void set_up(const pt_scene &scene, const pt_camera &camera) {
        ASSERT_EQ(pt_set_scene(context(), &scene), PT_OK) << pt_last_error(context());
        ASSERT_EQ(pt_set_camera(context(), &camera), PT_OK) << pt_last_error(context());
    }

    // Plain Halton ignores seeds, so its batches are successive samples. Their errors partly cancel, and the standard
    // error is an upper bound.
    Batches render_batches(pt_render render, uint32_t batch_count, uint32_t samples) {
        Batches batches;
        for (uint32_t batch = 0; batch < batch_count; ++batch) {
            if (render.sampler == PT_SAMPLER_HALTON)
                render.first_sample = batch * samples;
            else
                ++render.seed;
            EXPECT_EQ(pt_set_render(context(), &render), PT_OK) << pt_last_error(context());
            accumulate(samples);
            const std::uint32_t rows = render.row_count ? render.row_count : render.height - render.first_row;
            std::vector<float> image(std::size_t{3} * render.width * rows);
            readback(image);
            EXPECT_EQ(stats().rejected_samples, 0U);
            std::vector<double> red(image.size() / 3);
            for (std::size_t i = 0; i < red.size(); ++i)
                red[i] = static_cast<double>(image[3 * i]);
            batches.push_back(red);
        }
        return batches;
    }
};
