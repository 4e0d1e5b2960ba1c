// Sets specialization constants and removes unreachable code. Drivers do so only after translating and inlining the
// whole kernel, which takes most of their time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// constants[i] has the id i. Other constants keep their defaults. The kernel computes the same bits. Returns nothing
// for unknown code, which the driver must specialise.
std::vector<std::uint32_t> specialised_code(std::span<const std::uint32_t> spirv,
                                            std::span<const std::uint32_t> constants);

} // namespace pt
