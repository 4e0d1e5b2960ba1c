// SPIR-V modules (Khronos, "SPIR-V Specification", version 1.5).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace pt::spirv {

enum Opcode : std::uint32_t {
    OpName = 5,
    OpMemberName = 6,
    OpEntryPoint = 15,
    OpTypeVoid = 19,
    OpTypeBool = 20,
    OpTypeForwardPointer = 39,
    OpConstantTrue = 41,
    OpConstantFalse = 42,
    OpConstant = 43,
    OpConstantComposite = 44,
    OpSpecConstantTrue = 48,
    OpSpecConstantFalse = 49,
    OpSpecConstant = 50,
    OpSpecConstantComposite = 51,
    OpSpecConstantOp = 52,
    OpFunction = 54,
    OpFunctionEnd = 56,
    OpFunctionCall = 57,
    OpDecorate = 71,
    OpMemberDecorate = 72,
    OpIAdd = 128,
    OpISub = 130,
    OpIMul = 132,
    OpUDiv = 134,
    OpUMod = 137,
    OpLogicalEqual = 164,
    OpLogicalNotEqual = 165,
    OpLogicalOr = 166,
    OpLogicalAnd = 167,
    OpLogicalNot = 168,
    OpSelect = 169,
    OpIEqual = 170,
    OpINotEqual = 171,
    OpUGreaterThan = 172,
    OpUGreaterThanEqual = 174,
    OpULessThan = 176,
    OpULessThanEqual = 178,
    OpPhi = 245,
    OpLoopMerge = 246,
    OpSelectionMerge = 247,
    OpLabel = 248,
    OpBranch = 249,
    OpBranchConditional = 250,
    OpSwitch = 251,
    OpUnreachable = 255,
};

inline constexpr std::uint32_t decoration_spec_id = 1;
inline constexpr std::uint32_t decoration_binding = 33;
inline constexpr std::uint32_t decoration_descriptor_set = 34;
inline constexpr std::size_t header_words = 5;
inline constexpr std::size_t bound_word = 3;

using Words = std::span<const std::uint32_t>;

inline Opcode opcode_of(Words instruction) {
    return static_cast<Opcode>(instruction[0] & 0xffffU);
}

constexpr std::uint32_t first_word(Opcode opcode, std::uint32_t word_count) {
    return word_count << 16U | opcode;
}

struct Unknown {};

// Calls use(instruction, offset) for each instruction from offset on, until it returns false.
template <typename Use>
void for_each_instruction(Words code, std::size_t offset, Use &&use) {
    while (offset < code.size()) {
        const std::size_t length = code[offset] >> 16U;
        if (length == 0 || length > code.size() - offset)
            throw Unknown();
        if (!use(code.subspan(offset, length), offset))
            return;
        offset += length;
    }
}

} // namespace pt::spirv
