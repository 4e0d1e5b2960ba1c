// The module that encodes and decodes images by OpenImageIO; image_module.h says why it is one. image_file.cpp finds
// its two functions by dlsym.
#include "cli/image/image_module.h"

#include "cli/image/image_attribute_text.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <exception>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

// JPEG has no named attributes, only a description: a line for each.
std::string description(std::span<const pt_image_attribute> attributes) {
    std::string text;
    for (const pt_image_attribute &attribute : attributes) {
        if (!text.empty())
            text += '\n';
        text += attribute.name;
        text += ": ";
        text += image_attribute_text(attribute);
    }
    return text;
}

// "R", "G" and "B" of the main layer, "layer.R" or "layer.X" of others, and the name alone of a layer of one channel.
std::vector<std::string> channel_names(std::span<const pt_image_layer> layers) {
    std::vector<std::string> names;
    for (const pt_image_layer &layer : layers) {
        const std::string name = layer.name;
        if (layer.channel_count == 1) {
            names.push_back(name);
            continue;
        }
        for (const char channel : std::string_view(layer.kind == PT_LAYER_VECTOR ? "XYZ" : "RGB"))
            names.push_back((name.empty() ? "" : name + ".") + channel);
    }
    return names;
}

// Of each channel; none where all are of floats.
std::vector<OIIO::TypeDesc> channel_types(std::span<const pt_image_layer> layers) {
    std::vector<OIIO::TypeDesc> types;
    for (const pt_image_layer &layer : layers) {
        const bool is_whole = layer.kind == PT_LAYER_NUMBERS;
        types.insert(types.end(), layer.channel_count, is_whole ? OIIO::TypeDesc::UINT32 : OIIO::TypeDesc::FLOAT);
    }
    const bool has_numbers = std::find(types.begin(), types.end(), OIIO::TypeDesc::UINT32) != types.end();
    return has_numbers ? types : std::vector<OIIO::TypeDesc>();
}

// The primaries and the white point of Rec. 709 (ITU-R BT.709-6, table 1), those of the radiance.
void add_chromaticities(OIIO::ImageSpec &spec) {
    constexpr std::array<float, 8> rec709{0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, rec709.size()), rec709.data());
}

OIIO::ImageSpec describe_radiance(const pt_image_data &image) {
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), 1, OIIO::TypeDesc::FLOAT);
    spec.channelnames = channel_names({image.layers, image.layer_count});
    spec.nchannels = static_cast<int>(spec.channelnames.size());
    spec.channelformats = channel_types({image.layers, image.layer_count});
    const auto alpha = std::find(spec.channelnames.begin(), spec.channelnames.end(), "A");
    spec.alpha_channel = alpha == spec.channelnames.end() ? -1 : static_cast<int>(alpha - spec.channelnames.begin());
    spec.x = static_cast<int>(image.x);
    spec.y = static_cast<int>(image.y);
    spec.full_width = static_cast<int>(image.full_width);
    spec.full_height = static_cast<int>(image.full_height);
    add_chromaticities(spec);
    spec.attribute("DateTime", ""); // without a date, OpenImageIO would write the present one
    return spec;
}

OIIO::ImageSpec describe_bytes(const pt_image_data &image) {
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), 3, OIIO::TypeDesc::UINT8);
    spec.attribute("ImageDescription", description({image.attributes, image.attribute_count}));
    return spec;
}

void add_attributes(OIIO::ImageSpec &spec, std::span<const pt_image_attribute> attributes) {
    for (const pt_image_attribute &attribute : attributes)
        if (attribute.text != nullptr)
            spec.attribute(attribute.name, attribute.text);
        else if (attribute.is_float != 0)
            spec.attribute(attribute.name, static_cast<float>(attribute.number));
        else
            spec.attribute(attribute.name, static_cast<int>(attribute.number));
}

// One row of the file, in which the channels of all layers stand side by side: floats and whole numbers by their bits.
void interleave_row(const pt_image_data &image, std::uint32_t y, std::span<std::uint32_t> row) {
    const std::size_t stride = row.size() / image.width;
    std::size_t offset = 0;
    for (const pt_image_layer &layer : std::span(image.layers, image.layer_count)) {
        const std::size_t first = std::size_t{y} * image.width * layer.channel_count;
        for (std::size_t x = 0; x < image.width; ++x) {
            for (std::size_t channel = 0; channel < layer.channel_count; ++channel) {
                const std::size_t index = first + x * layer.channel_count + channel;
                row[x * stride + offset + channel] = layer.kind == PT_LAYER_NUMBERS
                                                         ? layer.numbers[index]
                                                         : std::bit_cast<std::uint32_t>(layer.values[index]);
            }
        }
        offset += layer.channel_count;
    }
}

