// See analytic_fixture.h.
#include "tests/analytic/analytic_fixture.h"

#include "tests/analytic/contexts.h"

#include <bit>
#include <cstdio>
#include <fstream>

namespace analytic {

Context AnalyticFixture::create_fixtures_context() {
    return create_context([](pt_create_info &) {}, &create);
}

void AnalyticFixture::TearDown() {
    const bool has_tree = (stats().features & PT_FEATURE_TREE) != 0;
    EXPECT_TRUE(has_tree || !always_tree);
    BatchFixture::TearDown();
}

Image AnalyticFixture::image_of(const pt_scene &scene, const pt_camera &camera, const pt_render &render,
                                std::uint32_t sample_count) {
    Image image{render.width, render.height, std::vector<float>(std::size_t{3} * render.width * render.height)};
    set_up(scene, camera);
    EXPECT_EQ(pt_set_render(context(), &render), PT_OK) << pt_last_error(context());
    accumulate(sample_count);
    readback(image.radiance);
    EXPECT_EQ(stats().rejected_samples, 0U);
    return image;
}

// As a portable float map: rows from the bottom, a negative scale for little endian.
void AnalyticFixture::keep(const Image &image, const std::string &name) {
    const std::string path = testing::TempDir() + name + ".pfm";
    std::ofstream file(path, std::ios::binary);
    file << "PF\n"
         << image.width << ' ' << image.height << '\n'
         << (std::endian::native == std::endian::little ? -1 : 1) << '\n';
    const std::size_t row_floats = std::size_t{3} * image.width;
    for (std::uint32_t y = image.height; y-- > 0;)
        file.write(reinterpret_cast<const char *>(image.radiance.data() + y * row_floats),
                   static_cast<std::streamsize>(row_floats * sizeof(float)));
    std::printf("the image is in %s\n", path.c_str());
}

} // namespace analytic
