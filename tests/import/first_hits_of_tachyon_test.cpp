// What Tachyon shows of two scenes, in which every surface has a colour of its own, is what this program's camera and
// surfaces have there.
#include "tests/import/imported.h"
#include "tests/support/first_hit_reference.h"

#include <gtest/gtest.h>

namespace {

constexpr std::uint32_t width = 96;
constexpr std::uint32_t height = 64;

// 10 (i + 1) in red is ball i, in green plane i.
class TachyonPicture {
public:
    explicit TachyonPicture(const std::string &name, std::uint32_t sphere_count) :
        bytes_(imported::text_of(name)),
        first_(bytes_.find("\n255\n") + 5),
        sphere_count_(sphere_count) {
        EXPECT_EQ(bytes_.size() - first_, 3 * width * height);
    }

    std::uint32_t object(std::uint32_t column, std::uint32_t row) const {
        const std::size_t place = first_ + 3 * (row * width + column);
        const auto red = static_cast<unsigned char>(bytes_[place]);
        const auto green = static_cast<unsigned char>(bytes_[place + 1]);
        return red > 0 ? red / 10U - 1U : sphere_count_ + green / 10U - 1U;
    }

private:
    std::string bytes_;
    std::size_t first_;
    std::uint32_t sphere_count_;
};

// How many pixels show something else, of those that are certain. Tachyon looks through their upper right corners.
std::uint32_t differences(const cli::SceneFile &file, const TachyonPicture &picture) {
    pt_render render{};
    render.width = width;
    render.height = height;
    const pt_scene scene = file.scene();
    const first_hits::View view(file.camera, render);
    std::uint32_t count = 0;
    std::uint32_t certain = 0;
    for (std::uint32_t row = 0; row < height; ++row) {
        for (std::uint32_t column = 0; column < width; ++column) {
            const auto met = first_hits::first_met(scene, view, view.ray(column, row, 1.0L, 0.0L, 0.0L));
            certain += met ? 1 : 0;
            count += met && met->object != picture.object(column, row) ? 1 : 0;
        }
    }
    EXPECT_GT(certain, width * height - 40U);
    return count;
}

TEST(FirstHitsOfTachyon, AreThoseHere) {
    for (const std::string name : {"perspective", "parallel"}) {
        SCOPED_TRACE(name);
        cli::SceneFile file = cli::parse_scene(imported::text_of(name + ".dat"), name);
        ASSERT_EQ(file.width, width);
        ASSERT_EQ(file.height, height);
        ASSERT_EQ(file.spheres.size(), 25U); // with a lamp
        const TachyonPicture picture(name + ".ppm", 25);
        EXPECT_EQ(differences(file, picture), 0U);
        file.camera.up[0] = -file.camera.up[0]; // the picture tells
        EXPECT_GT(differences(file, picture), 300U);
    }
}

} // namespace
