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

struct ImageFormat {
    std::string_view name; // name and file extension
    bool is_radiance;      // linear float32 layers; other formats are tone-mapped
    bool has_alpha;
    bool needs_module; // false for formats of libpng

    // Checked in advance, because libjpeg ends the process if an image is larger.
    std::uint32_t longest_side;
};

inline constexpr std::uint32_t largest_signed = 2'147'483'647;
inline constexpr std::uint32_t libpng_limit = 1'000'000; // libpng's default
inline constexpr std::uint32_t libjpeg_limit = 65'500;   // JPEG_MAX_DIMENSION

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

std::string extensions(const std::function<bool(const ImageFormat &)> &holds, const char *between = ", ");

std::optional<ImageFormat> format_of_name(std::string_view name);

std::optional<ImageFormat> image_format(const std::string &path);

struct ImageTarget {
    std::string path;
    ImageFormat format;
};

// Throws Failure(ExitCode::usage) for an unknown format, for standard output on a terminal, or if --format does not
// fit.
void check_image_names(std::span<const std::string> paths, std::optional<ImageFormat> format);

ImageTarget image_target(const std::string &path, std::optional<ImageFormat> format);

// Throws Failure for an image too large for its format, or an unwritable file.
void check_image_target(const ImageTarget &target, const ImageWindow &window);

// Throws Failure(ExitCode::file) if the module, a separate package, is missing.
std::filesystem::path module_path();

// image_module.h has the names. The module stays loaded. Throws Failure(ExitCode::internal).
void *load_symbol(const std::filesystem::path &path, const char *name);

// Attributes become text chunks. Throws std::runtime_error.
std::vector<unsigned char> encode_png(const ImageData &image);

// Skips text chunks. Throws std::runtime_error.
void decode_png(const std::string &path, DecodedImage &image);

class ImageWriter {
public:
    // Loads in the background. Throws Failure(ExitCode::file) if the module is missing.
    void load_module();

    bool failed() const { return failed_; }

    // Throws Failure(ExitCode::internal) if loading failed.
    void wait() const {
        if (encode_.valid())
            static_cast<void>(encode_.get());
    }

    // After a failure an existing file is unchanged. Throws Failure(ExitCode::file).
    void write(const ImageTarget &target, const ImageData &image);

private:
    std::vector<unsigned char> encoded(const ImageTarget &target, const ImageData &image);

    std::atomic<bool> failed_ = false;
    std::shared_future<EncodeImage *> encode_; // destroyed first, because its thread uses failed_
};

DecodedImage read_image(const std::string &path);

} // namespace cli
