// The layers of a picture: what the options --layers and --alpha add to an image beside the radiance, read from the
// library and named by the customs of OpenEXR.
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
    std::size_t channel_count; // one if all are equal
    LayerKind kind;
};

// By the names of the option. Z, N.X, N.Y, N.Z and id are the names that programs look for in a file. Each of the
// others is a layer with its own name ("OpenEXR: Technical Introduction", channel names).
inline constexpr ValueNames<7, FileLayer> file_layers({
    {"mean", {PT_QUANTITY_RADIANCE, "", 3, LayerKind::color}}, // which is always there
    // From the difference between the means of two parts of the samples.
    {"standard-error", {PT_QUANTITY_STANDARD_ERROR, "standard_error", 3, LayerKind::color}},
    {"sample-count", {PT_QUANTITY_SAMPLE_COUNT, "sample_count", 1, LayerKind::color}},
    {"depth", {PT_QUANTITY_DEPTH, "Z", 1, LayerKind::color}},
    {"normal", {PT_QUANTITY_NORMAL, "N", 3, LayerKind::vector}},
    {"albedo", {PT_QUANTITY_ALBEDO, "albedo", 3, LayerKind::color}},
    {"object-id", {PT_QUANTITY_OBJECT, "id", 1, LayerKind::numbers}},
});

// A layer of the part of a picture that is rendered.
struct PictureLayer {
    std::uint32_t quantity;             // PT_QUANTITY_*
    std::vector<float> values;          // pixel by pixel, row by row from the top; empty for objects
    std::vector<std::uint32_t> numbers; // for objects: one index a pixel, in the same order

    // All values start as 0.
    PictureLayer(std::uint32_t of_quantity, std::size_t pixel_count);

    // Takes over the library's numbers, three a pixel, for pixels from first_pixel on.
    void take(std::span<const float> triples, std::size_t first_pixel);

    // Reads rows of the part from a context that renders them as its first rows.
    void read(const Context &context, const Rectangle &part, std::uint32_t first_row, std::uint32_t rows);

    // The layer as it goes into a file; refers to this object.
    ImageLayer in_file() const;
};

// The rendered part of a picture, from which its files are made.
struct RenderedImage {
    Rectangle part;                     // of the picture
    std::vector<float> radiance{};      // of this part; black below rows_done
    std::vector<float> raw{};           // of a denoised picture, the mean of its samples; else empty
    std::vector<PictureLayer> layers{}; // all go into files of radiance; alpha also into others
    std::uint32_t rows_done = 0;        // rows of the part that have samples
    pt_stats stats{};                   // of these rows; sample_count is the least of all pieces
    pt_error_estimate error{};          // likewise
};

} // namespace cli
