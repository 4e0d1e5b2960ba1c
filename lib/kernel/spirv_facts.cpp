// Folds constants and follows branches; see spirv_facts.h.
#include "lib/kernel/spirv_facts.h"

#include <array>

namespace pt::spirv {

namespace {

// The result of an operation with up to three operands.
std::uint32_t result_of(std::uint32_t operation, const std::array<std::uint32_t, 3> &operand) {
    const auto [a, b, c] = operand;
    switch (operation) {
    case OpIAdd:
        return a + b;
    case OpISub:
        return a - b;
    case OpIMul:
        return a * b;
    case OpUDiv:
    case OpUMod:
        if (b == 0)
            throw Unknown();
        return operation == OpUDiv ? a / b : a % b;
    case OpLogicalOr:
        return a | b;
    case OpLogicalAnd:
        return a & b;
    case OpLogicalNot:
        return 1 - a;
    case OpSelect:
        return a != 0 ? b : c;
    case OpIEqual:
    case OpLogicalEqual:
        return a == b ? 1 : 0;
    case OpINotEqual:
    case OpLogicalNotEqual:
        return a != b ? 1 : 0;
    case OpUGreaterThan:
        return a > b ? 1 : 0;
    case OpUGreaterThanEqual:
        return a >= b ? 1 : 0;
    case OpULessThan:
        return a < b ? 1 : 0;
    case OpULessThanEqual:
        return a <= b ? 1 : 0;
    default:
        throw Unknown();
    }
}

bool ends_block(Opcode opcode) {
    return opcode >= OpBranch && opcode <= OpUnreachable;
}

} // namespace

Facts::Facts(Words code, Words constants) : code_(code), constants_(constants), facts_(code[bound_word]) {
    waiting_.reserve(facts_.size());
    for_each_instruction(code_, header_words, [&](Words instruction, std::size_t offset) {
        learn(instruction, offset);
        return true;
    });
    while (!waiting_.empty()) {
        const std::uint32_t id = waiting_.back();
        waiting_.pop_back();
        follow(id);
    }
    note_results();
}

void Facts::reach(std::uint32_t id) {
    if (!fact(id).is_reached) {
        fact(id).is_reached = true;
        waiting_.push_back(id);
    }
}

void Facts::learn(Words instruction, std::size_t offset) {
    switch (opcode_of(instruction)) {
    case OpEntryPoint:
        reach(instruction[2]);
        break;
    case OpDecorate:
        if (instruction[2] == decoration_spec_id)
            fact(instruction[1]).spec_id = instruction[3];
        break;
    case OpTypeBool:
        boolean_type_ = instruction[1];
        break;
    case OpConstantTrue:
    case OpConstantFalse:
        fact(instruction[2]).value = opcode_of(instruction) == OpConstantTrue ? 1 : 0;
        break;
    case OpConstant:
        if (instruction.size() == 4)
            fact(instruction[2]).value = instruction[3];
        break;
    case OpSpecConstantTrue:
    case OpSpecConstantFalse:
        fact(instruction[2]).value =
            given(instruction[2], opcode_of(instruction) == OpSpecConstantTrue ? 1 : 0) != 0 ? 1 : 0;
        break;
    case OpSpecConstant:
        if (instruction.size() != 4)
            throw Unknown();
        fact(instruction[2]).value = given(instruction[2], instruction[3]);
        break;
    case OpSpecConstantOp:
        fact(instruction[2]).value = folded(instruction);
        break;
    case OpFunction:
        fact(instruction[2]).place = static_cast<std::uint32_t>(offset);
        break;
    case OpLabel:
        fact(instruction[1]).place = static_cast<std::uint32_t>(offset);
        break;
    case OpSwitch:
        throw Unknown();
    default:
        break;
    }
}

std::uint32_t Facts::given(std::uint32_t id, std::uint32_t default_value) const {
    const std::optional<std::uint32_t> spec_id = of(id).spec_id;
    return spec_id && *spec_id < constants_.size() ? constants_[*spec_id] : default_value;
}

std::uint32_t Facts::folded(Words instruction) const {
    std::array<std::uint32_t, 3> operand{};
    if (instruction.size() < 5 || instruction.size() > 4 + operand.size())
        throw Unknown();
    for (std::size_t i = 4; i < instruction.size(); ++i)
        operand[i - 4] = value(instruction[i]);
    return result_of(instruction[3], operand);
}

// Goes from a function to its first block, or from a block to what it calls and where it branches. If the condition of
// an `if` is a constant, only the branch that is taken is followed. Branches that end a loop stay as they are.
void Facts::follow(std::uint32_t id) {
    const std::size_t place = fact(id).place;
    if (place == 0)
        throw Unknown();
    bool of_if = false;
    for_each_instruction(code_, place, [&](Words instruction, std::size_t offset) {
        switch (opcode_of(instruction)) {
        case OpLabel:
            if (offset != place) {
                reach(instruction[1]); // the first of the function
                return false;
            }
            return true;
        case OpFunctionCall:
            reach(instruction[3]);
            return true;
        case OpSelectionMerge:
            of_if = true;
            return true;
        case OpBranch:
            reach(instruction[1]);
            return false;
        case OpBranchConditional:
            if (const std::optional<std::uint32_t> condition = fact(instruction[1]).value; condition && of_if) {
                fact(id).taken = instruction[*condition != 0 ? 2 : 3];
                reach(fact(id).taken);
            } else {
                reach(instruction[2]);
                reach(instruction[3]);
            }
            return false;
        default:
            return !ends_block(opcode_of(instruction));
        }
    });
}

// Most instructions have their result in the second word after the first. Those without a result have an id there that
// is the result of another instruction that is kept, so noting it does no harm.
void Facts::note_results() {
    for_each_kept([&](Words instruction, std::uint32_t block) {
        const Opcode opcode = opcode_of(instruction);
        if (block != 0 && !fact(block).is_reached)
            return;
        if (opcode == OpLoopMerge && !fact(instruction[2]).is_reached)
            throw Unknown(); // the loop would lack its way back
        if ((opcode == OpSelectionMerge && fact(block).taken == 0) || opcode == OpLoopMerge)
            fact(instruction[1]).is_merge = true;
        const bool is_type = opcode >= OpTypeVoid && opcode <= OpTypeForwardPointer;
        const bool has_result = is_type || block != 0 || (opcode >= OpConstantTrue && opcode < OpDecorate);
        if (has_result && instruction.size() > 2 - (is_type ? 1U : 0U))
            if (const std::uint32_t id = instruction[is_type ? 1 : 2]; id < facts_.size())
                facts_[id].is_there = true;
    });
}

} // namespace pt::spirv
