// Means and standard errors of exact sums, from the device and from the host, against exact whole numbers and long
// double. PT_TEST_SUMS is the number of random sums, where these are to be more.
#include "lib/film/pixel_format.h"
#include "lib/film/quotient.h"
#include "lib/kernel/buffer_writer.h"
#include "lib/kernel/image_reader.h"
#include "lib/kernel/shader_source.h"
#include "tests/device/vulkan_fixture.h"
#include "tests/support/expected_error.h"
#include "tests/support/half_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace {

using pt::WideSum;

constexpr int fraction_bits = static_cast<int>(pt::gpu::FILM_FRACTION_BITS);

// The sums of three channels and the samples of one part of a pixel.
struct ResolvedPart {
    WideSum sums[3];
    std::uint32_t accepted;
};

struct ResolvedPixel {
    ResolvedPart parts[2];
};

// Random, with every length of sums and counts as likely, and with the largest, the smallest, and ties.
class RandomSums {
public:
    std::uint32_t count(std::uint32_t most) {
        switch (kind_(generator_)) {
        case 0:
            return 1;
        case 1:
            return most;
        default:
            return std::max(static_cast<std::uint32_t>(generator_()) >>
                                std::uniform_int_distribution(0, 31)(generator_),
                            1U) %
                       most +
                   1;
        }
    }

    WideSum sum(std::uint32_t count) {
        const WideSum most = (WideSum{count} << (pt::gpu::FILM_MAX_EXPONENT + pt::gpu::FILM_FRACTION_BITS)) - count;
        switch (kind_(generator_)) {
        case 0:
            return 0;
        case 1:
            return 1;
        case 2:
            return most;
        case 3:
        case 4:
        case 5: { // count * (m + 1/2) 2^k, or beside it: between two floats with m and m + 1 of 24 bits
            const WideSum half = 2 * (generator_() % (1U << 23) + (1U << 23)) + 1;
            const int shift = std::uniform_int_distribution(0, 60)(generator_);
            return (half * count << shift) + generator_() % 3 - 1;
        }
        default: {
            const WideSum bits = WideSum{generator_()} << 64 | WideSum{generator_()};
            return (bits >> std::uniform_int_distribution(0, 127)(generator_)) % most;
        }
        }
    }

    ResolvedPixel pixel() {
        const std::uint32_t first = count(UINT32_MAX - 1);
        const std::uint32_t second = count(UINT32_MAX - first);
        ResolvedPixel pixel{{{{sum(first), sum(first), sum(first)}, first}, {{sum(second), 0, 0}, second}}};
        // Means that are equal, or nearly so: what their difference leaves of them is small.
        const WideSum nearly = pixel.parts[0].sums[1] / first * second;
        pixel.parts[1].sums[1] = nearly + kind_(generator_) % 2;
        pixel.parts[1].sums[2] = sum(second);
        return pixel;
    }

private:
    std::mt19937_64 generator_{2026};
    std::uniform_int_distribution<int> kind_{0, 15};
};

// a * 2^shift against b, exactly: -1, 0 or 1.
int compare_shifted(WideSum a, int shift, WideSum b) {
    if (shift < 0)
        return -compare_shifted(b, -shift, a);
    const int room = a >> 64 != 0 ? std::countl_zero(static_cast<std::uint64_t>(a >> 64))
                                  : 64 + std::countl_zero(static_cast<std::uint64_t>(a));
    if (a == 0)
        return b == 0 ? 0 : -1;
    if (shift > room)
        return 1;
    const WideSum shifted = a << shift;
    return shifted < b ? -1 : shifted > b ? 1 : 0;
}

// Half of the sum of a float >= 0 and the next one, as mantissa * 2^exponent.
struct Middle {
    WideSum mantissa;
    int exponent;
};

Middle middle_above(std::uint32_t float_bits) {
    const std::uint32_t exponent = float_bits >> 23;
    const std::uint32_t fraction = float_bits & 0x7fffff;
    const std::uint32_t mantissa = exponent > 0 ? fraction + 0x800000 : fraction;
    return {2 * WideSum{mantissa} + 1, static_cast<int>(std::max(exponent, 1U)) - 127 - 23 - 1};
}

