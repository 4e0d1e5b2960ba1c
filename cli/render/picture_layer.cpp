#include "cli/render/picture_layer.h"

#include "cli/base/common_options.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <sstream>

namespace cli {
namespace {

struct FileLayer {
    std::uint32_t quantity;
    const char *name;
    std::uint32_t channel_count;
    std::uint32_t kind;
};

// Z, N.X, N.Y, N.Z and id are what programs look for; of the others each is a layer by its name ("OpenEXR: Technical
// Introduction", channel names). Layers whose channels are alike have one.
constexpr std::array<FileLayer, 7> file_layers{{
    {PT_QUANTITY_STANDARD_ERROR, "standard_error", 3, PT_LAYER_COLOR},
    {PT_QUANTITY_SAMPLE_COUNT, "sample_count", 1, PT_LAYER_COLOR},
    {PT_QUANTITY_DEPTH, "Z", 1, PT_LAYER_COLOR},
    {PT_QUANTITY_NORMAL, "N", 3, PT_LAYER_VECTOR},
    {PT_QUANTITY_ALBEDO, "albedo", 3, PT_LAYER_COLOR},
    {PT_QUANTITY_OBJECT, "id", 1, PT_LAYER_NUMBERS},
    {PT_QUANTITY_COVERAGE, "A", 1, PT_LAYER_COLOR},
}};

const FileLayer &file_layer(std::uint32_t quantity) {
    return *std::find_if(file_layers.begin(), file_layers.end(),
                         [&](const FileLayer &layer) { return layer.quantity == quantity; });
}

} // namespace

std::vector<std::uint32_t> parse_layers(const std::string &text) {
    const ValueRule rule{.form = ValueRule::Form::name, .kind = "layer", .names = layer_names.names()};
    std::vector<std::uint32_t> quantities;
    std::istringstream names(text + ",");
    for (std::string name; std::getline(names, name, ',');) {
        read_value("--layers", name, rule);
        const std::uint32_t quantity = layer_names.find(name).value();
        if (std::find(quantities.begin(), quantities.end(), quantity) != quantities.end())
            refuse_option("--layers", "must name a layer once", text);
        quantities.push_back(quantity);
    }
    std::erase(quantities, std::uint32_t{PT_QUANTITY_RADIANCE});
    return quantities;
}

PictureLayer::PictureLayer(std::uint32_t of_quantity, std::size_t pixel_count) : quantity(of_quantity) {
    const FileLayer &layer = file_layer(quantity);
    if (layer.kind == PT_LAYER_NUMBERS)
        numbers.resize(pixel_count);
    else
        values.resize(pixel_count * layer.channel_count);
}

void PictureLayer::read(const Context &context, const Rectangle &part, std::uint32_t first_row, std::uint32_t rows) {
    const std::size_t first = std::size_t{part.width} * first_row;
    if (!numbers.empty()) {
        context.read_objects(part.x, part.width, rows, &numbers[first]);
    } else if (file_layer(quantity).channel_count == 3) {
        context.read_columns(part.x, part.width, rows, quantity, &values[3 * first]);
    } else {
        std::vector<float> alike(std::size_t{3} * part.width * rows);
        context.read_columns(part.x, part.width, rows, quantity, alike.data());
        for (std::size_t pixel = 0; pixel < alike.size() / 3; ++pixel)
            values[first + pixel] = alike[3 * pixel];
    }
}

pt_image_layer PictureLayer::in_file() const {
    const FileLayer &layer = file_layer(quantity);
    return {layer.name, layer.channel_count, layer.kind, values.data(), numbers.data()};
}

} // namespace cli
