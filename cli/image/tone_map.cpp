#include "cli/image/tone_map.h"

#include "cli/base/context.h"
#include "cli/base/tasks.h"
#include "cli/base/text.h"
#include "lib/scene_file/enumerations.h"

#include <cstddef>

namespace cli {
namespace {

nlohmann::ordered_json in_json(std::span<const double> numbers) {
    if (numbers[0] == 0.0)
        return nullptr;
    return numbers.size() == 1 ? nlohmann::ordered_json(numbers[0]) : nlohmann::ordered_json(numbers);
}

} // namespace

ToneMap tone_map_for(pt_display_info display, std::span<const float> radiance) {
    const bool is_automatic = display.automatic_exposure != 0;
    if (is_automatic)
        display.exposure = automatic_exposure(radiance);
    display.automatic_exposure = 0;
    return {display, is_automatic};
}

double automatic_exposure(std::span<const float> radiance) {
    double exposure = 0.0;
    require(pt_automatic_exposure(radiance.data(), radiance.size() / 3, &exposure));
    return exposure;
}

std::vector<std::uint8_t> map_to_bytes(std::span<const float> radiance, const ToneMap &map,
                                       std::span<const float> alpha) {
    const std::size_t channels = alpha.empty() ? 3 : 4;
    std::vector<std::uint8_t> bytes(radiance.size() / 3 * channels);
    constexpr std::size_t grain = 20'000; // pixels
    in_parallel(radiance.size() / 3, grain, [&](std::size_t first, std::size_t end) {
        pt_display_info part = map.display;
        part.pixel_count = end - first;
        part.radiance = radiance.data() + 3 * first;
        part.alpha = alpha.empty() ? nullptr : alpha.data() + first;
        part.pixels = bytes.data() + channels * first;
        part.size_bytes = channels * (end - first);
        require(pt_display(&part));
    });
    return bytes;
}

nlohmann::ordered_json tone_map_json(const std::optional<ToneMap> &tone_map) {
    if (!tone_map)
        return nullptr;
    const pt_display_info &display = tone_map->display;
    nlohmann::ordered_json json{{"curve", pt::curves.name(display.curve)},
                                {"automatic_exposure", tone_map->is_automatic}};
    for (const auto &[name, numbers] : pt::numbers_of(display))
        json[std::string(name)] = in_json(numbers);
    json["exposure"] = display.exposure;
    return json;
}

void add_tone_map(std::vector<ImageAttribute> &attributes, const ToneMap &tone_map) {
    attributes.push_back({"pt.toneMap", std::string(pt::curves.name(tone_map.display.curve))});
    for (const auto &[name, numbers] : pt::numbers_of(tone_map.display)) {
        if (numbers.size() == 1 && (numbers[0] != 0.0 || name == "exposure"))
            attributes.push_back({concat("pt.", name), numbers[0]});
        else if (numbers[0] != 0.0)
            attributes.push_back(
                {concat("pt.", name), formatted("%.9g, %.9g, %.9g", numbers[0], numbers[1], numbers[2])});
        else if (name == "gamma")
            attributes.push_back({"pt.encoding", "sRGB"});
    }
}

std::string automatic_exposure_line(const std::optional<ToneMap> &tone_map) {
    return tone_map && tone_map->is_automatic ? formatted("exposure %.2f EV (auto)\n", tone_map->display.exposure) : "";
}

void write_display_image(ImageWriter &writer, const ImageTarget &target, ImageData image,
                         std::span<const float> radiance, const ToneMap &tone_map, std::span<const float> alpha) {
    const std::vector<std::uint8_t> bytes = map_to_bytes(radiance, tone_map, alpha);
    image.signals = bytes;
    if (tone_map.display.gamma != 0.0)
        image.gamma = tone_map.display.gamma;
    writer.write(target, image);
}

} // namespace cli
