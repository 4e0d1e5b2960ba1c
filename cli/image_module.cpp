// Owns the encoding of images by OpenImageIO, as a module of its own; see image_module.h for why.
// Called by image_file.cpp through dlsym.
#include "image_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

OIIO::ImageSpec describe(const pt_image_data &image) {
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), 3,
                         image.radiance != nullptr ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
    for (const pt_image_attribute &attribute : std::span(image.attributes, image.attribute_count)) {
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

} // namespace

extern "C" __attribute__((visibility("default"))) int32_t
pt_encode_image(const pt_image_data *image, pt_image_sink sink, void *user, char *message, size_t message_size) {
    try {
        const std::vector<unsigned char> file = encode(*image);
        sink(user, file.data(), file.size());
        return 0;
    } catch (const std::exception &error) {
        const size_t length = std::min(std::strlen(error.what()), message_size - 1);
        std::memcpy(message, error.what(), length);
        message[length] = '\0';
        return -1;
    }
}
