// PNG by libpng, because OpenImageIO loads slowly.
#include "cli/base/file.h"
#include "cli/image/image_file.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

namespace cli {
namespace {

// Exceptions must not cross libpng's C frames.
[[noreturn]] void fail(png_structp png, png_const_charp reason) {
    *static_cast<std::string *>(png_get_error_ptr(png)) = reason;
    png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

struct Encoding {
    std::vector<unsigned char> file;
    std::string error;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &error, &fail, &ignore);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;

    Encoding() {
        if (info == nullptr) {
            png_destroy_write_struct(&png, nullptr);
            throw std::bad_alloc();
        }
        png_set_write_fn(png, this, &Encoding::append, &Encoding::flush);
    }
    Encoding(const Encoding &) = delete;
    Encoding &operator=(const Encoding &) = delete;
    ~Encoding() { png_destroy_write_struct(&png, &info); }

    static void flush(png_structp) {}

    // NOLINTNEXTLINE(readability-non-const-parameter): libpng prescribes the type
    static void append(png_structp png, png_bytep bytes, std::size_t size) {
        auto &file = static_cast<Encoding *>(png_get_io_ptr(png))->file;
        bool fits = true;
        try {
            file.insert(file.end(), bytes, bytes + size);
        } catch (const std::bad_alloc &) {
            fits = false;
        }
        if (!fits)
            png_error(png, "out of memory");
    }
};

// Text chunks are in Latin-1, and international text chunks in UTF-8. The result points into both arguments.
std::vector<png_text> texts_of(const ImageData &image, std::span<std::string> values) {
    std::vector<png_text> texts;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const bool is_ascii = std::ranges::all_of(values[i], [](unsigned char byte) { return byte < 0x80; });
        png_text text{};
        text.compression = is_ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
        text.key = const_cast<char *>(image.attributes[i].name.c_str()); // libpng does not change the text
        text.text = values[i].data();
        texts.push_back(text);
    }
    return texts;
}

// sRGB, or a power with Rec. 709's primaries (ITU-R BT.709, table 1). PNG, ISO 15948, 11.3.3.
void set_color_space(const Encoding &encoding, std::optional<double> gamma) {
    if (!gamma) {
        png_set_sRGB_gAMA_and_cHRM(encoding.png, encoding.info, PNG_sRGB_INTENT_PERCEPTUAL);
    } else {
        png_set_gAMA(encoding.png, encoding.info, 1.0 / *gamma);
        png_set_cHRM(encoding.png, encoding.info, 0.3127, 0.3290, 0.64, 0.33, 0.30, 0.60, 0.15, 0.06);
    }
}

std::vector<png_bytep> rows_of(const ImageData &image) {
    std::vector<png_bytep> rows(image.window.part.height);
    const std::size_t row_bytes = image.signals.size() / rows.size();
    for (std::size_t y = 0; y < rows.size(); ++y) // libpng does not change the rows
        rows[y] = const_cast<png_bytep>(&image.signals[y * row_bytes]);
    return rows;
}

// A long jump would skip destructors, so no object here has one.
bool write(Encoding &encoding, const ImageData &image, std::span<png_text> texts, png_bytepp rows) {
    if (setjmp(png_jmpbuf(encoding.png)) != 0) // NOLINT(cert-err52-cpp): libpng reports errors by long jumps
        return false;
    png_set_IHDR(encoding.png, encoding.info, image.window.part.width, image.window.part.height, 8,
                 image.has_alpha() ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    set_color_space(encoding, image.gamma);
    // This filter is faster than the default.
    png_set_filter(encoding.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_level(encoding.png, 4);
    png_set_text(encoding.png, encoding.info, texts.data(), static_cast<int>(texts.size()));
    png_set_rows(encoding.png, encoding.info, rows);
    png_write_png(encoding.png, encoding.info, PNG_TRANSFORM_IDENTITY, nullptr);
    return true;
}

struct Decoding {
    std::span<const std::byte> rest;
    std::string error;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &error, &fail, &ignore);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;

    explicit Decoding(std::span<const std::byte> file) : rest(file) {
        if (info == nullptr) {
            png_destroy_read_struct(&png, nullptr, nullptr);
            throw std::bad_alloc();
        }
        png_set_read_fn(png, this, &Decoding::take);
    }
    Decoding(const Decoding &) = delete;
    Decoding &operator=(const Decoding &) = delete;
    ~Decoding() { png_destroy_read_struct(&png, &info, nullptr); }

    static void take(png_structp png, png_bytep bytes, std::size_t size) {
        auto &rest = static_cast<Decoding *>(png_get_io_ptr(png))->rest;
        if (size > rest.size())
            png_error(png, "the file ends too early");
        std::memcpy(bytes, rest.data(), size);
        rest = rest.subspan(size);
    }
};

bool read(Decoding &decoding) {
    if (setjmp(png_jmpbuf(decoding.png)) != 0) // NOLINT(cert-err52-cpp): libpng reports errors by long jumps
        return false;
    png_read_png(decoding.png, decoding.info,
                 PNG_TRANSFORM_EXPAND | PNG_TRANSFORM_GRAY_TO_RGB | PNG_TRANSFORM_SWAP_ENDIAN, nullptr);
    return true;
}

constexpr std::size_t signature_size = 8;

template <typename Number>
void append_row(std::vector<float> &values, png_const_bytep row, std::size_t count) {
    std::vector<Number> numbers(count);
    std::memcpy(numbers.data(), row, count * sizeof(Number));
    for (const Number number : numbers)
        values.push_back(static_cast<float>(number) / static_cast<float>(std::numeric_limits<Number>::max()));
}

} // namespace

std::vector<unsigned char> encode_png(const ImageData &image) {
    std::vector<std::string> values(image.attributes.size());
    std::ranges::transform(image.attributes, values.begin(), &attribute_text);
    std::vector<png_text> texts = texts_of(image, values);
    std::vector<png_bytep> rows = rows_of(image);
    Encoding encoding;
    if (!write(encoding, image, texts, rows.data()))
        throw std::runtime_error(encoding.error);
    return std::move(encoding.file);
}

void decode_png(const std::string &path, DecodedImage &image) {
    const std::string file = read_file(path, [](platform::InputFile &input) {
        const std::string head(input.first(signature_size));
        const bool is_png = png_sig_cmp(reinterpret_cast<png_const_bytep>(head.data()), 0, head.size()) == 0;
        return is_png ? input.all() : head; // libpng then refuses the file
    });
    Decoding decoding(std::as_bytes(std::span(file)));
    if (!read(decoding))
        throw std::runtime_error(decoding.error);
    const png_uint_32 width = png_get_image_width(decoding.png, decoding.info);
    const png_uint_32 height = png_get_image_height(decoding.png, decoding.info);
    image = {path, 0, 0, width, height, width, height, false, {"R", "G", "B"}, {}, {}};
    if (png_get_channels(decoding.png, decoding.info) == 4)
        image.channels.emplace_back("A");
    const std::size_t row_values = width * image.channels.size();
    image.values.reserve(height * row_values);
    const bool has_words = png_get_bit_depth(decoding.png, decoding.info) == 16;
    for (const png_const_bytep row : std::span(png_get_rows(decoding.png, decoding.info), height))
        (has_words ? append_row<std::uint16_t> : append_row<std::uint8_t>)(image.values, row, row_values);
}

} // namespace cli
