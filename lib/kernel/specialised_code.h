// A kernel's SPIR-V with its specialization constants filled in, and without what they leave out. Drivers do the same,
// but late: they translate and inline all of the kernel first, which takes most of the time that they take for it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// constants[i] has the bits of the specialization constant with id i; those beyond keep their defaults. The branches
// that constants do not take, and functions that are then not called, are left out; all else stays as it is, and so do
// the bits that the kernel computes. Empty if the code has something about it that is not known here: then it has to be
// specialised by the driver.
std::vector<std::uint32_t> specialised_code(std::span<const std::uint32_t> spirv,
                                            std::span<const std::uint32_t> constants);

} // namespace pt