// Whether bits are those of the float nearest to sum * 2^exponent / count, the even one of two that are as near.
bool is_nearest(std::uint32_t bits, WideSum sum, std::uint32_t count, int exponent) {
    const bool even = bits % 2 == 0;
    if (bits < 0x7f800000) { // the next above infinity is none
        const Middle above = middle_above(bits);
        const int order = compare_shifted(above.mantissa * count, above.exponent - exponent, sum);
        if (order < 0 || (order == 0 && !even))
            return false;
    }
    if (bits == 0)
        return true;
    const Middle below = middle_above(bits - 1);
    const int order = compare_shifted(below.mantissa * count, below.exponent - exponent, sum);
    return order < 0 || (order == 0 && even);
}

// (|A b - B a|) 2^exponent / ((a + b) sqrt(a b)), the numerator exact, in 64-bit limbs.
long double exact_standard_error(WideSum sum_a, std::uint32_t a, WideSum sum_b, std::uint32_t b, int exponent) {
    const auto multiplied = [](WideSum sum, std::uint32_t factor) {
        const WideSum low = WideSum{static_cast<std::uint64_t>(sum)} * factor;
        const WideSum high = (sum >> 64) * factor + (low >> 64);
        return std::pair(high, static_cast<std::uint64_t>(low));
    };
    auto larger = multiplied(sum_a, b);
    auto smaller = multiplied(sum_b, a);
    if (larger < smaller)
        std::swap(larger, smaller);
    const WideSum high = larger.first - smaller.first - (larger.second < smaller.second ? 1 : 0);
    const std::uint64_t low = larger.second - smaller.second;
    // Of the 160 bits the leading 64 decide.
    const long double numerator =
        high >> 64 != 0 ? std::ldexp(static_cast<long double>(high), 64) : static_cast<long double>(high << 64 | low);
    const long double sum = static_cast<long double>(a) + b;
    return std::ldexp(numerator / sum / std::sqrt(static_cast<long double>(a) * b), exponent);
}

// Within .52 of the last place, at the edges of float's range too.
bool is_close(float found, long double exact) {
    if (std::isinf(found))
        return exact >= 0x1.ffffffp127L;
    const long double last_place = std::ldexp(1.0L, std::max(std::ilogb(exact == 0 ? 1e-40L : exact), -126) - 23);
    return std::abs(static_cast<long double>(found) - exact) <= 0.52L * last_place;
}

class Resolve : public VulkanFixture {
protected:
    static constexpr std::uint32_t width = 500;
    static constexpr std::uint32_t height = 200;

    void SetUp() override {
        VulkanFixture::SetUp();
        if (const char *const wanted = std::getenv("PT_TEST_SUMS"))
            batches_ = std::strtoul(wanted, nullptr, 10) / (3 * width * height) + 1;
    }

    static pt::PixelSums film_of(const std::vector<ResolvedPixel> &pixels) {
        pt::PixelSums sums;
        sums.resize(pixels.size());
        for (std::uint32_t part = 0; part < pt::gpu::FILM_PARTS; ++part)
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                for (std::size_t word = 0; word < 3 * pt::gpu::FILM_SUM_WORDS; ++word)
                    sums.plane(part, word)[i] = static_cast<std::uint32_t>(
                        pixels[i].parts[part].sums[word / pt::gpu::FILM_SUM_WORDS] >> 32 * (word % 4));
                sums.plane(part, pt::gpu::FILM_ACCEPTED)[i] = pixels[i].parts[part].accepted;
                // So that all pixels have as many, if need be modulo 2^32, as the device counts them.
                sums.plane(part, pt::gpu::FILM_REJECTED)[i] = 100 - pixels[i].parts[part].accepted;
            }
        return sums;
    }

    // What kernel and host make of the sums.
    struct Values {
        std::vector<float> device;
        std::vector<float> host;
    };

    Values resolved(pt::DeviceFilm &film, const pt::PixelSums &sums, double unit, bool standard_error) {
        Values values;
        values.device = floats(read(film, {{0, 0, width, height}, standard_error, unit, {100, 100}}));
        const pt::PixelEstimates estimates = sums.estimates(unit, standard_error);
        values.host = standard_error ? estimates.standard_error : estimates.radiance;
        return values;
    }

    std::vector<std::byte> read(pt::DeviceFilm &film, const pt::ImageQuery &query) {
        std::vector<std::byte> bytes;
        pt::ImageReader(device(), pipelines(), film).read(query, [&](std::span<const std::byte> piece) {
            bytes.insert(bytes.end(), piece.begin(), piece.end());
        });
        return bytes;
    }

    static std::vector<float> floats(std::span<const std::byte> bytes) {
        std::vector<float> values(bytes.size() / sizeof(float));
        std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }

    pt::ResolvePipelines &pipelines() {
        if (!pipelines_)
            pipelines_.emplace(device(), pt::embedded_code().resolve);
        return *pipelines_;
    }

    void TearDown() override {
        pipelines_.reset();
        VulkanFixture::TearDown();
    }

    std::size_t batches_ = 1;

