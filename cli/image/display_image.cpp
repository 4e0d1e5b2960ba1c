#include "cli/image/display_image.h"

#include <cstddef>
#include <string>

namespace cli {

void add_tone_map(ImageAttributes &attributes, const ToneMap &tone_map) {
    attributes.add("pt.toneMap", std::string(tone_curve_names[static_cast<std::size_t>(tone_map.curve)]));
    attributes.add_real("pt.exposure", tone_map.exposure);
    if (tone_map.gamma) {
        attributes.add_real("pt.gamma", *tone_map.gamma);
    } else {
        attributes.add("pt.encoding", "sRGB");
    }
}

void write_display_image(ImageWriter &writer, const ImageTarget &target, const ImageWindow &window,
                         std::span<const float> radiance, const ToneMap &tone_map, std::uint32_t png_bits,
                         std::span<const pt_image_attribute> attributes) {
    if (target.format == ImageFormat::png && png_bits == 16) {
        writer.write_signal(target, window, map_to_16_bits(radiance, tone_map), attributes, tone_map.gamma);
    } else {
        writer.write_signal(target, window, map_to_8_bits(radiance, tone_map), attributes, tone_map.gamma);
    }
}

} // namespace cli
