// Owns the encoding of PNG images by libpng, without OpenImageIO, whose module takes 0.2 s and 200 MB to load.
// Called by image_file.
#include "png_encoder.h"

#include <png.h>

#include <csetjmp>
#include <new>
#include <span>
#include <stdexcept>
#include <string>

namespace cli {
namespace {

// libpng's structures, and what its callbacks leave behind: the file so far, or why there is none.
struct Encoding {
    std::vector<std::byte> file;
    std::string error;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, &Encoding::fail, &Encoding::ignore);
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

    // Must not return. The way out of libpng's C frames is a long jump, for no exception may cross them.
    [[noreturn]] static void fail(png_structp png, png_const_charp reason) {
        static_cast<Encoding *>(png_get_error_ptr(png))->error = reason;
        png_longjmp(png, 1);
    }
    static void ignore(png_structp, png_const_charp) {}
    static void flush(png_structp) {}

    // NOLINTNEXTLINE(readability-non-const-parameter): the type is libpng's
    static void append(png_structp png, png_bytep bytes, std::size_t size) {
        auto &file = static_cast<Encoding *>(png_get_io_ptr(png))->file;
        bool fits = true;
        try {
            const auto *first = reinterpret_cast<const std::byte *>(bytes);
            file.insert(file.end(), first, first + size);
        } catch (const std::bad_alloc &) {
            fits = false;
        }
        if (!fits) {
            png_error(png, "out of memory");
        }
    }
};

std::vector<png_text> texts_of(const pt_image_data &image) {
    std::vector<png_text> texts;
    for (const pt_image_attribute &attribute : std::span(image.attributes, image.attribute_count)) {
        if (attribute.text != nullptr) {
            png_text text{};
            text.compression = PNG_TEXT_COMPRESSION_NONE;
            text.key = const_cast<char *>(attribute.name); // libpng copies both
            text.text = const_cast<char *>(attribute.text);
            texts.push_back(text);
        }
    }
    return texts;
}

std::vector<png_bytep> rows_of(const pt_image_data &image) {
    std::vector<png_bytep> rows(image.height);
    for (std::size_t y = 0; y < rows.size(); ++y) {
        rows[y] = const_cast<png_bytep>(image.bytes + y * 3 * image.width); // only read
    }
    return rows;
}

// False after a failure. A long jump runs no destructors: this function has no objects that need one.
bool write(Encoding &encoding, const pt_image_data &image, std::span<png_text> texts, png_bytepp rows) {
    if (setjmp(png_jmpbuf(encoding.png)) != 0) { // NOLINT(cert-err52-cpp): libpng's way to tell of errors
        return false;
    }
    png_set_IHDR(encoding.png, encoding.info, image.width, image.height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_text(encoding.png, encoding.info, texts.data(), static_cast<int>(texts.size()));
    png_set_rows(encoding.png, encoding.info, rows);
    png_write_png(encoding.png, encoding.info, PNG_TRANSFORM_IDENTITY, nullptr);
    return true;
}

} // namespace

std::vector<std::byte> encode_png(const pt_image_data &image) {
    std::vector<png_text> texts = texts_of(image);
    std::vector<png_bytep> rows = rows_of(image);
    Encoding encoding;
    if (!write(encoding, image, texts, rows.data())) {
        throw std::runtime_error(encoding.error);
    }
    return std::move(encoding.file);
}

} // namespace cli
