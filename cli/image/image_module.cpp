// The module that encodes and decodes images by OpenImageIO; image_module.h says why it is one. image_file.cpp finds
// its two functions by dlsym.
#include "cli/image/image_module.h"

#include "cli/image/image_attribute_text.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
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
        if (!text.empty()) {
            text += '\n';
        }
        text += attribute.name;
        text += ": ";
        text += image_attribute_text(attribute);
    }
    return text;
}

OIIO::ImageSpec describe(const pt_image_data &image) {
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), 3,
                         image.radiance != nullptr ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
    const std::span attributes(image.attributes, image.attribute_count);
    if (image.radiance == nullptr) {
        spec.attribute("ImageDescription", description(attributes));
    } else {
        spec.attribute("DateTime", ""); // without a date, OpenImageIO would write the present one
    }
    for (const pt_image_attribute &attribute : attributes) {
        if (attribute.text != nullptr) {
            spec.attribute(attribute.name, attribute.text);
        } else if (attribute.is_float != 0) {
            spec.attribute(attribute.name, static_cast<float>(attribute.number));
        } else {
            spec.attribute(attribute.name, static_cast<int>(attribute.number));
        }
    }
    return spec;
}

// In memory and not to a path: OpenImageIO does not notice when closing a file fails, as it does on a full disk.
std::vector<unsigned char> encode(const pt_image_data &image) {
    const std::string name = std::string("image.") + image.extension;
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
    if (!output) {
        throw std::runtime_error(OIIO::geterror());
    }
    OIIO::Filesystem::IOVecOutput memory;
    const void *pixels = image.radiance != nullptr ? static_cast<const void *>(image.radiance) : image.bytes;
    const OIIO::ImageSpec spec = describe(image);
    if (!output->set_ioproxy(&memory) || !output->open(name, spec) || !output->write_image(spec.format, pixels) ||
        !output->close()) {
        throw std::runtime_error(output->geterror());
    }
    return std::move(memory.buffer());
}

void decode(const char *path, pt_radiance_sink sink, void *user) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
    if (!input) {
        throw std::runtime_error(OIIO::geterror());
    }
    const OIIO::ImageSpec &spec = input->spec();
    const int red = spec.channelindex("R");
    if (red < 0 || spec.channelindex("G") != red + 1 || spec.channelindex("B") != red + 2) {
        throw std::runtime_error("must have the channels R, G and B, one after the other");
    }
    std::vector<float> radiance(std::size_t{3} * spec.image_pixels());
    if (!input->read_image(0, 0, red, red + 3, OIIO::TypeDesc::FLOAT, radiance.data())) {
        throw std::runtime_error(input->geterror());
    }
    sink(user, static_cast<std::uint32_t>(spec.width), static_cast<std::uint32_t>(spec.height), radiance.data());
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
pt_decode_image(const char *path, pt_radiance_sink sink, void *user, char *message, size_t message_size) {
    return guard([&] { decode(path, sink, user); }, message, message_size);
}
