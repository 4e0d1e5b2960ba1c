// Writes what is kept of a kernel; see specialised_code.h.
#include "lib/kernel/specialised_code.h"

#include "lib/kernel/spirv_facts.h"

#include <cstddef>
#include <initializer_list>
#include <utility>

namespace pt {

namespace spirv {

namespace {

class SpecialisedCode {
public:
    SpecialisedCode(Words code, Words constants) : code_(code), facts_(code, constants) {}

    std::vector<std::uint32_t> write() {
        result_.reserve(code_.size());
        put(code_.first(header_words));
        facts_.for_each_kept([&](Words instruction, std::uint32_t block) {
            if (block != 0)
                write_in_function(instruction, block);
            else
                write_declaration(instruction);
        });
        return std::move(result_);
    }

private:
    void put(std::initializer_list<std::uint32_t> words) { result_.insert(result_.end(), words); }
    void put(Words words) { result_.insert(result_.end(), words.begin(), words.end()); }

    void write_declaration(Words instruction) {
        const Opcode opcode = opcode_of(instruction);
        switch (opcode) {
        case OpName:
        case OpMemberName:
        case OpMemberDecorate:
            if (facts_.of(instruction[1]).is_there)
                put(instruction);
            return;
        case OpDecorate:
            if (facts_.of(instruction[1]).is_there && instruction[2] != decoration_spec_id)
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
            if (facts_.is_boolean(instruction[1]))
                put_boolean(instruction);
            else
                put_number(instruction);
            return;
        default:
            put(instruction);
        }
    }

    void put_boolean(Words constant) {
        const Opcode opcode = facts_.value(constant[2]) != 0 ? OpConstantTrue : OpConstantFalse;
        put({first_word(opcode, 3), constant[1], constant[2]});
    }

    void put_number(Words constant) {
        put({first_word(OpConstant, 4), constant[1], constant[2], facts_.value(constant[2])});
    }

    void write_in_function(Words instruction, std::uint32_t block) {
        const Opcode opcode = opcode_of(instruction);
        const Fact &of_block = facts_.of(block);
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
            const Fact &parent = facts_.of(phi[i + 1]);
            if (parent.is_reached && (parent.taken == 0 || parent.taken == block))
                put(phi.subspan(i, 2));
        }
        result_[start] = first_word(OpPhi, static_cast<std::uint32_t>(result_.size() - start));
    }

    Words code_;
    Facts facts_;
    std::vector<std::uint32_t> result_;
};

} // namespace

} // namespace spirv

std::vector<std::uint32_t> specialised_code(std::span<const std::uint32_t> spirv,
                                            std::span<const std::uint32_t> constants) {
    constexpr std::uint32_t most_ids = 1U << 22; // that the specification asks implementations to take
    if (spirv.size() < spirv::header_words || spirv[spirv::bound_word] > most_ids)
        return {};
    try {
        return spirv::SpecialisedCode(spirv, constants).write();
    } catch (const spirv::Unknown &) {
        return {};
    }
}

} // namespace pt
