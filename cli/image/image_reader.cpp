#include "cli/image/image_reader.h"

#include "cli/base/exit_code.h"
#include "cli/image/module_function.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <optional>

namespace cli {
namespace {

DecodedImage owned(const std::string &path, const pt_decoded_image &image) {
    DecodedImage copy{};
    copy.path = path;
    copy.x = image.x;
    copy.y = image.y;
    copy.width = image.width;
    copy.height = image.height;
    copy.full_width = image.full_width;
    copy.full_height = image.full_height;
    copy.is_float = image.is_float != 0;
    copy.channels.assign(image.channel_names, image.channel_names + image.channel_count);
    copy.values.assign(image.values, image.values + std::size_t{image.channel_count} * image.width * image.height);
    copy.attributes = std::make_unique<ImageAttributes>();
    std::for_each(image.attributes, image.attributes + image.attribute_count,
                  [&](const pt_image_attribute &each) { copy.attributes->add_copy(each); });
    return copy;
}

// What came of decoding. The sink runs under the module's C frame, which no exception may cross.
struct DecodedSink {
    const std::string &path;
    DecodedImage image;
    std::exception_ptr error;

    static void receive(void *user, const pt_decoded_image *image) {
        auto *sink = static_cast<DecodedSink *>(user);
        try {
            sink->image = owned(sink->path, *image);
        } catch (...) {
            sink->error = std::current_exception();
        }
    }
};

std::optional<std::size_t> find_channel(const DecodedImage &image, const std::string &name) {
    const auto found = std::find(image.channels.begin(), image.channels.end(), name);
    return found == image.channels.end() ? std::nullopt
                                         : std::optional(static_cast<std::size_t>(found - image.channels.begin()));
}

// "R, G, B" of a file that has no layers but the main one; otherwise the names of layers.
std::string contents_text(const DecodedImage &image) {
    std::string text;
    for (const std::string &name : image.channels)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

std::array<std::size_t, 3> channels_of(const DecodedImage &image, const std::string &layer) {
    std::array<std::size_t, 3> channels{};
    const std::string prefix = layer.empty() ? "" : layer + ".";
    for (std::size_t i = 0; i < 3; ++i) {
        auto found = find_channel(image, prefix + "RGB"[i]);
        found = found || layer.empty() ? found : find_channel(image, prefix + "XYZ"[i]);
        found = found || layer.empty() ? found : find_channel(image, layer);
        if (!found) {
            throw Failure(ExitCode::file,
                          "cannot read " + image.path + ": must have the channels R, G and B" +
                              (layer.empty() ? "" : " of the layer " + layer + ", or a channel of that name") +
                              ", has " + contents_text(image));
        }
        channels[i] = *found;
    }
    return channels;
}

} // namespace

std::vector<float> DecodedImage::layer(const std::string &name) const {
    const std::array<std::size_t, 3> wanted = channels_of(*this, name);
    std::vector<float> chosen;
    chosen.reserve(std::size_t{3} * width * height);
    for (std::size_t pixel = 0; pixel < values.size(); pixel += channels.size())
        for (const std::size_t channel : wanted)
            chosen.push_back(values[pixel + channel]);
    return chosen;
}

DecodedImage read_image(const std::string &path) {
    const auto decode = reinterpret_cast<pt_decode_image_fn>(load_symbol(module_path(), PT_DECODE_IMAGE_SYMBOL));
    DecodedSink sink{path, {}, nullptr};
    std::array<char, 512> message{};
    if (decode(path.c_str(), &DecodedSink::receive, &sink, message.data(), message.size()) != 0)
        throw Failure(ExitCode::file, "cannot read " + path + ": " + message.data());
    if (sink.error)
        std::rethrow_exception(sink.error);
    return std::move(sink.image);
}

RadianceImage read_radiance(const std::string &path) {
    const DecodedImage image = read_image(path);
    return {image.width, image.height, image.layer("")};
}

} // namespace cli
