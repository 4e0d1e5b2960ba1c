// What the values of specialization constants tell of a module's ids: values of other constants, and which blocks and
// functions are reached. Few opcodes are enough: those of constants, and those of blocks and branches. Each id has its
// facts at one place of an array, so that a kernel of thousands of ids takes few allocations.
#pragma once

#include "lib/base/spirv.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pt::spirv {

// What is known of an id; each member only for ids of its kind.
struct Fact {
    std::optional<std::uint32_t> value; // of a constant of 32 bits, or a Boolean
    std::optional<std::uint32_t> spec_id;
    std::uint32_t place = 0; // offset of the block or function
    std::uint32_t taken = 0; // by the block, whose condition is a constant
    bool is_reached = false; // the block, by branches, or the function, by calls
    bool is_merge = false;   // of what is kept, some instruction names the block as one where branches meet again
    bool is_there = false;   // in what is kept
};

class Facts {
public:
    // constants[i] has the bits of the specialization constant with id i. Throws Unknown.
    Facts(Words code, Words constants);

    const Fact &of(std::uint32_t id) const { return facts_[place_of(id)]; }

    // The value of a constant.
    std::uint32_t value(std::uint32_t id) const {
        if (const std::optional<std::uint32_t> value = of(id).value)
            return *value;
        throw Unknown();
    }

    bool is_boolean(std::uint32_t type) const { return type == boolean_type_; }

    // Calls use(instruction) for every instruction that is kept, with its block inside functions, and with 0 outside.
    template <typename Use>
    void for_each_kept(Use &&use) const {
        bool keeps_function = true;
        std::uint32_t block = 0;
        for_each_instruction(code_, header_words, [&](Words instruction, std::size_t) {
            const Opcode opcode = opcode_of(instruction);
            if (opcode == OpFunction)
                keeps_function = of(instruction[2]).is_reached;
            if (opcode == OpLabel)
                block = instruction[1];
            if (opcode == OpFunctionEnd)
                block = 0;
            if (keeps_function && (block == 0 || of(block).is_reached || opcode == OpLabel))
                use(instruction, block);
            if (opcode == OpFunctionEnd)
                keeps_function = true;
            return true;
        });
    }

private:
    std::size_t place_of(std::uint32_t id) const {
        if (id >= facts_.size())
            throw Unknown();
        return id;
    }

    Fact &fact(std::uint32_t id) { return facts_[place_of(id)]; }

    void reach(std::uint32_t id);
    void learn(Words instruction, std::size_t offset);
    std::uint32_t given(std::uint32_t id, std::uint32_t default_value) const;
    std::uint32_t folded(Words instruction) const;
    void follow(std::uint32_t id);
    void note_results();

    Words code_;
    Words constants_;
    std::vector<Fact> facts_;            // by id
    std::vector<std::uint32_t> waiting_; // functions and blocks that are reached, but not yet followed
    std::uint32_t boolean_type_ = 0;
};

} // namespace pt::spirv
