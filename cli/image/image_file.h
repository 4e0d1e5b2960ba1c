// Writes images: PNG itself, and all other formats by the module of image_module.h.
#pragma once

#include "cli/image/image_module.h"
#include "cli/image/image_window.h"

#include <atomic>
#include <cstdint>
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

// By the extension, whatever its case. Nothing if it is none of .exr, .png, .jpg and .jpeg.
std::optional<ImageFormat> image_format(const std::string &path);

// "exr", "png" or "jpg", as in an extension.
std::optional<ImageFormat> find_image_format(std::string_view name);
inline constexpr std::array<std::string_view, 4> image_format_names{"exr", "png", "jpg", "jpeg"};
inline constexpr std::array<std::string_view, 3> picture_format_names{"png", "jpg", "jpeg"}; // that are tone-mapped

// The longest side that the format, or the library that encodes it, can hold. To be checked before writing: libjpeg
// ends the whole process if it is asked for more.
std::uint32_t longest_side(ImageFormat format);

struct ImageTarget {
    std::string path; // "-": standard output
    ImageFormat format;
};

class ImageWriter {
public:
    // In the background, so that it is there when the first image is to be written; otherwise it is loaded then. Throws
    // Failure(ExitCode::file) at once if the module is not there.
    void load_module();

    // The module turned out to be unusable: a long rendering may as well stop.
    bool failed() const { return failed_; }

    // Waits until load_module() is done, if it was called. Throws Failure(ExitCode::internal) if it failed.
    void wait() const {
        if (encode_.valid())
            encode_.get();
    }

    // All throw Failure(ExitCode::file) and leave an existing file as it was. Values are those of the window's part.
    void write_radiance(const ImageTarget &target, const ImageWindow &window, std::span<const pt_image_layer> layers,
                        std::span<const pt_image_attribute> attributes);
    // Three components to a pixel, for PNG also four with alpha, of 8 bits, or of 16 for PNG. gamma: of their encoding;
    // nothing: it is that of sRGB.
    void write_signal(const ImageTarget &target, const ImageWindow &window, std::span<const std::uint8_t> bytes,
                      std::span<const pt_image_attribute> attributes, std::optional<double> gamma = std::nullopt);
    void write_signal(const ImageTarget &target, const ImageWindow &window, std::span<const std::uint16_t> words,
                      std::span<const pt_image_attribute> attributes, std::optional<double> gamma = std::nullopt);

private:
    void write(const ImageTarget &target, const ImageWindow &window, pt_image_data image,
               std::span<const pt_image_attribute> attributes);
    void write_png(const std::string &path, const pt_image_data &image);
    void write_by_module(const std::string &path, const pt_image_data &image);

    std::atomic<bool> failed_ = false;
    std::shared_future<pt_encode_image_fn> encode_; // destroyed first: the thread uses failed_
};

} // namespace cli
