// What pictures of molecules need to know of the elements.
#pragma once

#include <cstdint>
#include <string_view>

namespace cli {

// Radii in angstroms. Van der Waals: Alvarez 2013, "A cartography of the van der Waals territories", 0 where there is
// none; covalent: Cordero et al. 2008, "Covalent radii revisited" (low spin, carbon sp3). Colours are those of Jmol,
// 0xRRGGBB in sRGB, which go back to the models of Corey, Pauling and Koltun.
struct ElementData {
    std::string_view symbol;
    float van_der_waals_radius;
    float covalent_radius;
    std::uint32_t colour;
};

// nullptr for what is none of the first 96 elements.
const ElementData *find_element(std::string_view symbol);

} // namespace cli
