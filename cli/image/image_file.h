// Image formats, the images that -o and --format request, and their files.
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

// Options, refusals and helps follow from the rows below.
struct ImageFormat {
    std::string_view name; // the extension
    bool is_radiance;      // linear float32 layers; others are tone-mapped to bytes
    bool has_alpha;
    bool needs_module; // else PNG

    // Of format or encoder; checked before writing, because libjpeg ends the process beyond it.
    std::uint32_t longest_side;
};

inline constexpr std::uint32_t largest_signed = 2'147'483'647;
inline constexpr std::uint32_t libpng_limit = 1'000'000; // its default
inline constexpr std::uint32_t libjpeg_limit = 65'500;   // JPEG_MAX_DIMENSION

// Name, radiance, alpha, module, longest side; radiance first.
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

// ".exr, .png": formats for which `holds`.
std::string extensions(const std::function<bool(const ImageFormat &)> &holds, const char *between = ", ");

std::optional<ImageFormat> format_of_name(std::string_view name);

// Finds the extension in any case.
std::optional<ImageFormat> image_format(const std::string &path);

struct ImageTarget {
    std::string path; // "-": standard output
    ImageFormat format;
};

// Throws Failure(ExitCode::usage) for an unknown format, standard output without --format or on a terminal, and
// --format without standard output.
void check_image_names(std::span<const std::string> paths, std::optional<ImageFormat> format);

// format: of standard output.
ImageTarget image_target(const std::string &path, std::optional<ImageFormat> format);

// Throws Failure: ExitCode::usage for an image too large for its format, ExitCode::file for an unwritable file.
void check_image_target(const ImageTarget &target, const ImageWindow &window);

// Throws Failure(ExitCode::file) without the module, a separate package.
std::filesystem::path module_path();

// name: see image_module.h. Throws Failure(ExitCode::internal) if the module cannot be loaded.
void *load_symbol(const std::filesystem::path &path, const char *name);

// Attributes become text chunks. Throws std::runtime_error.
std::vector<unsigned char> encode_png(const ImageData &image);

// Alpha is a channel; text chunks are skipped. Throws std::runtime_error.
void decode_png(const std::string &path, DecodedImage &image);

class ImageWriter {
public:
    // Loads in the background. Throws Failure(ExitCode::file) at once without the module.
    void load_module();

    // A long rendering may stop then.
    bool failed() const { return failed_; }

    // Throws Failure(ExitCode::internal) if load_module() failed.
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

// Throws Failure: ExitCode::file if it cannot be read, or needs a missing module.
DecodedImage read_image(const std::string &path);

} // namespace cli
