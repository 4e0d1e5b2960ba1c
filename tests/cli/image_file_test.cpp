#include "cli/image/image_file.h"
#include "cli/image/tone_map.h"
#include "tests/cli/refusal_of.h"
#include "tests/cli/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <random>
#include <tuple>

namespace {

using cli::ImageWriter;
using cli::LayerKind;

const std::vector<cli::ImageAttribute> attributes{
    {"samplesPerPixel", 64}, {"pt.exposure", 1.5}, {"pt.seed", "18446744073709551615"}};

cli::ImageTarget target(const std::string &path) {
    return cli::image_target(path, std::nullopt);
}

void write_bytes(const std::string &path, std::uint32_t width, std::uint32_t height,
                 std::span<const std::uint8_t> bytes) {
    ImageWriter().write(target(path),
                        {.window = cli::whole_window(width, height), .signals = bytes, .attributes = attributes});
}

template <typename Value>
std::vector<Value> read_pixels(const std::string &path, OIIO::TypeDesc type) {
    const auto input = OIIO::ImageInput::open(path);
    if (!input) {
        ADD_FAILURE() << OIIO::geterror();
        return {};
    }
    const OIIO::ImageSpec &spec = input->spec();
    std::vector<Value> values(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
    EXPECT_TRUE(input->read_image(0, 0, 0, spec.nchannels, type, values.data()));
    return values;
}

TEST(ImageFile, FormatFollowsTheExtension) {
    EXPECT_EQ(cli::image_format("a.b.PNG").value().name, "png");
    EXPECT_EQ(cli::image_format("x.JPEG").value().name, "jpeg");
    for (const char *path : {"", "exr", ".exr", "a.tiff", "a.exr/", "a.exr.bak", "dir.png/a"})
        EXPECT_FALSE(cli::image_format(path)) << path;
}

TEST(ImageFile, ExrKeepsEveryBit) {
    const TemporaryFolder folder;
    const std::vector<float> radiance{
        0.0F,     0.1F,   1.0F / 3.0F, std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min(),
        135.0F,   1e-30F, 2.0F,
        65504.5F, // above the largest float16
        5.0F,     6.0F,   7.0F};
    const cli::ImageLayer layer{"", LayerKind::color, 3, radiance};
    ImageWriter().write(target(folder.file("a.exr")), {.window = cli::whole_window(2, 2), .layers = {&layer, 1}});
    EXPECT_EQ(read_pixels<float>(folder.file("a.exr"), OIIO::TypeDesc::FLOAT), radiance);
    EXPECT_EQ(folder.count(), 1);
}

TEST(ImageFile, ALayerIsReadByItsName) {
    const TemporaryFolder folder;
    const std::vector<float> main{1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F};
    const std::vector<float> count{16.0F, 32.0F};
    const std::array<cli::ImageLayer, 2> layers{
        {{"", LayerKind::color, 3, main}, {"count", LayerKind::color, 1, count}}};
    const cli::ImageWindow window{{3, 4, 1, 2}, 10, 20};
    ImageWriter().write(target(folder.file("a.exr")), {.window = window, .layers = layers});
    const cli::DecodedImage image = cli::read_image(folder.file("a.exr"));
    EXPECT_EQ(std::tuple(image.x, image.y, image.width, image.height), std::tuple(3, 4, 1U, 2U));
    EXPECT_EQ(std::tuple(image.full_width, image.full_height, image.is_float), std::tuple(10U, 20U, true));
    EXPECT_EQ(image.layer(""), main);
    EXPECT_EQ(image.layer("count"), (std::vector<float>{16.0F, 16.0F, 16.0F, 32.0F, 32.0F, 32.0F}));
}

TEST(ImageFile, PngKeepsNamesInUtf8) {
    const TemporaryFolder folder;
    const std::string name = "sc\xc3\xa8ne.json"; // libpng reads international text chunks as UTF-8
    const cli::ImageAttribute named{"pt.scene", name};
    const std::array<std::uint8_t, 3> bytes{1, 2, 3};
    ImageWriter().write(target(folder.file("a.png")),
                        {.window = cli::whole_window(1, 1), .signals = bytes, .attributes = {&named, 1}});
    EXPECT_EQ(OIIO::ImageInput::open(folder.file("a.png"))->spec().get_string_attribute("pt.scene"), name);
    EXPECT_NE(folder.read("a.png").find("iTXtpt.scene"), std::string::npos);
}

// Several megabytes of noise make libpng write many chunks.
TEST(ImageFile, PngKeepsALargePicture) {
    const TemporaryFolder folder;
    std::vector<std::uint8_t> bytes(std::size_t{1000} * 700 * 3);
    std::minstd_rand random(1);
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<std::uint8_t>(random() >> 16); });
    write_bytes(folder.file("a.png"), 1000, 700, bytes);
    EXPECT_EQ(read_pixels<std::uint8_t>(folder.file("a.png"), OIIO::TypeDesc::UINT8), bytes);
}