private:
    std::optional<pt::ResolvePipelines> pipelines_;
};

// Units so that the means are what pictures have, and beyond both ends of the range of float.
TEST_F(Resolve, BitsAreThoseOfTheExactQuotient) {
    device_with(pt::vulkan::gpu_like_policy());
    RandomSums random;
    pt::DeviceFilm film(device(), width, height, 30'000);
    pt::PartUse parts;
    parts.extend({0, 200});
    for (std::size_t batch = 0; batch < batches_; ++batch) {
        std::vector<ResolvedPixel> pixels(std::size_t{width} * height);
        std::ranges::generate(pixels, [&] { return random.pixel(); });
        const pt::PixelSums sums = film_of(pixels);
        pt::DeviceFilm::NewSums on_device(device(), film);
        on_device.write(0, sums);
        on_device.replace(parts);
        for (const double unit : {1.0, 0x1p-100, 0x1p110}) {
            const int exponent = std::ilogb(unit) - fraction_bits;
            const Values means = resolved(film, sums, unit, false);
            const Values errors = resolved(film, sums, unit, true);
            ASSERT_TRUE(means.device.size() == 3 * pixels.size() && errors.device.size() == 3 * pixels.size());
            for (std::size_t i = 0; i < means.device.size(); ++i) {
                const ResolvedPart &a = pixels[i / 3].parts[0];
                const ResolvedPart &b = pixels[i / 3].parts[1];
                const WideSum sum_a = a.sums[i % 3];
                const WideSum sum_b = b.sums[i % 3];
                const std::uint32_t count = a.accepted + b.accepted;
                const auto bits = std::bit_cast<std::uint32_t>(means.device[i]);
                ASSERT_TRUE(is_nearest(bits, sum_a + sum_b, count, exponent)) << means.device[i] << " of " << count;
                ASSERT_FALSE(std::isfinite(means.device[i]) && is_nearest(bits + 1, sum_a + sum_b, count, exponent))
                    << "the next float must not pass";
                ASSERT_EQ(bits, std::bit_cast<std::uint32_t>(means.host[i]));
                const long double exact = exact_standard_error(sum_a, a.accepted, sum_b, b.accepted, exponent);
                ASSERT_TRUE(is_close(errors.device[i], exact)) << errors.device[i] << ", not " << exact;
                ASSERT_EQ(std::bit_cast<std::uint32_t>(errors.device[i]), std::bit_cast<std::uint32_t>(errors.host[i]));
            }
        }
    }
}

// A rectangle of the image, across strips and pieces, has the values that the whole image has there.
TEST_F(Resolve, RectanglesArePartsOfTheImage) {
    device_with(pt::vulkan::gpu_like_policy());
    RandomSums random;
    constexpr std::uint32_t wide = 1201;
    constexpr std::uint32_t high = 700; // several pieces
    pt::DeviceFilm film(device(), wide, high, 99'991);
    pt::PartUse parts;
    parts.extend({0, 200});
    std::vector<ResolvedPixel> pixels(std::size_t{wide} * high);
    std::ranges::generate(pixels, [&] { return random.pixel(); });
    pt::DeviceFilm::NewSums on_device(device(), film);
    on_device.write(0, film_of(pixels));
    on_device.replace(parts);
    const auto read_part = [&](const pt::Rectangle &rectangle) {
        return floats(read(film, {rectangle, false, 1.0, {100, 100}}));
    };
    const std::vector<float> all = read_part({0, 0, wide, high});
    ASSERT_EQ(all.size(), 3 * pixels.size());
    for (const pt::Rectangle &part : {pt::Rectangle{0, 0, 1, 1}, pt::Rectangle{1200, 699, 1, 1},
                                      pt::Rectangle{100, 20, 1000, 600}, pt::Rectangle{7, 300, 3, 400}}) {
        const std::vector<float> values = read_part(part);
        ASSERT_EQ(values.size(), 3 * part.pixel_count());
        for (std::size_t i = 0; i < values.size(); ++i) {
            const std::size_t pixel = (part.y + i / 3 / part.width) * wide + part.x + i / 3 % part.width;
            ASSERT_EQ(values[i], all[3 * pixel + i % 3]) << i;
        }
    }
}

// Every float16 number and what is at both sides of the middles between them, and numbers beyond both ends.
TEST_F(Resolve, FormatsAreThoseOfTheHost) {
    device_with(pt::vulkan::gpu_like_policy());
    std::vector<float> numbers = {65536.0F, 1e9F, 0x1p-40F};
    for (std::uint32_t half = 0; half < half_infinity; ++half) {
        const float middle = middle_above_half(half);
        for (const float number :
             {float_of_half(half), std::nextafter(middle, 0.0F), middle, std::nextafter(middle, 1e9F)})
            numbers.push_back(number);
    }
    numbers.resize(3 * std::size_t{width} * height);
    constexpr int exponent = -60; // of the last bit of all of them, and of the sums
    std::vector<ResolvedPixel> pixels(std::size_t{width} * height);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        pixels[i / 3].parts[0].sums[i % 3] = static_cast<WideSum>(std::ldexp(numbers[i], -exponent));
    for (ResolvedPixel &pixel : pixels)
        pixel.parts[0].accepted = 1;
    const pt::PixelSums sums = film_of(pixels);
    pt::DeviceFilm film(device(), width, height, 30'000);
    pt::PartUse parts;
    parts.extend({0, 200});
    pt::DeviceFilm::NewSums on_device(device(), film);
    on_device.write(0, sums);
    on_device.replace(parts);
    pt::ImageQuery query{{0, 0, width, height}, false, std::ldexp(1.0, exponent + fraction_bits), {100, 100}};
    ASSERT_EQ(floats(read(film, query)), numbers);
    for (const std::uint32_t format : {PT_FORMAT_RGBA32F, PT_FORMAT_RGBA16F})
        for (query.standard_error = false;; query.standard_error = true) {
            query.format = format;
            const std::vector<float> values =
                query.standard_error ? std::vector(numbers.size(), std::numeric_limits<float>::infinity()) : numbers;
            std::vector<std::byte> expected(pixels.size() * pt::pixel_bytes(format));
            pt::write_pixels(values, format, expected.data());
            ASSERT_TRUE(read(film, query) == expected) << "format " << format;
            if (query.standard_error)
                break;
        }
}

// Into a buffer of the device, strip by strip of the film and piece by piece of the buffer: the bytes that the host
// reads, at any place, and nothing beside them.
TEST_F(Resolve, BuffersHoldTheImageAndNothingElse) {
    device_with(pt::vulkan::gpu_like_policy());
    RandomSums random;
    constexpr std::uint32_t wide = 101;
    constexpr std::uint32_t high = 60;
    pt::DeviceFilm film(device(), wide, high, 991);
    pt::PartUse parts;
    parts.extend({0, 200});
    std::vector<ResolvedPixel> pixels(std::size_t{wide} * high);
    std::ranges::generate(pixels, [&] { return random.pixel(); });
    pt::DeviceFilm::NewSums on_device(device(), film);
    on_device.write(0, film_of(pixels));
    on_device.replace(parts);
    pt::vulkan::Buffer buffer(device(), pt::vulkan::BufferUse::Storage, 200'000, "test");
    const std::vector<std::byte> guards(buffer.size(), std::byte{0xa5});
    const auto large = pt::BufferWriter::piece_limits(device().limits());
    EXPECT_GE(large.pixels, 1U << 21);
    EXPECT_LE(large.pixels * 16, device().limits().max_storage_buffer_range);
    for (const auto &limits : {large, {500, large.bytes}, {large.pixels, 4000}, {50, 800}, {large.pixels, 16}}) {
        pt::BufferWriter writer(device(), pipelines(), film, limits);
        for (const std::uint32_t format : {PT_FORMAT_RGB32F, PT_FORMAT_RGBA32F, PT_FORMAT_RGBA16F})
            for (const auto &[part, offset, gap] : {std::tuple(pt::Rectangle{0, 0, wide, high}, 0U, 0U),
                                                    {{0, 0, wide, high}, 4U, 12U},
                                                    {{100, 59, 1, 1}, 199'984U, 400U},
                                                    {{17, 3, 61, 41}, 100'300U, 68U}}) {
                const pt::ImageQuery query{part, false, 1.0, {100, 100}, format};
                const std::uint64_t row = std::uint64_t{part.width} * pt::pixel_bytes(format);
                const std::vector<std::byte> image = read(film, query);
                std::vector<std::byte> expected = guards;
                for (std::uint32_t y = 0; y < part.height; ++y)
                    std::ranges::copy(std::span(image).subspan(y * row, row),
                                      expected.begin() + static_cast<std::ptrdiff_t>(offset + y * (row + gap)));
                buffer.upload(guards, 0);
                writer.write(query, {buffer.handle(), offset, row + gap, {}});
                std::vector<std::byte> found(buffer.size());
                buffer.download(found, 0);
                ASSERT_TRUE(found == expected) << "format " << format << ", offset " << offset << ", pieces of "
                                               << limits.pixels << " pixels and " << limits.bytes << " bytes";
            }
    }
}

// Of a call that does not wait the next one tells, and writes nothing.
TEST_F(Resolve, SamplesLostOnTheWayToABufferAreAnError) {
    device_with(pt::vulkan::gpu_like_policy());
    pt::DeviceFilm film(device(), width, height, 30'000);
    pt::PartUse parts;
    parts.extend({0, 200});
    const std::vector<ResolvedPixel> pixels(std::size_t{width} * height, ResolvedPixel{{{{}, 100}, {{}, 100}}});
    pt::PixelSums sums = film_of(pixels);
    sums.plane(1, pt::gpu::FILM_ACCEPTED)[7] = 99;
    pt::DeviceFilm::NewSums on_device(device(), film);
    on_device.write(0, sums);
    on_device.replace(parts);
    pt::vulkan::Buffer buffer(device(), pt::vulkan::BufferUse::Storage, pixels.size() * 12, "test");
    const vk::raii::Semaphore semaphore = device().handle().createSemaphore({});
    const pt::ImageQuery query{{0, 0, width, height}, false, 1.0, {100, 100}};
    const pt::ImageQuery of_one{{0, 0, 1, 1}, false, 1.0, {100, 100}};
    pt::BufferWriter writer(device(), pipelines(), film, pt::BufferWriter::piece_limits(device().limits()));
    const char *const lost = "the driver lost samples of 1 pixels";
    EXPECT_STREQ(error_of([&] { writer.write(query, {buffer.handle(), 0, width * 12, {}}); }).what(), lost);
    writer.write(of_one, {buffer.handle(), 0, width * 12, {}});
    writer.write(query, {buffer.handle(), 0, width * 12, {.wait = {}, .signal = *semaphore}});
    const pt::Error error = error_of([&] { writer.write(of_one, {buffer.handle(), 0, width * 12, {}}); });
    EXPECT_EQ(error.code(), PT_ERROR_INTERNAL);
    EXPECT_STREQ(error.what(), lost);
    writer.write(of_one, {buffer.handle(), 0, width * 12, {}});
}

// In the first of several pieces, while the next is under way: whatever that comes to, the device can go on.
TEST_F(Resolve, LostSamplesAreAnError) {
    device_with(pt::vulkan::gpu_like_policy());
    constexpr std::uint32_t high = 1200;
    pt::DeviceFilm film(device(), width, high, 500'000);
    pt::PartUse parts;
    parts.extend({0, 200});
    const std::vector<ResolvedPixel> pixels(std::size_t{width} * high, ResolvedPixel{{{{}, 100}, {{}, 100}}});
    pt::PixelSums sums = film_of(pixels);
    const auto read_sums = [&] {
        pt::DeviceFilm::NewSums on_device(device(), film);
        on_device.write(0, sums);
        on_device.replace(parts);
        read(film, {{0, 0, width, high}, false, 1.0, {100, 100}});
    };
    read_sums();
    const pt::PixelSums whole = sums;
    sums.plane(1, pt::gpu::FILM_ACCEPTED)[5] = 99;
    sums.plane(0, pt::gpu::FILM_REJECTED)[99'999] = 1;
    for (int again = 0; again < 3; ++again) {
        const pt::Error error = error_of(read_sums);
        EXPECT_EQ(error.code(), PT_ERROR_INTERNAL);
        EXPECT_STREQ(error.what(), "the driver lost samples of 2 pixels");
    }
    sums = whole;
    read_sums();
}

} // namespace
