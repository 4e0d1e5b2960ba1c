#include "cli/image/image_file.h"

#include "cli/base/file.h"
#include "lib/platform/module.h"
#include "lib/platform/process.h"
#include "lib/platform/terminal.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>

namespace cli {
namespace {

std::array<std::size_t, 3> channels_of(const DecodedImage &image, const std::string &layer) {
    std::array<std::size_t, 3> channels{};
    const auto in_layer = [&](char letter) { return concat(layer, layer.empty() ? "" : ".", letter); };
    for (std::size_t i = 0; i < 3; ++i) {
        std::vector<std::string> names{in_layer("RGB"[i])};
        if (!layer.empty())
            names.insert(names.end(), {in_layer("XYZ"[i]), layer});
        const auto name = std::ranges::find_first_of(names, image.channels);
        refuse_if(name == names.end(),
                  "cannot read " + image.path + ": must have the channels R, G and B" +
                      (layer.empty() ? "" : " of the layer " + layer + ", or a channel of that name") + ", has " +
                      platform::printable(listed(image.channels)),
                  ExitCode::file);
        channels[i] = static_cast<std::size_t>(std::ranges::find(image.channels, *name) - image.channels.begin());
    }
    return channels;
}

} // namespace

std::string extensions(const std::function<bool(const ImageFormat &)> &holds, const char *between) {
    std::vector<std::string> extensions;
    for (const ImageFormat &format : image_formats)
        if (holds(format))
            extensions.push_back(concat(".", format.name));
    return listed(extensions, between);
}

std::optional<ImageFormat> format_of_name(std::string_view name) {
    const auto *found = std::ranges::find(image_formats, name, &ImageFormat::name);
    return found == image_formats.end() ? std::nullopt : std::optional(*found);
}

std::optional<ImageFormat> image_format(const std::string &path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return extension.empty() ? std::nullopt : format_of_name(extension.substr(1));
}

void check_image_names(std::span<const std::string> paths, std::optional<ImageFormat> format) {
    const bool to_standard_output = std::ranges::find(paths, standard_stream) != paths.end();
    refuse_if(to_standard_output && !format,
              "-o -: standard output needs --format, one of " + listed(image_format_names));
    refuse_if(to_standard_output && platform::is_terminal(platform::standard_output),
              "-o -: standard output is a terminal; send it to a file or a program");
    refuse_if(format && !to_standard_output,
              "--format: must be used with `-o -`; the name of a file states its format");
    for (const std::string &path : paths)
        refuse_if(path != standard_stream && !image_format(path),
                  "-o " + path + ": the name must end in one of " + extensions(any_format));
}

ImageTarget image_target(const std::string &path, std::optional<ImageFormat> format) {
    return {path, path == standard_stream ? format.value() : image_format(path).value()};
}

void check_image_target(const ImageTarget &target, const ImageWindow &window) {
    const std::uint32_t side = std::max(window.part.width, window.part.height);
    const std::uint32_t longest = target.format.longest_side;
    refuse_if(side > longest,
              concat("-o ", target.path, ": this format holds at most ", longest, " pixels a side, not ", side));
    if (target.path != standard_stream)
        AtomicFile::check_writable(target.path);
}

// Relative to the program, so an installed tree can be moved.
std::filesystem::path module_path() {
    const std::filesystem::path folder = platform::program_file().parent_path() / PT_MODULE_DIRECTORY;
    std::filesystem::path path = (folder / platform::module_file("pt-image-file")).lexically_normal();
    std::error_code ignored;
    refuse_if(!std::filesystem::exists(path, ignored),
              "formats other than PNG need the image module, and there is no " + path.string() +
                  "; install the package pt-image-formats, or build with libopenimageio-dev (wheels lack the module)",
              ExitCode::file);
    return path;
}

// The module is never unloaded, because OpenImageIO keeps threads and static objects.
void *load_symbol(const std::filesystem::path &path, const char *name) {
    void *module = platform::load_module(path);
    void *symbol = module == nullptr ? nullptr : platform::find_function(module, name);
    if (symbol == nullptr)
        throw Failure(ExitCode::internal, "cannot load the image module: " + platform::module_error());
    return symbol;
}

void ImageWriter::load_module() {
    encode_ = std::async(std::launch::async, [this, path = module_path()] {
        try {
            return reinterpret_cast<EncodeImage *>(load_symbol(path, encode_image_symbol));
        } catch (...) {
            failed_ = true;
            throw;
        }
    });
}

std::vector<unsigned char> ImageWriter::encoded(const ImageTarget &target, const ImageData &image) {
    if (!target.format.needs_module)
        return encode_png(image);
    if (!encode_.valid())
        load_module();
    std::vector<unsigned char> file;
    encode_.get()(image, std::string(target.format.name).c_str(), file);
    return file;
}

void ImageWriter::write(const ImageTarget &target, const ImageData &image) {
    OutputFile file(target.path);
    try {
        const std::vector<unsigned char> bytes = encoded(target, image);
        file.write(std::as_bytes(std::span(bytes)));
    } catch (const Failure &) {
        throw;
    } catch (const std::runtime_error &error) {
        throw Failure(ExitCode::file, "cannot write " + target.path + ": " + error.what());
    }
    file.commit();
}

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
    const auto format = image_format(path);
    const auto decode = format && !format->needs_module
                            ? &decode_png
                            : reinterpret_cast<DecodeImage *>(load_symbol(module_path(), decode_image_symbol));
    DecodedImage image{};
    read_file(path, [](const platform::InputFile &) {}); // throws if the file is unreadable
    try {
        decode(path, image);
    } catch (const Failure &) {
        throw;
    } catch (const std::runtime_error &error) {
        throw Failure(ExitCode::file, "cannot read " + path + ": " + error.what());
    }
    return image;
}

} // namespace cli
