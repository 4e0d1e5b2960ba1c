// Writes and reads images: writes PNG itself, and uses the module of image_module.h for all other formats and to read.
#pragma once

#include "cli/image/image_module.h"

#include <atomic>
#include <cstdint>
#include <future>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {

enum class ImageFormat {
    exr, // linear radiance, 32-bit float
    png, // 8 bits, tone-mapped, like jpeg
    jpeg
};

// By the extension, whatever its case. Nothing if it is none of .exr, .png, .jpg and .jpeg.
std::optional<ImageFormat> image_format(const std::string &path);

// The longest side that the format, or the library that encodes it, can hold. To be checked before writing: libjpeg
// ends the whole process if it is asked for more.
std::uint32_t longest_side(ImageFormat format);

struct RadianceImage {
    std::uint32_t width;
    std::uint32_t height;
    std::vector<float> radiance; // R, G, B of each pixel, row by row from the top
};

// Throws Failure: ExitCode::file if it cannot be read or has other channels, or without the module.
RadianceImage read_radiance(const std::string &path);

// Encodes and writes images: PNG itself, all others by the module.
class ImageWriter {
public:
    // In the background, so that it is there when the first image is to be written; otherwise it is loaded then. Throws
    // Failure(ExitCode::file) at once if the module is not there.
    void load_module();

    // The module turned out to be unusable: a long rendering may as well stop.
    bool failed() const { return failed_; }

    // Waits until load_module() is done, if it was called. Throws Failure(ExitCode::internal) if it failed.
    void wait() const {
        if (encode_.valid()) {
            encode_.get();
        }
    }

    // Both throw Failure(ExitCode::file) and leave an existing file as it was. Three components to a pixel.
    void write_radiance(const std::string &path, std::uint32_t width, std::uint32_t height,
                        std::span<const float> radiance, std::span<const pt_image_attribute> attributes);
    // gamma: of the bytes' encoding; nothing: it is that of sRGB.
    void write_bytes(const std::string &path, std::uint32_t width, std::uint32_t height,
                     std::span<const std::uint8_t> bytes, std::span<const pt_image_attribute> attributes,
                     std::optional<double> gamma = std::nullopt);

private:
    void write(const std::string &path, pt_image_data image, std::span<const pt_image_attribute> attributes);
    void write_png(const std::string &path, const pt_image_data &image);
    void write_by_module(const std::string &path, const pt_image_data &image);

    std::atomic<bool> failed_ = false;
    std::shared_future<pt_encode_image_fn> encode_; // destroyed first: the thread uses failed_
};

} // namespace cli
