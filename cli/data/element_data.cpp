#include "cli/data/element_data.h"

#include <algorithm>
#include <array>

namespace cli {
namespace {

constexpr std::array<ElementData, 96> elements{
    {{"H", 1.20F, 0.31F, 0xffffff},  {"He", 1.43F, 0.28F, 0xd9ffff}, {"Li", 2.12F, 1.28F, 0xcc80ff},
     {"Be", 1.98F, 0.96F, 0xc2ff00}, {"B", 1.91F, 0.84F, 0xffb5b5},  {"C", 1.77F, 0.76F, 0x909090},
     {"N", 1.66F, 0.71F, 0x3050f8},  {"O", 1.50F, 0.66F, 0xff0d0d},  {"F", 1.46F, 0.57F, 0x90e050},
     {"Ne", 1.58F, 0.58F, 0xb3e3f5}, {"Na", 2.50F, 1.66F, 0xab5cf2}, {"Mg", 2.51F, 1.41F, 0x8aff00},
     {"Al", 2.25F, 1.21F, 0xbfa6a6}, {"Si", 2.19F, 1.11F, 0xf0c8a0}, {"P", 1.90F, 1.07F, 0xff8000},
     {"S", 1.89F, 1.05F, 0xffff30},  {"Cl", 1.82F, 1.02F, 0x1ff01f}, {"Ar", 1.94F, 1.06F, 0x80d1e3},
     {"K", 2.73F, 2.03F, 0x8f40d4},  {"Ca", 2.62F, 1.76F, 0x3dff00}, {"Sc", 2.58F, 1.70F, 0xe6e6e6},
     {"Ti", 2.46F, 1.60F, 0xbfc2c7}, {"V", 2.42F, 1.53F, 0xa6a6ab},  {"Cr", 2.45F, 1.39F, 0x8a99c7},
     {"Mn", 2.45F, 1.39F, 0x9c7ac7}, {"Fe", 2.44F, 1.32F, 0xe06633}, {"Co", 2.40F, 1.26F, 0xf090a0},
     {"Ni", 2.40F, 1.24F, 0x50d050}, {"Cu", 2.38F, 1.32F, 0xc88033}, {"Zn", 2.39F, 1.22F, 0x7d80b0},
     {"Ga", 2.32F, 1.22F, 0xc28f8f}, {"Ge", 2.29F, 1.20F, 0x668f8f}, {"As", 1.88F, 1.19F, 0xbd80e3},
     {"Se", 1.82F, 1.20F, 0xffa100}, {"Br", 1.86F, 1.20F, 0xa62929}, {"Kr", 2.07F, 1.16F, 0x5cb8d1},
     {"Rb", 3.21F, 2.20F, 0x702eb0}, {"Sr", 2.84F, 1.95F, 0x00ff00}, {"Y", 2.75F, 1.90F, 0x94ffff},
     {"Zr", 2.52F, 1.75F, 0x94e0e0}, {"Nb", 2.56F, 1.64F, 0x73c2c9}, {"Mo", 2.45F, 1.54F, 0x54b5b5},
     {"Tc", 2.44F, 1.47F, 0x3b9e9e}, {"Ru", 2.46F, 1.46F, 0x248f8f}, {"Rh", 2.44F, 1.42F, 0x0a7d8c},
     {"Pd", 2.15F, 1.39F, 0x006985}, {"Ag", 2.53F, 1.45F, 0xc0c0c0}, {"Cd", 2.49F, 1.44F, 0xffd98f},
     {"In", 2.43F, 1.42F, 0xa67573}, {"Sn", 2.42F, 1.39F, 0x668080}, {"Sb", 2.47F, 1.39F, 0x9e63b5},
     {"Te", 1.99F, 1.38F, 0xd47a00}, {"I", 2.04F, 1.39F, 0x940094},  {"Xe", 2.28F, 1.40F, 0x429eb0},
     {"Cs", 3.48F, 2.44F, 0x57178f}, {"Ba", 3.03F, 2.15F, 0x00c900}, {"La", 2.98F, 2.07F, 0x70d4ff},
     {"Ce", 2.88F, 2.04F, 0xffffc7}, {"Pr", 2.92F, 2.03F, 0xd9ffc7}, {"Nd", 2.95F, 2.01F, 0xc7ffc7},
     {"Pm", 0.00F, 1.99F, 0xa3ffc7}, {"Sm", 2.90F, 1.98F, 0x8fffc7}, {"Eu", 2.87F, 1.98F, 0x61ffc7},
     {"Gd", 2.83F, 1.96F, 0x45ffc7}, {"Tb", 2.79F, 1.94F, 0x30ffc7}, {"Dy", 2.87F, 1.92F, 0x1fffc7},
     {"Ho", 2.81F, 1.92F, 0x00ff9c}, {"Er", 2.83F, 1.89F, 0x00e675}, {"Tm", 2.79F, 1.90F, 0x00d452},
     {"Yb", 2.80F, 1.87F, 0x00bf38}, {"Lu", 2.74F, 1.87F, 0x00ab24}, {"Hf", 2.63F, 1.75F, 0x4dc2ff},
     {"Ta", 2.53F, 1.70F, 0x4da6ff}, {"W", 2.57F, 1.62F, 0x2194d6},  {"Re", 2.49F, 1.51F, 0x267dab},
     {"Os", 2.48F, 1.44F, 0x266696}, {"Ir", 2.41F, 1.41F, 0x175487}, {"Pt", 2.29F, 1.36F, 0xd0d0e0},
     {"Au", 2.32F, 1.36F, 0xffd123}, {"Hg", 2.45F, 1.32F, 0xb8b8d0}, {"Tl", 2.47F, 1.45F, 0xa6544d},
     {"Pb", 2.60F, 1.46F, 0x575961}, {"Bi", 2.54F, 1.48F, 0x9e4fb5}, {"Po", 0.00F, 1.40F, 0xab5c00},
     {"At", 0.00F, 1.50F, 0x754f45}, {"Rn", 2.40F, 1.50F, 0x428296}, {"Fr", 0.00F, 2.60F, 0x420066},
     {"Ra", 0.00F, 2.21F, 0x007d00}, {"Ac", 2.80F, 2.15F, 0x70abfa}, {"Th", 2.93F, 2.06F, 0x00baff},
     {"Pa", 2.88F, 2.00F, 0x00a1ff}, {"U", 2.71F, 1.96F, 0x008fff},  {"Np", 2.82F, 1.90F, 0x0080ff},
     {"Pu", 2.81F, 1.87F, 0x006bff}, {"Am", 2.83F, 1.80F, 0x545cf2}, {"Cm", 3.05F, 1.69F, 0x785ce3}}};

} // namespace

const ElementData *find_element(std::string_view symbol) {
    const auto *found = std::find_if(elements.begin(), elements.end(),
                                     [symbol](const ElementData &each) { return each.symbol == symbol; });
    return found == elements.end() ? nullptr : &*found;
}

} // namespace cli
