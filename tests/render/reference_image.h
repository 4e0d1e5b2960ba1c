#pragma once

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

struct ReferenceImage {
    std::uint32_t width;
    std::uint32_t height;
    std::vector<float> radiance;
};

inline ReferenceImage read_reference(const std::string &name) {
    const std::string path = PT_TEST_REFERENCE_DIR "/" + name + ".exr";
    const auto input = OIIO::ImageInput::open(path);
    if (!input)
        throw std::runtime_error("cannot open " + path);
    const OIIO::ImageSpec &spec = input->spec();
    ReferenceImage image{static_cast<std::uint32_t>(spec.width), static_cast<std::uint32_t>(spec.height), {}};
    image.radiance.resize(std::size_t{image.width} * image.height * 3);
    if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, image.radiance.data()))
        throw std::runtime_error("cannot read " + path);
    return image;
}
