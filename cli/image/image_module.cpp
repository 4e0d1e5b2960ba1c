#include "cli/image/image_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <bit>
#include <memory>
#include <stdexcept>

namespace {

using namespace cli;

// JPEG has only one text, a description.
std::string description(std::span<const ImageAttribute> attributes) {
    std::vector<std::string> lines;
    for (const ImageAttribute &attribute : attributes)
        lines.push_back(attribute.name + ": " + attribute_text(attribute));
    return listed(lines, "\n");
}

// The main layer has "R", "G", "B", and others have "layer.R". A single channel has the layer's name.
std::vector<std::string> channel_names(std::span<const ImageLayer> layers) {
    std::vector<std::string> names;
    for (const ImageLayer &layer : layers) {
        if (layer.channel_count == 1) {
            names.push_back(layer.name);
            continue;
        }
        for (const char channel : std::string_view(layer.kind == LayerKind::vector ? "XYZ" : "RGB"))
            names.push_back((layer.name.empty() ? "" : layer.name + ".") + channel);
    }
    return names;
}

std::vector<OIIO::TypeDesc> channel_types(std::span<const ImageLayer> layers) {
    std::vector<OIIO::TypeDesc> types;
    for (const ImageLayer &layer : layers) {
        const bool is_whole = layer.kind == LayerKind::numbers;
        types.insert(types.end(), layer.channel_count, is_whole ? OIIO::TypeDesc::UINT32 : OIIO::TypeDesc::FLOAT);
    }
    const bool has_numbers = std::find(types.begin(), types.end(), OIIO::TypeDesc::UINT32) != types.end();
    return has_numbers ? types : std::vector<OIIO::TypeDesc>();
}

// Rec. 709 (ITU-R BT.709-6, table 1).
void add_chromaticities(OIIO::ImageSpec &spec) {
    constexpr std::array<float, 8> rec709{0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, rec709.size()), rec709.data());
}

OIIO::ImageSpec describe_radiance(const ImageData &image) {
    const auto &[part, full_width, full_height] = image.window;
    OIIO::ImageSpec spec(static_cast<int>(part.width), static_cast<int>(part.height), 1, OIIO::TypeDesc::FLOAT);
    spec.channelnames = channel_names(image.layers);
    spec.nchannels = static_cast<int>(spec.channelnames.size());
    spec.channelformats = channel_types(image.layers);
    const auto alpha = std::find(spec.channelnames.begin(), spec.channelnames.end(), "A");
    spec.alpha_channel = alpha == spec.channelnames.end() ? -1 : static_cast<int>(alpha - spec.channelnames.begin());
    spec.x = static_cast<int>(part.x);
    spec.y = static_cast<int>(part.y);
    spec.full_width = static_cast<int>(full_width);
    spec.full_height = static_cast<int>(full_height);
    add_chromaticities(spec);
    spec.attribute("DateTime", ""); // otherwise OpenImageIO writes the present date
    return spec;
}

OIIO::ImageSpec describe_bytes(const ImageData &image) {
    const Rectangle &part = image.window.part;
    OIIO::ImageSpec spec(static_cast<int>(part.width), static_cast<int>(part.height), 3, OIIO::TypeDesc::UINT8);
    spec.attribute("ImageDescription", description(image.attributes));
    return spec;
}

void add_attributes(OIIO::ImageSpec &spec, std::span<const ImageAttribute> attributes) {
    for (const auto &[name, value] : attributes)
        if (const auto *text = std::get_if<std::string>(&value))
            spec.attribute(name, *text);
        else if (const auto *whole = std::get_if<std::int32_t>(&value))
            spec.attribute(name, *whole);
        else
            spec.attribute(name, static_cast<float>(std::get<double>(value)));
}

void interleave_row(const ImageData &image, std::uint32_t y, std::span<std::uint32_t> row) {
    const std::size_t width = image.window.part.width;
    const std::size_t stride = row.size() / width;
    std::size_t offset = 0;
    for (const ImageLayer &layer : image.layers) {
        const std::size_t first = y * width * layer.channel_count;
        for (std::size_t x = 0; x < width; ++x) {
            for (std::size_t channel = 0; channel < layer.channel_count; ++channel) {
                const std::size_t index = first + x * layer.channel_count + channel;
                row[x * stride + offset + channel] = layer.kind == LayerKind::numbers
                                                         ? layer.numbers[index]
                                                         : std::bit_cast<std::uint32_t>(layer.values[index]);
            }
        }
        offset += layer.channel_count;
    }
}

bool write_layers(OIIO::ImageOutput &output, const OIIO::ImageSpec &spec, const ImageData &image) {
    std::vector<std::uint32_t> row(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels));
    const OIIO::TypeDesc type =
        spec.channelformats.empty() ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UNKNOWN; // the type of each channel
    for (std::uint32_t y = 0; y < image.window.part.height; ++y) {
        interleave_row(image, y, row);
        if (!output.write_scanline(spec.y + static_cast<int>(y), 0, type, row.data()))
            return false;
    }
    return true;
}

// Encodes in memory, because OpenImageIO ignores errors when it closes a file.
std::vector<unsigned char> encode(const ImageData &image, const char *extension) {
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(std::string("image.") + extension);
    if (!output)
        throw std::runtime_error(OIIO::geterror());
    OIIO::Filesystem::IOVecOutput memory;
    const bool is_radiance = !image.layers.empty();
    OIIO::ImageSpec spec = is_radiance ? describe_radiance(image) : describe_bytes(image);
    add_attributes(spec, image.attributes);
    const bool is_written =
        output->set_ioproxy(&memory) && output->open(std::string("image.") + extension, spec) &&
        (is_radiance ? write_layers(*output, spec, image) : output->write_image(spec.format, image.signals.data())) &&
        output->close();
    if (!is_written)
        throw std::runtime_error(output->geterror());
    return std::move(memory.buffer());
}

std::vector<ImageAttribute> attributes_of(const OIIO::ImageSpec &spec) {
    std::vector<ImageAttribute> attributes;
    for (const OIIO::ParamValue &each : spec.extra_attribs) {
        const std::string name = each.name().string();
        if (each.type() == OIIO::TypeDesc::STRING)
            attributes.push_back({name, each.get_ustring().string()});
        else if (each.type() == OIIO::TypeDesc::FLOAT)
            attributes.push_back({name, double{each.get_float()}});
        else if (each.type() == OIIO::TypeDesc::INT)
            attributes.push_back({name, each.get_int()});
    }
    return attributes;
}

void decode(const std::string &path, DecodedImage &image) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
    if (!input)
        throw std::runtime_error(OIIO::geterror());
    const OIIO::ImageSpec &spec = input->spec();
    image.values.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.values.data()))
        throw std::runtime_error(input->geterror());
    image.path = path;
    image.x = spec.x - spec.full_x;
    image.y = spec.y - spec.full_y;
    image.width = static_cast<std::uint32_t>(spec.width);
    image.height = static_cast<std::uint32_t>(spec.height);
    image.full_width = static_cast<std::uint32_t>(spec.full_width);
    image.full_height = static_cast<std::uint32_t>(spec.full_height);
    image.is_float = spec.format.is_floating_point();
    image.channels = spec.channelnames;
    image.attributes = attributes_of(spec);
}

} // namespace

extern "C" __attribute__((visibility("default"))) void pt_encode_image(const ImageData &image, const char *extension,
                                                                       std::vector<unsigned char> &file) {
    file = encode(image, extension);
}

extern "C" __attribute__((visibility("default"))) void pt_decode_image(const std::string &path, DecodedImage &image) {
    decode(path, image);
}
