#include "lib/kernel/host_fold.h"

#include "tests/film/film_words.h"
#include "tests/vulkan/device_fixture.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <vector>

namespace {

constexpr std::uint32_t fold_width = 16;
constexpr std::uint32_t fold_height = 12;

pt::PixelSums random_sums() {
    std::mt19937 random(5);
    pt::PixelSums sums;
    sums.resize(std::size_t{fold_width} * fold_height);
    for (std::uint32_t part = 0; part < pt::gpu::FILM_PARTS; ++part)
        for (std::size_t plane = 0; plane < pt::gpu::FILM_WORDS; ++plane) {
            const bool is_rare = plane == 3 || plane == 7 || plane == 11 || plane == pt::gpu::FILM_REJECTED;
            for (std::uint32_t &word : sums.plane(part, plane))
                word = is_rare ? 0U : static_cast<std::uint32_t>(random());
        }
    return sums;
}

class HostFold : public VulkanFixture {
protected:
    void SetUp() override {
        VulkanFixture::SetUp();
        film_.emplace(device(), fold_width, fold_height, 70U);
        if (!film_->is_host_memory())
            GTEST_SKIP() << "the film is in the device's own memory";
        ASSERT_GT(film_->strips().size(), 1U);
        fill(device(), *film_, before_);
    }

    void TearDown() override {
        film_.reset();
        VulkanFixture::TearDown();
    }

    pt::PixelSums words() {
        pt::PixelSums sums;
        sums.resize(film_->pixel_count());
        film_->read(0, sums);
        return sums;
    }

    pt::PixelSums folded(std::span<const pt::PixelRange> pixels, std::uint32_t into) const {
        pt::PixelSums sums = before_;
        for (const pt::PixelRange &range : pixels)
            sums.add_part(into, range.first, before_, 1 - into, range.first, range.count);
        return sums;
    }

    pt::PixelSums before_ = random_sums();
    std::optional<pt::DeviceFilm> film_;
};

TEST_F(HostFold, AddsThePartsOfItsPixels) {
    const std::vector<pt::PixelRange> pixels = {{3, 5}, {60, 40}, {191, 1}};
    for (std::uint32_t into = 0; into < pt::gpu::FILM_PARTS; ++into) {
        fill(device(), *film_, before_);
        pt::HostFold fold(*film_, into);
        ASSERT_TRUE(fold.fold(pixels));
        fold.keep();
        EXPECT_TRUE(words() == folded(pixels, into)) << into;
        EXPECT_FALSE(words() == folded(pixels, 1 - into)) << "parts look alike";
    }
    EXPECT_FALSE(words() == before_);
}

TEST_F(HostFold, IsUndoneUnlessItIsKept) {
    {
        pt::HostFold fold(*film_, 1);
        ASSERT_TRUE(fold.fold({{0, film_->pixel_count()}}));
        EXPECT_FALSE(words() == before_);
    }
    EXPECT_TRUE(words() == before_);
}

TEST_F(HostFold, LeavesRareWordsToKernels) {
    for (const std::size_t plane : {std::size_t{3}, std::size_t{7}, std::size_t{11}, std::size_t{13}}) {
        before_.plane(1, plane)[100] = 1;
        fill(device(), *film_, before_);
        pt::HostFold fold(*film_, 0);
        EXPECT_FALSE(fold.fold({{80, 30}})) << plane;
        EXPECT_TRUE(words() == before_) << plane;
        EXPECT_TRUE(pt::HostFold(*film_, 0).fold({{80, 20}, {101, 9}})) << "of other pixels";
        before_.plane(1, plane)[100] = 0;
    }
}

TEST_F(HostFold, TakesInWhereRareWordsAre) {
    before_.plane(0, 3)[100] = 7;
    fill(device(), *film_, before_);
    const std::vector<pt::PixelRange> pixels = {{80, 30}};
    pt::HostFold fold(*film_, 0);
    ASSERT_TRUE(fold.fold(pixels));
    fold.keep();
    EXPECT_TRUE(words() == folded(pixels, 0));
}

} // namespace
