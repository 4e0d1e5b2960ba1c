#include "lib/code/shader_source.h"
#include "lib/kernel/film_sum.h"
#include "tests/film/film_words.h"
#include "tests/vulkan/device_fixture.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <random>
#include <vector>

namespace {

constexpr std::uint32_t sum_width = 307;
constexpr std::uint32_t sum_height = 331;

class FilmSumTest : public VulkanFixture {
protected:
    void TearDown() override {
        films_.clear();
        devices_.clear();
        VulkanFixture::TearDown();
    }

    void add_film(std::uint32_t max_strip_pixels) {
        devices_.emplace_back(instance(), physical_device(), pt::vulkan::gpu_like_policy());
        films_.emplace_back(devices_.back(), sum_width, sum_height, max_strip_pixels);
        pt::PixelSums sums;
        sums.resize(films_.back().pixel_count());
        for (std::uint32_t part = 0; part < pt::gpu::FILM_PARTS; ++part)
            for (std::size_t plane = 0; plane < pt::gpu::FILM_WORDS; ++plane)
                for (std::uint32_t &word : sums.plane(part, plane))
                    word = random_word();
        fill(devices_.back(), films_.back(), sums);
    }

    void add_films() {
        add_film(1U << 30);
        add_film(sum_width * 100);
        add_film(sum_width * 45);
    }

    pt::PixelSums sum_on_host(const pt::PixelRange &pixels) {
        pt::PixelSums all;
        all.resize(pixels.count);
        pt::PixelSums one = all;
        films_.front().read(pixels.first, all);
        for (std::size_t i = 1; i < films_.size(); ++i) {
            films_[i].read(pixels.first, one);
            all.add(one);
        }
        return all;
    }

    std::vector<pt::FilmSum::Source> sources() {
        std::vector<pt::FilmSum::Source> sources;
        for (std::size_t i = 0; i < films_.size(); ++i)
            sources.push_back({devices_[i], films_[i]});
        return sources;
    }

    pt::vulkan::ComputePipeline pipeline() { return pt::add_pipeline(devices_.front(), pt::embedded_code().add); }

    static pt::PixelSums sums_in(pt::FilmSum &sum, const pt::PixelRange &pixels) {
        pt::PixelSums sums;
        sums.resize(pixels.count);
        sum.film().read(pixels.first, sums);
        return sums;
    }

    std::deque<pt::vulkan::Device> devices_;
    std::deque<pt::DeviceFilm> films_;

private:
    std::uint32_t random_word() {
        return generator_() % 4 == 0 ? UINT32_MAX : static_cast<std::uint32_t>(generator_() >> 2);
    }

    std::mt19937 generator_{2026};
};

TEST_F(FilmSumTest, IsThatOfTheHost) {
    add_films();
    const pt::vulkan::ComputePipeline add = pipeline();
    constexpr std::uint32_t rows = 200;
    pt::FilmSum sum(sources(), add, rows);
    const pt::PixelRange all{0, sum_width * sum_height};
    const pt::PixelSums before = sum_on_host(all);
    for (const std::uint32_t first_row : {0U, 64U, sum_height - rows})
        for (const pt::PixelRange rows_wanted : {pt::PixelRange{0, rows}, {7, 1}, {40, 130}}) {
            sum.gather(first_row, {(first_row + rows_wanted.first) * sum_width, rows_wanted.count * sum_width});
            const pt::PixelRange in_sum{rows_wanted.first * sum_width, rows_wanted.count * sum_width};
            EXPECT_TRUE(sums_in(sum, in_sum) == sum_on_host({in_sum.first + first_row * sum_width, in_sum.count}))
                << rows_wanted.count << " rows from " << first_row << " + " << rows_wanted.first;
        }
    EXPECT_TRUE(sum_on_host(all) == before) << "films are only read";
}

} // namespace