bool write_layers(OIIO::ImageOutput &output, const OIIO::ImageSpec &spec, const pt_image_data &image) {
    std::vector<std::uint32_t> row(std::size_t{image.width} * static_cast<std::size_t>(spec.nchannels));
    const OIIO::TypeDesc type =
        spec.channelformats.empty() ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UNKNOWN; // its own
    for (std::uint32_t y = 0; y < image.height; ++y) {
        interleave_row(image, y, row);
        if (!output.write_scanline(spec.y + static_cast<int>(y), 0, type, row.data()))
            return false;
    }
    return true;
}

// In memory and not to a path: OpenImageIO does not notice when closing a file fails, as it does on a full disk.
std::vector<unsigned char> encode(const pt_image_data &image) {
    const std::string name = std::string("image.") + image.extension;
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
    if (!output)
        throw std::runtime_error(OIIO::geterror());
    OIIO::Filesystem::IOVecOutput memory;
    const bool is_radiance = image.layers != nullptr;
    OIIO::ImageSpec spec = is_radiance ? describe_radiance(image) : describe_bytes(image);
    add_attributes(spec, {image.attributes, image.attribute_count});
    const bool is_written =
        output->set_ioproxy(&memory) && output->open(name, spec) &&
        (is_radiance ? write_layers(*output, spec, image) : output->write_image(spec.format, image.bytes)) &&
        output->close();
    if (!is_written)
        throw std::runtime_error(output->geterror());
    return std::move(memory.buffer());
}

// Texts and single numbers, which are all that this program writes; the result points into the specification.
std::vector<pt_image_attribute> attributes_of(const OIIO::ImageSpec &spec) {
    std::vector<pt_image_attribute> attributes;
    for (const OIIO::ParamValue &each : spec.extra_attribs) {
        const OIIO::TypeDesc type = each.type();
        if (type == OIIO::TypeDesc::STRING) {
            attributes.push_back({each.name().c_str(), each.get_ustring().c_str(), 0.0, 0, 0});
        } else if (type == OIIO::TypeDesc::FLOAT || type == OIIO::TypeDesc::INT) {
            const bool is_float = type == OIIO::TypeDesc::FLOAT;
            const double number = is_float ? double{each.get_float()} : double(each.get_int());
            attributes.push_back({each.name().c_str(), nullptr, number, is_float ? 1 : 0, 0});
        }
    }
    return attributes;
}

void decode(const char *path, pt_decoded_sink sink, void *user) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
    if (!input)
        throw std::runtime_error(OIIO::geterror());
    const OIIO::ImageSpec &spec = input->spec();
    std::vector<float> values(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
        throw std::runtime_error(input->geterror());
    std::vector<const char *> names;
    for (const std::string &name : spec.channelnames)
        names.push_back(name.c_str());
    const std::vector<pt_image_attribute> attributes = attributes_of(spec);
    pt_decoded_image image{};
    image.x = spec.x - spec.full_x;
    image.y = spec.y - spec.full_y;
    image.width = static_cast<std::uint32_t>(spec.width);
    image.height = static_cast<std::uint32_t>(spec.height);
    image.full_width = static_cast<std::uint32_t>(spec.full_width);
    image.full_height = static_cast<std::uint32_t>(spec.full_height);
    image.is_float = spec.format.is_floating_point() ? 1 : 0;
    image.channel_count = static_cast<std::uint32_t>(spec.nchannels);
    image.channel_names = names.data();
    image.values = values.data();
    image.attributes = attributes.data();
    image.attribute_count = attributes.size();
    sink(user, &image);
}

int32_t failure(std::string_view text, char *message, size_t message_size) {
    const size_t length = std::min(text.size(), message_size - 1);
    std::memcpy(message, text.data(), length);
    message[length] = '\0';
    return -1;
}

// No exception leaves the module: its caller sees plain C.
template <typename Work>
int32_t guard(Work work, char *message, size_t message_size) {
    try {
        work();
        return 0;
    } catch (const std::exception &error) {
        return failure(error.what(), message, message_size);
    } catch (...) {
        return failure("an exception of unknown type", message, message_size);
    }
}

} // namespace

extern "C" __attribute__((visibility("default"))) int32_t
pt_encode_image(const pt_image_data *image, pt_image_sink sink, void *user, char *message, size_t message_size) {
    const auto work = [&] {
        const std::vector<unsigned char> file = encode(*image);
        sink(user, file.data(), file.size());
    };
    return guard(work, message, message_size);
}

extern "C" __attribute__((visibility("default"))) int32_t
pt_decode_image(const char *path, pt_decoded_sink sink, void *user, char *message, size_t message_size) {
    return guard([&] { decode(path, sink, user); }, message, message_size);
}
