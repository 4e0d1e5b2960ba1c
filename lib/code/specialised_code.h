// Sets specialization constants and removes unreachable code. Drivers would do so only after they have translated and
// inlined the whole kernel, which takes most of their time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// constants[i] is the value of constant_id i. Other constants keep their defaults. Returns an empty vector for code
// that it does not know; the driver must then specialise the code.
std::vector<std::uint32_t> specialised_code(std::span<const std::uint32_t> spirv,
                                            std::span<const std::uint32_t> constants);

} // namespace pt
