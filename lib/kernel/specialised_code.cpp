// Folding and pruning of SPIR-V (Khronos, "SPIR-V Specification", version 1.5); see specialised_code.h. Few opcodes are
// enough: those of constants, and those of blocks and branches. Each id has its facts at one place of an array, so that
// a kernel of thousands of ids takes few allocations.
#include "lib/kernel/specialised_code.h"

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <utility>

namespace pt {

namespace {

// Section 3.32, "Instructions".
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

constexpr std::uint32_t decoration_spec_id = 1;
constexpr std::size_t header_words = 5;
constexpr std::size_t bound_word = 3;

using Words = std::span<const std::uint32_t>;

Opcode opcode_of(Words instruction) {
    return static_cast<Opcode>(instruction[0] & 0xffffU);
}

constexpr std::uint32_t first_word(Opcode opcode, std::uint32_t word_count) {
    return word_count << 16U | opcode;
}

// What the code has that is not known here.
struct Unknown {};

// Calls use(instruction, its offset) for each instruction from an offset on, until it returns false.
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

// Of an id, each as far as it is one of such.
struct Fact {
    std::optional<std::uint32_t> value; // of a constant of 32 bits, or a Boolean
    std::optional<std::uint32_t> spec_id;
    std::uint32_t place = 0; // offset of the block or function
    std::uint32_t taken = 0; // by the block, whose condition is a constant
    bool is_reached = false; // the block, by branches, or the function, by calls
    bool is_merge = false;   // of what is kept, some instruction names the block as one where branches meet again
    bool is_there = false;   // in what is kept
};

class Specialisation {
public:
    Specialisation(Words code, Words constants) : code_(code), constants_(constants), facts_(code[bound_word]) {
        waiting_.reserve(facts_.size());
    }

    std::vector<std::uint32_t> run() {
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
        write();
        return std::move(result_);
    }

private:
    Fact &fact(std::uint32_t id) {
        if (id >= facts_.size())
            throw Unknown();
        return facts_[id];
    }

    std::uint32_t value(std::uint32_t id) {
        if (const std::optional<std::uint32_t> value = fact(id).value)
            return *value;
        throw Unknown();
    }

    void reach(std::uint32_t id) {
        if (!fact(id).is_reached) {
            fact(id).is_reached = true;
            waiting_.push_back(id);
        }
    }

    void learn(Words instruction, std::size_t offset) {
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
        const auto [a, b, c] = operand;
        switch (instruction[3]) {
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
            return instruction[3] == OpUDiv ? a / b : a % b;
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

    // Goes from a function to its first block, or from a block to what it calls and where it branches. A branch on a
    // condition that is a constant goes one way, if it is that of an `if`: one that ends a loop stays as it is.
    void follow(std::uint32_t id) {
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

    static bool ends_block(Opcode opcode) { return opcode >= OpBranch && opcode <= OpUnreachable; }

    // Calls use(instruction) for all that is kept, in functions with the block that it is in, else with 0.
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

    // By the second word after the first, where most instructions have their results; those without have an id there that
    // is the result of another that is kept.
    void note_results() {
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

    void put(std::initializer_list<std::uint32_t> words) { result_.insert(result_.end(), words); }
    void put(Words words) { result_.insert(result_.end(), words.begin(), words.end()); }

    void write() {
        result_.reserve(code_.size());
        put(code_.first(header_words));
        for_each_kept([&](Words instruction, std::uint32_t block) {
            if (block != 0)
                write_in_function(instruction, block);
            else
                write_declaration(instruction);
        });
    }

    void write_declaration(Words instruction) {
        const Opcode opcode = opcode_of(instruction);
        switch (opcode) {
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
            put_boolean(instruction);
            return;
        case OpSpecConstant:
            put_number(instruction);
            return;
        case OpSpecConstantComposite:
            put({first_word(OpConstantComposite, static_cast<std::uint32_t>(instruction.size()))});
            put(instruction.subspan(1));
            return;
        case OpSpecConstantOp:
            if (instruction[1] == boolean_type_)
                put_boolean(instruction);
            else
                put_number(instruction);
            return;
        default:
            put(instruction);
        }
    }

    void put_boolean(Words constant) {
        const Opcode opcode = value(constant[2]) != 0 ? OpConstantTrue : OpConstantFalse;
        put({first_word(opcode, 3), constant[1], constant[2]});
    }

    void put_number(Words constant) { put({first_word(OpConstant, 4), constant[1], constant[2], value(constant[2])}); }

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

    // Without the values of blocks from which no branch comes any more.
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
    std::vector<Fact> facts_;            // by id
    std::vector<std::uint32_t> waiting_; // functions and blocks that are reached, but not yet followed
    std::vector<std::uint32_t> result_;
    std::uint32_t boolean_type_ = 0;
};

} // namespace

std::vector<std::uint32_t> specialised_code(std::span<const std::uint32_t> spirv,
                                            std::span<const std::uint32_t> constants) {
    constexpr std::uint32_t most_ids = 1U << 22; // that the specification asks implementations to take
    if (spirv.size() < header_words || spirv[bound_word] > most_ids)
        return {};
    try {
        return Specialisation(spirv, constants).run();
    } catch (const Unknown &) {
        return {};
    }
}

} // namespace pt
