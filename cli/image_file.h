// Owns the writing and reading of images: which formats there are, and the module that encodes and decodes them.
// Called by render_command and bench_command.
#pragma once

#include "image_module.h"

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

// Throws Failure: ExitCode::file if it cannot be read or has other channels, ExitCode::internal without the module.
RadianceImage read_radiance(const std::string &path);

// Encodes and writes images. The module is loaded in the background from construction on.
class ImageWriter {
public:
    // Throws Failure(ExitCode::internal) at once if the module is not there.
    ImageWriter();

    // The module turned out to be unusable: a long rendering may as well stop.
    bool failed() const { return failed_; }

    // Until the module is loaded. Throws Failure(ExitCode::internal) if it cannot be.
    void wait() const { encode_.get(); }

    // Both throw Failure(ExitCode::file) and leave an existing file as it was. Three components to a pixel.
    void write_radiance(const std::string &path, std::uint32_t width, std::uint32_t height,
                        std::span<const float> radiance, std::span<const pt_image_attribute> attributes);
    void write_bytes(const std::string &path, std::uint32_t width, std::uint32_t height,
                     std::span<const std::uint8_t> bytes, std::span<const pt_image_attribute> attributes);

private:
    void write(const std::string &path, pt_image_data image, std::span<const pt_image_attribute> attributes);

    std::atomic<bool> failed_ = false;
    std::shared_future<pt_encode_image_fn> encode_; // destroyed first: the thread uses failed_
};

} // namespace cli
