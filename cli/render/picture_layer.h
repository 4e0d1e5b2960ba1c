// The layers of --layers and --alpha beside the radiance, with the names that OpenEXR uses.
#pragma once

#include "cli/base/context.h"
#include "cli/base/names.h"
#include "cli/image/image_module.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cli {

struct FileLayer {
    std::uint32_t quantity; // PT_QUANTITY_*
    const char *name;
    std::size_t channel_count;
    LayerKind kind;
};

// Layers by the option's names. Z, N.X, N.Y, N.Z and id are the names that programs look for; the others are layers
// with their own names ("OpenEXR: Technical Introduction", channel names).
inline constexpr ValueNames<7, FileLayer> file_layers({
    {"mean", {PT_QUANTITY_RADIANCE, "", 3, LayerKind::color}}, // always present
    // The difference of two parts' means gives it.
    {"standard-error", {PT_QUANTITY_STANDARD_ERROR, "standard_error", 3, LayerKind::color}},
    {"sample-count", {PT_QUANTITY_SAMPLE_COUNT, "sample_count", 1, LayerKind::color}},
    {"depth", {PT_QUANTITY_DEPTH, "Z", 1, LayerKind::color}},
    {"normal", {PT_QUANTITY_NORMAL, "N", 3, LayerKind::vector}},
    {"albedo", {PT_QUANTITY_ALBEDO, "albedo", 3, LayerKind::color}},
    {"object-id", {PT_QUANTITY_OBJECT, "id", 1, LayerKind::numbers}},
});

// A layer of the rendered part of a picture.
struct PictureLayer {
    std::uint32_t quantity;             // PT_QUANTITY_*
    std::vector<float> values;          // per pixel, row by row from the top; empty for objects
    std::vector<std::uint32_t> numbers; // for objects: one index per pixel, in the same order

    // Values start as 0.
    PictureLayer(std::uint32_t of_quantity, std::size_t pixel_count);

    // Takes the library's numbers, three a pixel, from first_pixel on.
    void take(std::span<const float> triples, std::size_t first_pixel);

    // The context renders these rows of the part as its first.
    void read(const Context &context, const Rectangle &part, std::uint32_t first_row, std::uint32_t rows);

    // The layer in a file; refers to this object.
    ImageLayer in_file() const;
};

// The rendered part of a picture.
struct RenderedImage {
    Rectangle part;                     // of the picture
    std::vector<float> radiance{};      // black below rows_done
    std::vector<float> raw{};           // of a denoised picture, its samples' mean; else empty
    std::vector<PictureLayer> layers{}; // for files of radiance; alpha also for others
    std::uint32_t rows_done = 0;        // rows with samples
    pt_stats stats{};                   // of these rows; sample_count is the least of all pieces
    pt_error_estimate error{};          // likewise
};

} // namespace cli