TEST(ImageFile, PngOfOtherProgramsIsRead) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.png");
    const std::array<std::uint16_t, 8> words{0, 1, 300, 65535, 256, 40000, 65534, 65535}; // also two opaque RGBA pixels
    for (const auto type : {OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT16}) {
        for (const int channels : {1, 3, 4}) {
            const auto output = OIIO::ImageOutput::create(path);
            ASSERT_TRUE(output && output->open(path, OIIO::ImageSpec(2, 1, channels, type)) &&
                        output->write_image(OIIO::TypeDesc::UINT16, words.data()) && output->close());
            const cli::DecodedImage image = cli::read_image(path);
            EXPECT_EQ(std::tuple(image.width, image.full_height, image.is_float), std::tuple(2U, 1U, false));
            std::vector<float> expected = read_pixels<float>(path, OIIO::TypeDesc::FLOAT);
            if (channels == 1)
                expected = {expected[0], expected[0], expected[0], expected[1], expected[1], expected[1]};
            EXPECT_EQ(image.values, expected);
        }
    }
    std::filesystem::resize_file(path, 60);
    EXPECT_EQ(refusal_of([&] { cli::read_image(path); }).message, "cannot read " + path + ": the file ends too early");
}

TEST(ImageFile, JpegHasMetadataInItsDescription) {
    const TemporaryFolder folder;
    write_bytes(folder.file("a.jpg"), 1, 1, std::array<std::uint8_t, 3>{1, 2, 3});
    const auto input = OIIO::ImageInput::open(folder.file("a.jpg"));
    ASSERT_TRUE(input);
    EXPECT_EQ(input->spec().get_string_attribute("ImageDescription"),
              "samplesPerPixel: 64\npt.exposure: 1.5\npt.seed: 18446744073709551615");
}

TEST(ImageFile, LongestSidesHold) {
    const TemporaryFolder folder;
    for (const char *name : {"a.png", "a.jpg"}) {
        const std::uint32_t side = cli::image_format(name).value().longest_side;
        const std::vector<std::uint8_t> bytes(std::size_t{side} * 3, 200);
        EXPECT_NO_THROW(write_bytes(folder.file(name), side, 1, bytes));
        const auto read = read_pixels<std::uint8_t>(folder.file(name), OIIO::TypeDesc::UINT8);
        EXPECT_EQ(read.size(), bytes.size());
        EXPECT_TRUE(std::ranges::all_of(read, [](int value) { return std::abs(value - 200) <= 1; })) << name;
    }
}

TEST(ToneMap, PartsOfALargePictureAreItsPixels) {
    constexpr std::size_t count = 180'003; // three or more parts of at least 60,000 components
    std::vector<float> radiance(count);
    for (std::size_t i = 0; i < count; ++i)
        radiance[i] = static_cast<float>(i % 1009) / 1009.0F;
    cli::ToneMap map{};
    map.display.struct_size = sizeof map.display;
    std::vector<std::uint8_t> expected;
    for (std::size_t first = 0; first < count; first += 30'000) {
        const auto part = cli::map_to_bytes(
            std::span(radiance).subspan(first).first(std::min<std::size_t>(30'000, count - first)), map);
        expected.insert(expected.end(), part.begin(), part.end());
    }
    EXPECT_EQ(cli::map_to_bytes(radiance, map), expected);
}

} // namespace
