#include "cli/image/image_file.h"

#include "cli/base/atomic_file.h"
#include "cli/base/exit_code.h"
#include "cli/image/png_encoder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <dlfcn.h>
#include <filesystem>
#include <unistd.h>

namespace cli {
namespace {

// PT_MODULE_DIRECTORY is relative to the program, so that an installed tree can be moved. Throws
// Failure(ExitCode::file) if the module is not there: it is a package of its own, and not built everywhere.
std::filesystem::path module_path() {
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
    std::filesystem::path path = program.parent_path() / PT_MODULE_DIRECTORY / "libpt-image-file.so";
    path = path.lexically_normal();
    if (access(path.c_str(), R_OK) != 0) {
        throw Failure(ExitCode::file, "EXR and JPEG need the image module, and there is no " + path.string() +
                                          ": install the package pt-image-formats, or libopenimageio-dev before "
                                          "building pt; PNG needs neither");
    }
    return path;
}

// Never unloaded: OpenImageIO keeps threads and static objects.
template <typename Function>
Function load_function(const std::filesystem::path &path, const char *name) {
    void *module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void *symbol = module == nullptr ? nullptr : dlsym(module, name);
    if (symbol == nullptr) {
        throw Failure(ExitCode::internal, std::string("cannot load the image module: ") + dlerror());
    }
    return reinterpret_cast<Function>(symbol);
}

const char *module_extension(ImageFormat format) {
    return format == ImageFormat::exr ? "exr" : "jpg";
}

// What became of writing the encoded bytes. The sink runs under the module's C frame, which no exception may cross.
struct Sink {
    AtomicFile &file;
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

// Like Sink, for what the module reads.
struct RadianceSink {
    RadianceImage image;
    std::exception_ptr error;

    static void receive(void *user, std::uint32_t width, std::uint32_t height, const float *radiance) {
        auto *sink = static_cast<RadianceSink *>(user);
        try {
            sink->image = {width, height, {radiance, radiance + std::size_t{3} * width * height}};
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
    if (extension == ".exr") {
        return ImageFormat::exr;
    }
    if (extension == ".png") {
        return ImageFormat::png;
    }
    if (extension == ".jpg" || extension == ".jpeg") {
        return ImageFormat::jpeg;
    }
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

RadianceImage read_radiance(const std::string &path) {
    const auto decode = load_function<pt_decode_image_fn>(module_path(), PT_DECODE_IMAGE_SYMBOL);
    RadianceSink sink{};
    std::array<char, 512> message{};
    if (decode(path.c_str(), &RadianceSink::receive, &sink, message.data(), message.size()) != 0) {
        throw Failure(ExitCode::file, "cannot read " + path + ": " + message.data());
    }
    if (sink.error) {
        std::rethrow_exception(sink.error);
    }
    return std::move(sink.image);
}

void ImageWriter::load_module() {
    const std::filesystem::path path = module_path();
    encode_ = std::async(std::launch::async, [this, path] {
        try {
            return load_function<pt_encode_image_fn>(path, PT_ENCODE_IMAGE_SYMBOL);
        } catch (...) {
            failed_ = true;
            throw;
        }
    });
}

void ImageWriter::write_radiance(const std::string &path, std::uint32_t width, std::uint32_t height,
                                 std::span<const float> radiance, std::span<const pt_image_attribute> attributes) {
    pt_image_data image{};
    image.width = width;
    image.height = height;
    image.radiance = radiance.data();
    write(path, image, attributes);
}

void ImageWriter::write_bytes(const std::string &path, std::uint32_t width, std::uint32_t height,
                              std::span<const std::uint8_t> bytes, std::span<const pt_image_attribute> attributes,
                              std::optional<double> gamma) {
    pt_image_data image{};
    image.width = width;
    image.height = height;
    image.bytes = bytes.data();
    image.gamma = gamma.value_or(0.0);
    write(path, image, attributes);
}

void ImageWriter::write(const std::string &path, pt_image_data image, std::span<const pt_image_attribute> attributes) {
    const ImageFormat format = image_format(path).value();
    image.attributes = attributes.data();
    image.attribute_count = attributes.size();
    if (format == ImageFormat::png) {
        write_png(path, image);
    } else {
        image.extension = module_extension(format);
        write_by_module(path, image);
    }
}

void ImageWriter::write_png(const std::string &path, const pt_image_data &image) {
    AtomicFile file(path);
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
    if (!encode_.valid()) {
        load_module();
    }
    const pt_encode_image_fn encode = encode_.get();
    AtomicFile file(path);
    Sink sink{file, nullptr};
    std::array<char, 512> message{};
    if (encode(&image, &Sink::receive, &sink, message.data(), message.size()) != 0) {
        throw Failure(ExitCode::file, "cannot write " + path + ": " + message.data());
    }
    if (sink.error) {
        std::rethrow_exception(sink.error);
    }
    file.commit();
}

} // namespace cli
