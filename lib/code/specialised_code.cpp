#include "lib/code/specialised_code.h"

#include "lib/base/spirv.h"

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <utility>

namespace pt {

namespace spirv {

namespace {

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

struct Fact {
    std::optional<std::uint32_t> value;
    std::optional<std::uint32_t> spec_id;
    std::uint32_t place = 0;
    std::uint32_t taken = 0; // target of the only branch that is followed, or 0
    bool is_reached = false;
    bool is_merge = false; // whether a kept instruction names it as merge block
    bool is_there = false;
};

// Evaluates constants, finds reachable blocks and functions, and writes them. Throws Unknown.
class Specialiser {
public:
    Specialiser(Words code, Words constants) : code_(code), constants_(constants), facts_(code[bound_word]) {
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
        for_each_kept([&](Words instruction, std::uint32_t block) { note_result(instruction, block); });
    }

    std::vector<std::uint32_t> write() {
        result_.reserve(code_.size());
        put(code_.first(header_words));
        for_each_kept([&](Words instruction, std::uint32_t block) {
            if (block != 0)
                write_in_function(instruction, block);
            else
                write_declaration(instruction);
        });
        return std::move(result_);
    }

private:
    Fact &fact(std::uint32_t id) {
        if (id >= facts_.size())
            throw Unknown();
        return facts_[id];
    }

    std::uint32_t value(std::uint32_t id) {
        if (!fact(id).value)
            throw Unknown();
        return *fact(id).value;
    }

    void reach(std::uint32_t id) {
        if (!std::exchange(fact(id).is_reached, true))
            waiting_.push_back(id);
    }

    void learn(Words instruction, std::size_t offset) {
        const Opcode opcode = opcode_of(instruction);
        switch (opcode) {
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
            fact(instruction[2]).value = opcode == OpConstantTrue ? 1 : 0;
            break;
        case OpConstant:
            if (instruction.size() == 4)
                fact(instruction[2]).value = instruction[3];
            break;
        case OpSpecConstantTrue:
        case OpSpecConstantFalse:
            fact(instruction[2]).value = given(instruction[2], opcode == OpSpecConstantTrue ? 1 : 0) != 0 ? 1 : 0;
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
        case OpLabel:
            fact(instruction[opcode == OpFunction ? 2 : 1]).place = static_cast<std::uint32_t>(offset);
            break;
        case OpSwitch:
            throw Unknown();
        default:
            break;
        }
    }

    std::uint32_t given(std::uint32_t id, std::uint32_t default_value) {
        const std::optional<std::uint32_t> spec_id = fact(id).spec_id;
        return spec_id && *spec_id < constants_.size() ? constants_[*spec_id] : default_value;
    }

    std::uint32_t folded(Words instruction) {
        std::array<std::uint32_t, 3> operand{};
        if (instruction.size() < 5 || instruction.size() > 4 + operand.size())
            throw Unknown();
        for (std::size_t i = 4; i < instruction.size(); ++i)
            operand[i - 4] = value(instruction[i]);
        return result_of(instruction[3], operand);
    }

