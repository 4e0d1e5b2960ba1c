// The formats of images, which images a command writes, from what its options -o and --format say, and the files of
// them: PNG itself, and all other formats by the module of image_module.h.
#pragma once

#include "cli/image/image_module.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// What is particular to a format. Options, refusals and helps follow from the rows below; a format that needs the
// module is one that OpenImageIO writes from layers of radiance, or from bytes.
struct ImageFormat {
    std::string_view name; // the extension
    bool is_radiance;      // linear, 32-bit float, in layers; other formats are tone-mapped to bytes
    bool has_alpha;
    bool needs_module; // otherwise it is PNG

    // That the format, or the library that encodes it, can hold. To be checked before writing: libjpeg ends the whole
    // process if it is asked for more.
    std::uint32_t longest_side;
};

inline constexpr std::uint32_t largest_signed = 2'147'483'647;
inline constexpr std::uint32_t libpng_limit = 1'000'000; // its default
inline constexpr std::uint32_t libjpeg_limit = 65'500;   // JPEG_MAX_DIMENSION

// Name, radiance, alpha, module, longest side. Those of radiance come first.
inline constexpr std::array<ImageFormat, 4> image_formats{{
    {"exr", true, true, true, largest_signed},
    {"png", false, true, false, libpng_limit},
    {"jpg", false, false, true, libjpeg_limit},
    {"jpeg", false, false, true, libjpeg_limit},
}};

inline constexpr auto image_format_names = [] {
    std::array<std::string_view, image_formats.size()> names{};
    std::ranges::transform(image_formats, names.begin(), &ImageFormat::name);
    return names;
}();

inline bool any_format(const ImageFormat & /*format*/) {
    return true;
}
inline bool is_for_displays(const ImageFormat &format) {
    return !format.is_radiance;
}

// ".exr, .png": the extensions of the formats for which that holds.
std::string extensions(const std::function<bool(const ImageFormat &)> &holds, const char *between = ", ");

// Nothing for an unknown name.
std::optional<ImageFormat> format_of_name(std::string_view name);

// Found by the extension, in upper or lower case.
std::optional<ImageFormat> image_format(const std::string &path);

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

// Throws Failure: ExitCode::file if it cannot be read, or needs the module and that is not there.
DecodedImage read_image(const std::string &path);

} // namespace cli
