// Which images a command writes, from what its options -o and --format say, and the files of them: PNG itself, and all
// other formats by the module of image_module.h.
#pragma once

#include "cli/base/names.h"
#include "cli/image/image_module.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <future>
#include <optional>
#include <span>
#include <string>

namespace cli {

enum class ImageFormat {
    exr, // linear radiance, 32-bit float
    png, // tone-mapped, like jpeg
    jpeg
};

// Names as in extensions. Formats that are tone-mapped come last.
inline constexpr ValueNames<4, ImageFormat> image_formats(
    {{"exr", ImageFormat::exr}, {"png", ImageFormat::png}, {"jpg", ImageFormat::jpeg}, {"jpeg", ImageFormat::jpeg}});

// Found by the extension, in upper or lower case. Nothing if it is none of .exr, .png, .jpg and .jpeg.
std::optional<ImageFormat> image_format(const std::string &path);

// The longest side that the format, or the library that encodes it, can hold. To be checked before writing: libjpeg
// ends the whole process if it is asked for more.
std::uint32_t longest_side(ImageFormat format);

struct ImageTarget {
    std::string path; // "-": standard output
    ImageFormat format;
};

// Throws Failure(ExitCode::usage) for a file whose name tells no format, for standard output without --format or on a
// terminal, and for --format without standard output.
void check_image_names(std::span<const std::string> paths, std::optional<ImageFormat> format);

// For a path that has passed these checks. format: that of standard output.
ImageTarget image_target(const std::string &path, std::optional<ImageFormat> format);

// Throws Failure: ExitCode::usage for an image that is too large for its format, ExitCode::file for a file that cannot
// be written.
void check_image_target(const ImageTarget &target, const ImageWindow &window);

// Where the image module is, seen from the program. Throws Failure(ExitCode::file) if it is not there: it is a package
// of its own, and not built everywhere.
std::filesystem::path module_path();

// One of the names in image_module.h. Throws Failure(ExitCode::internal) if the module cannot be loaded.
void *load_symbol(const std::filesystem::path &path, const char *name);

// A whole file of PNG, by libpng and without the module: image.signals, and the attributes as text chunks.
// Throws std::runtime_error.
std::vector<unsigned char> encode_png(const ImageData &image);

// Likewise, of a file. Alpha is a channel of its own; text chunks are left out.
void decode_png(const std::string &path, DecodedImage &image);

class ImageWriter {
public:
    // In the background, so that it is there when the first image is to be written; otherwise it is loaded then. Throws
    // Failure(ExitCode::file) at once if the module is not there.
    void load_module();

    // Whether the module turned out to be unusable, so that a long rendering may as well stop.
    bool failed() const { return failed_; }

    // Waits until load_module() is done, if it was called. Throws Failure(ExitCode::internal) if it failed.
    void wait() const {
        if (encode_.valid())
            static_cast<void>(encode_.get());
    }

    // Throws Failure(ExitCode::file), and leaves an existing file as it was.
    void write(const ImageTarget &target, const ImageData &image);

private:
    std::vector<unsigned char> encoded(const ImageTarget &target, const ImageData &image);

    std::atomic<bool> failed_ = false;
    std::shared_future<EncodeImage *> encode_; // destroyed first: the thread uses failed_
};

// Throws Failure: ExitCode::file if it cannot be read, or without the module.
DecodedImage read_image(const std::string &path);

} // namespace cli
