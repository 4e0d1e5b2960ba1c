#pragma once

#include "cli/base/context.h"
#include "cli/image/image_module.h"
#include "lib/scene_file/names.h"

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

// OpenEXR prescribes the names Z, N and id.
inline constexpr pt::ValueNames<7, FileLayer> file_layers({
    {"mean", {PT_QUANTITY_RADIANCE, "", 3, LayerKind::color}},
    {"standard-error", {PT_QUANTITY_STANDARD_ERROR, "standard_error", 3, LayerKind::color}},
    {"sample-count", {PT_QUANTITY_SAMPLE_COUNT, "sample_count", 1, LayerKind::color}},
    {"depth", {PT_QUANTITY_DEPTH, "Z", 1, LayerKind::color}},
    {"normal", {PT_QUANTITY_NORMAL, "N", 3, LayerKind::vector}},
    {"albedo", {PT_QUANTITY_ALBEDO, "albedo", 3, LayerKind::color}},
    {"object-id", {PT_QUANTITY_OBJECT, "id", 1, LayerKind::numbers}},
});

struct PictureLayer {
    std::uint32_t quantity;             // PT_QUANTITY_*
    std::vector<float> values;          // from the top left; empty for objects
    std::vector<std::uint32_t> numbers; // object indices, one per pixel

    PictureLayer(std::uint32_t of_quantity, std::size_t pixel_count);

    // `triples` are the library's three values per pixel.
    void take(std::span<const float> triples, std::size_t first_pixel);

    void read(const Context &context, const Rectangle &part, std::uint32_t first_row, std::uint32_t rows);

    // Points into this object.
    ImageLayer in_file() const;
};

struct RenderedImage {
    Rectangle part;
    std::vector<float> radiance{}; // black below rows_done
    std::vector<float> raw{};      // mean of the samples before denoising
    std::vector<PictureLayer> layers{};
    std::uint32_t rows_done = 0; // rows with samples
    pt_stats stats{};            // finished rows only
    pt_error_estimate error{};   // finished rows only
};

} // namespace cli