    // Follows the first block of a function, or the calls and branches of a block. If the condition of a branch is
    // constant, follows only one side, except in branches that end a loop.
    void follow(std::uint32_t id) {
        const std::size_t place = fact(id).place;
        if (place == 0)
            throw Unknown();
        bool of_if = false;
        for_each_instruction(code_, place, [&](Words instruction, std::size_t offset) {
            switch (opcode_of(instruction)) {
            case OpLabel:
                if (offset != place)
                    reach(instruction[1]);
                return offset == place;
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

    // The block is 0 outside functions.
    template <typename Use>
    void for_each_kept(Use &&use) {
        bool keeps_function = true;
        std::uint32_t block = 0;
        for_each_instruction(code_, header_words, [&](Words instruction, std::size_t) {
            const Opcode opcode = opcode_of(instruction);
            if (opcode == OpFunction)
                keeps_function = fact(instruction[2]).is_reached;
            if (opcode == OpLabel)
                block = instruction[1];
            if (opcode == OpFunctionEnd)
                block = 0;
            if (keeps_function && (block == 0 || fact(block).is_reached || opcode == OpLabel))
                use(instruction, block);
            if (opcode == OpFunctionEnd)
                keeps_function = true;
            return true;
        });
    }

    // Most instructions have their result in word 2. The word 2 of other instructions is the result of another kept
    // instruction, which is harmless.
    void note_result(Words instruction, std::uint32_t block) {
        const Opcode opcode = opcode_of(instruction);
        if (block != 0 && !fact(block).is_reached)
            return;
        if (opcode == OpLoopMerge && !fact(instruction[2]).is_reached)
            throw Unknown(); // the loop would have no continue block
        if ((opcode == OpSelectionMerge && fact(block).taken == 0) || opcode == OpLoopMerge)
            fact(instruction[1]).is_merge = true;
        const bool is_type = opcode >= OpTypeVoid && opcode <= OpTypeForwardPointer;
        const bool has_result = is_type || block != 0 || (opcode >= OpConstantTrue && opcode < OpDecorate);
        if (has_result && instruction.size() > 2 - (is_type ? 1U : 0U))
            if (const std::uint32_t id = instruction[is_type ? 1 : 2]; id < facts_.size())
                facts_[id].is_there = true;
    }

    void put(std::initializer_list<std::uint32_t> words) { result_.insert(result_.end(), words); }
    void put(Words words) { result_.insert(result_.end(), words.begin(), words.end()); }

    void write_declaration(Words instruction) {
        switch (opcode_of(instruction)) {
        case OpName:
        case OpMemberName:
        case OpMemberDecorate:
            if (fact(instruction[1]).is_there)
                put(instruction);
            return;
        case OpDecorate:
            if (fact(instruction[1]).is_there && instruction[2] != decoration_spec_id)
                put(instruction);
            return;
        case OpSpecConstantTrue:
        case OpSpecConstantFalse:
        case OpSpecConstant:
        case OpSpecConstantOp:
            write_constant(instruction);
            return;
        case OpSpecConstantComposite:
            put({first_word(OpConstantComposite, static_cast<std::uint32_t>(instruction.size()))});
            put(instruction.subspan(1));
            return;
        default:
            put(instruction);
        }
    }

    void write_constant(Words constant) {
        const std::uint32_t known = value(constant[2]);
        if (constant[1] == boolean_type_)
            put({first_word(known != 0 ? OpConstantTrue : OpConstantFalse, 3), constant[1], constant[2]});
        else
            put({first_word(OpConstant, 4), constant[1], constant[2], known});
    }

    void write_in_function(Words instruction, std::uint32_t block) {
        const Opcode opcode = opcode_of(instruction);
        const Fact &of_block = fact(block);
        if (!of_block.is_reached) {
            if (of_block.is_merge) {
                put(instruction);
                put({first_word(OpUnreachable, 1)});
            }
        } else if (opcode == OpPhi) {
            write_phi(instruction, block);
        } else if (opcode == OpBranchConditional && of_block.taken != 0) {
            put({first_word(OpBranch, 2), of_block.taken});
        } else if (opcode != OpSelectionMerge || of_block.taken == 0) {
            put(instruction);
        }
    }

    // Drops values from blocks that do not branch to this one any more.
    void write_phi(Words phi, std::uint32_t block) {
        const std::size_t start = result_.size();
        put(phi.first(3));
        for (std::size_t i = 3; i + 1 < phi.size(); i += 2) {
            const Fact &parent = fact(phi[i + 1]);
            if (parent.is_reached && (parent.taken == 0 || parent.taken == block))
                put(phi.subspan(i, 2));
        }
        result_[start] = first_word(OpPhi, static_cast<std::uint32_t>(result_.size() - start));
    }

    Words code_;
    Words constants_;
    std::vector<Fact> facts_;
    std::vector<std::uint32_t> waiting_;
    std::uint32_t boolean_type_ = 0;
    std::vector<std::uint32_t> result_;
};

} // namespace

} // namespace spirv

std::vector<std::uint32_t> specialised_code(std::span<const std::uint32_t> spirv,
                                            std::span<const std::uint32_t> constants) {
    constexpr std::uint32_t most_ids = 1U << 22; // the limit that all implementations must support
    if (spirv.size() < spirv::header_words || spirv[spirv::bound_word] > most_ids)
        return {};
    try {
        return spirv::Specialiser(spirv, constants).write();
    } catch (const spirv::Unknown &) {
        return {};
    }
}

} // namespace pt
