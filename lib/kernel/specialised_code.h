// Fills in a kernel's specialization constants and removes what they make unreachable. Drivers do so too, but only
// after translating and inlining the whole kernel, which takes most of their time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// constants[i]: the bits of the constant with id i; others keep their defaults. Branches not taken and functions not
// called are removed; the kernel computes the same bits. Empty if the code has something unknown: then the driver has
// to specialise it.
std::vector<std::uint32_t> specialised_code(std::span<const std::uint32_t> spirv,
                                            std::span<const std::uint32_t> constants);

} // namespace pt
