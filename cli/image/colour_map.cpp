#include "cli/image/colour_map.h"

#include "cli/base/exit_code.h"
#include "cli/image/image_module.h"
#include "cli/image/module_function.h"
#include "cli/image/tone_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace cli {

std::vector<std::uint8_t> map_colours(std::span<const float> numbers, std::uint32_t width) {
    const auto map = reinterpret_cast<pt_map_colours_fn>(load_symbol(module_path(), PT_MAP_COLOURS_SYMBOL));
    std::vector<float> known(numbers.size());
    std::transform(numbers.begin(), numbers.end(), known.begin(),
                   [](float number) { return std::isnan(number) ? 0.0F : number; });
    std::vector<float> light(3 * numbers.size());
    std::array<char, 512> message{};
    const auto height = static_cast<std::uint32_t>(numbers.size() / width);
    if (map(known.data(), width, height, light.data(), message.data(), message.size()) != 0) {
        throw Failure(ExitCode::internal, std::string("cannot map colours: ") + message.data());
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (std::isnan(numbers[i])) {
            std::fill_n(light.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, 1.0F);
        }
    }
    return map_to_8_bits(light, {});
}

} // namespace cli
