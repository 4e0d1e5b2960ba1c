#include "cli/image/image_file.h"

#include "cli/base/exit_code.h"
#include "cli/base/output_file.h"
#include "cli/image/module_function.h"
#include "cli/image/png_encoder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <filesystem>

namespace cli {
namespace {

const char *module_extension(ImageFormat format) {
    return format == ImageFormat::exr ? "exr" : "jpg";
}

// What became of writing the encoded bytes. The sink runs under the module's C frame, which no exception may cross.
struct Sink {
    OutputFile &file;
    std::exception_ptr error;

    static void receive(void *user, const void *bytes, std::size_t size) {
        auto *sink = static_cast<Sink *>(user);
        try {
            sink->file.write({static_cast<const std::byte *>(bytes), size});
        } catch (...) {
            sink->error = std::current_exception();
        }
    }
};

} // namespace

std::optional<ImageFormat> image_format(const std::string &path) {
    std::string extension = std::filesystem::path(path).extension();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return extension.empty() ? std::nullopt : find_image_format(extension.substr(1));
}

std::optional<ImageFormat> find_image_format(std::string_view name) {
    if (name == "exr")
        return ImageFormat::exr;
    if (name == "png")
        return ImageFormat::png;
    if (name == "jpg" || name == "jpeg")
        return ImageFormat::jpeg;
    return std::nullopt;
}

std::uint32_t longest_side(ImageFormat format) {
    switch (format) {
    case ImageFormat::exr:
        break;
    case ImageFormat::png:
        return 1'000'000; // libpng's default limit
    case ImageFormat::jpeg:
        return 65'500; // JPEG_MAX_DIMENSION of libjpeg
    }
    return 2'147'483'647; // sizes are 32-bit signed numbers
}

void ImageWriter::load_module() {
    const std::filesystem::path path = module_path();
    encode_ = std::async(std::launch::async, [this, path] {
        try {
            return reinterpret_cast<pt_encode_image_fn>(load_symbol(path, PT_ENCODE_IMAGE_SYMBOL));
        } catch (...) {
            failed_ = true;
            throw;
        }
    });
}

void ImageWriter::write_radiance(const ImageTarget &target, const ImageWindow &window,
                                 std::span<const pt_image_layer> layers,
                                 std::span<const pt_image_attribute> attributes) {
    pt_image_data image{};
    image.layers = layers.data();
    image.layer_count = layers.size();
    write(target, window, image, attributes);
}

void ImageWriter::write_signal(const ImageTarget &target, const ImageWindow &window,
                               std::span<const std::uint8_t> bytes, std::span<const pt_image_attribute> attributes,
                               std::optional<double> gamma) {
    pt_image_data image{};
    image.bytes = bytes.data();
    image.has_alpha = bytes.size() == 4 * window.part.pixel_count() ? 1 : 0;
    image.gamma = gamma.value_or(0.0);
    write(target, window, image, attributes);
}

void ImageWriter::write_signal(const ImageTarget &target, const ImageWindow &window,
                               std::span<const std::uint16_t> words, std::span<const pt_image_attribute> attributes,
                               std::optional<double> gamma) {
    pt_image_data image{};
    image.words = words.data();
    image.has_alpha = words.size() == 4 * window.part.pixel_count() ? 1 : 0;
    image.gamma = gamma.value_or(0.0);
    write(target, window, image, attributes);
}

void ImageWriter::write(const ImageTarget &target, const ImageWindow &window, pt_image_data image,
                        std::span<const pt_image_attribute> attributes) {
    image.width = window.part.width;
    image.height = window.part.height;
    image.x = window.part.x;
    image.y = window.part.y;
    image.full_width = window.full_width;
    image.full_height = window.full_height;
    image.attributes = attributes.data();
    image.attribute_count = attributes.size();
    if (target.format == ImageFormat::png) {
        write_png(target.path, image);
    } else {
        image.extension = module_extension(target.format);
        write_by_module(target.path, image);
    }
}

void ImageWriter::write_png(const std::string &path, const pt_image_data &image) {
    OutputFile file(path);
    std::vector<std::byte> bytes;
    try {
        bytes = encode_png(image);
    } catch (const std::runtime_error &error) {
        throw Failure(ExitCode::file, "cannot write " + path + ": " + error.what());
    }
    file.write(bytes);
    file.commit();
}

void ImageWriter::write_by_module(const std::string &path, const pt_image_data &image) {
    if (!encode_.valid())
        load_module();
    const pt_encode_image_fn encode = encode_.get();
    OutputFile file(path);
    Sink sink{file, nullptr};
    std::array<char, 512> message{};
    if (encode(&image, &Sink::receive, &sink, message.data(), message.size()) != 0)
        throw Failure(ExitCode::file, "cannot write " + path + ": " + message.data());
    if (sink.error)
        std::rethrow_exception(sink.error);
    file.commit();
}

} // namespace cli
