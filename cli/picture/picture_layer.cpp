#include "cli/picture/picture_layer.h"

#include <algorithm>
#include <cstddef>

namespace cli {
namespace {

constexpr FileLayer alpha_layer{PT_QUANTITY_COVERAGE, "A", 1, LayerKind::color};

const FileLayer &file_layer(std::uint32_t quantity) {
    const auto found = std::ranges::find(file_layers.values(), quantity, &FileLayer::quantity);
    return found == file_layers.values().end() ? alpha_layer : *found;
}

} // namespace

PictureLayer::PictureLayer(std::uint32_t of_quantity, std::size_t pixel_count) : quantity(of_quantity) {
    const FileLayer &layer = file_layer(quantity);
    if (layer.kind == LayerKind::numbers)
        numbers.resize(pixel_count);
    else
        values.resize(pixel_count * layer.channel_count);
}

void PictureLayer::take(std::span<const float> triples, std::size_t first_pixel) {
    const std::size_t count = file_layer(quantity).channel_count;
    for (std::size_t pixel = 0; pixel < triples.size() / 3; ++pixel)
        std::copy_n(&triples[3 * pixel], count, &values[count * (first_pixel + pixel)]);
}

void PictureLayer::read(const Context &context, const Rectangle &part, std::uint32_t first_row, std::uint32_t rows) {
    const std::size_t first = std::size_t{part.width} * first_row;
    if (!numbers.empty()) {
        context.read(part.x, part.width, rows, quantity, &numbers[first]);
    } else {
        std::vector<float> triples(std::size_t{3} * part.width * rows);
        context.read(part.x, part.width, rows, quantity, triples.data());
        take(triples, first);
    }
}

ImageLayer PictureLayer::in_file() const {
    const FileLayer &layer = file_layer(quantity);
    return {layer.name, layer.kind, layer.channel_count, values, numbers};
}

} // namespace cli
