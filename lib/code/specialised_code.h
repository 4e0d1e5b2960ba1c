// Sets specialization constants and removes unreachable code. Drivers do so only after translating and inlining the
// whole kernel, which takes them most of their time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// constants[i] has the id i. Other constants keep their defaults. The result computes the same bits. Unknown code gives
// no result, and the driver must specialise it.
std::vector<std::uint32_t> specialised_code(std::span<const std::uint32_t> spirv,
                                            std::span<const std::uint32_t> constants);

} // namespace pt
