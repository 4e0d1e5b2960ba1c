// Image files of the tests; see reference_image.h.
#include "tests/render/reference_image.h"

#include <OpenImageIO/imageio.h>

#include <stdexcept>

ReferenceImage read_reference(const std::string &name) {
    const std::string path = std::string(PT_TEST_REFERENCE_DIR) + "/" + name + ".exr";
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

void write_image(const std::string &path, std::uint32_t width, std::uint32_t height,
                 const std::vector<float> &radiance) {
    const auto output = OIIO::ImageOutput::create(path);
    const OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), 3, OIIO::TypeDesc::FLOAT);
    if (!output || !output->open(path, spec) || !output->write_image(OIIO::TypeDesc::FLOAT, radiance.data()))
        throw std::runtime_error("cannot write " + path);
}
