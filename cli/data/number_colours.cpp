#include "cli/data/number_colours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cli {
namespace {

constexpr std::size_t node_count = 52;

struct ColourTable {
    std::string_view name;
    std::string_view nodes; // RRGGBB of each
};

constexpr std::array<ColourTable, colour_map_names.size()> colour_tables{{
    {"viridis",
     "44015446085c471063481769481d6f482475472a7a46307e453781433d844142873f48893d4e8a3a538b38598c355e8d33638d31"
     "688e2e6d8e2c718e2a768e297b8e27808e25848e23898e218e8d20928c1f978b1e9c891fa18821a58524aa8328ae802eb37c35b7"
     "793dbc7446c06f50c46a5ac86465cb5e70cf577cd25089d54895d840a2da37b0dd2fbddf26cae11fd8e219e5e419f1e51dfde725"},
    {"magma",
     "00000402020b0504160907200e0b2b140e361a104221114e29115a311165390f6e420f754a107952137c5a167e6219806a1c8172"
     "1f81792282812581892881912b81992d80a1307eaa337db2357bba3878c23b75ca3e72d2426fd9466be04c67e75263ec5860f160"
     "5df4695cf7725cf97b5dfb8560fc8e64fd9869fea16efeaa74feb47bfebd82fec68afecf92fed89afde2a3fdebacfcf4b6fcfdbf"},
    {"cividis",
     "00224e002656002a5f002d68003070083370163770203a6f273e6e2e416d34456c3a486c3f4c6c444f6c49536c4e566c535a6d57"
     "5d6d5c616e60646f656870696b716d6f727272747676767a7a787e7d788381798885788d8878928c789690779b9476a09875a59c"
     "74aaa073afa471b5a86fbaac6dbfb06bc4b468c9b965cfbd62d4c15fdac65bdfca57e5cf52ead34cf0d846f6dd3ffce236fee838"},
}};

int hexadecimal_digit(char c) {
    return c <= '9' ? c - '0' : c - 'a' + 10;
}

double component(std::string_view nodes, std::size_t node, std::size_t channel) {
    const std::size_t place = 6 * node + 2 * channel;
    return 16 * hexadecimal_digit(nodes[place]) + hexadecimal_digit(nodes[place + 1]);
}

} // namespace

std::array<std::uint8_t, 3> map_colour(std::string_view name, double number) {
    const auto *table = std::find_if(colour_tables.begin(), colour_tables.end() - 1,
                                     [name](const ColourTable &each) { return each.name == name; });
    const double place = std::clamp(number, 0.0, 1.0) * (node_count - 1);
    const std::size_t node = std::min(static_cast<std::size_t>(place), node_count - 2);
    std::array<std::uint8_t, 3> colour{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const double value = std::lerp(component(table->nodes, node, channel),
                                       component(table->nodes, node + 1, channel), place - static_cast<double>(node));
        colour[channel] = static_cast<std::uint8_t>(std::lround(value));
    }
    return colour;
}

} // namespace cli
