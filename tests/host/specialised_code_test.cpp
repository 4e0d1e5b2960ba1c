// What remains of SPIR-V once its specialization constants are known.
#include "lib/kernel/specialised_code.h"

#include "lib/kernel/scene_features.h"
#include "lib/kernel/shader_source.h"

#include <pt/pt.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <set>
#include <span>
#include <vector>

namespace {

using Code = std::vector<std::uint32_t>;

// Opcodes of SPIR-V.
constexpr std::uint32_t op_switch = 251;
constexpr std::uint32_t op_constant_true = 41;
constexpr std::uint32_t op_function = 54;
constexpr std::uint32_t op_function_call = 57;
constexpr std::uint32_t op_decorate = 71;
constexpr std::uint32_t op_phi = 245;
constexpr std::uint32_t op_selection_merge = 247;
constexpr std::uint32_t op_label = 248;
constexpr std::uint32_t op_branch = 249;
constexpr std::uint32_t op_branch_conditional = 250;
constexpr std::uint32_t op_return = 253;

void put(Code &code, std::uint32_t opcode, std::initializer_list<std::uint32_t> operands = {}) {
    code.push_back(static_cast<std::uint32_t>(operands.size() + 1) << 16U | opcode);
    code.insert(code.end(), operands);
}

std::vector<Code> instructions_of(const Code &code) {
    std::vector<Code> instructions;
    for (std::size_t i = 5; i < code.size(); i += code[i] >> 16U) {
        instructions.emplace_back(code.begin() + static_cast<std::ptrdiff_t>(i),
                                  code.begin() + static_cast<std::ptrdiff_t>(i + (code[i] >> 16U)));
        instructions.back()[0] &= 0xffffU;
    }
    return instructions;
}

bool has(const Code &code, const Code &instruction) {
    return std::ranges::count(instructions_of(code), instruction) > 0;
}

// if (constant 0, which is 7 by default, == 7) f(); else g(); f and g have a decorated sum each.
constexpr std::uint32_t f = 50;
constexpr std::uint32_t g = 51;

Code two_ways(std::uint32_t further_opcode = op_return) {
    Code code = {0x07230203, 0x10500, 0, 64, 0};
    put(code, 15, {5, 1, 0x6e69616d, 0}); // the entry point, "main"
    put(code, op_decorate, {2, 1, 0});    // SpecId
    put(code, op_decorate, {f + 2, 42});  // NoContraction
    put(code, op_decorate, {g + 2, 42});
    put(code, 19, {10});        // void
    put(code, 33, {11, 10});    // void()
    put(code, 20, {12});        // bool
    put(code, 21, {13, 32, 0}); // uint
    put(code, 50, {13, 2, 7});
    put(code, 43, {13, 3, 7});
    put(code, 52, {12, 4, 170, 2, 3}); // %2 == %3
    put(code, op_function, {10, 1, 0, 11});
    put(code, op_label, {20});
    put(code, op_selection_merge, {23, 0});
    put(code, op_branch_conditional, {4, 21, 22});
    put(code, op_label, {21});
    put(code, op_function_call, {10, 40, f});
    put(code, op_branch, {23});
    put(code, op_label, {22});
    put(code, op_function_call, {10, 41, g});
    put(code, op_branch, {23});
    put(code, op_label, {23});
    put(code, op_phi, {13, 24, 3, 21, 2, 22});
    put(code, further_opcode);
    put(code, 56);
    for (const std::uint32_t function : {f, g}) {
        put(code, op_function, {10, function, 0, 11});
        put(code, op_label, {function + 4});
        put(code, 128, {13, function + 2, 2, 3});
        put(code, op_return);
        put(code, 56);
    }
    return code;
}

TEST(SpecialisedCodeTest, GoesTheWayThatConstantsTake) {
    for (const bool first : {true, false}) {
        const Code constants = {first ? 7U : 8U};
        const Code code = pt::specialised_code(two_ways(), constants);
        const std::uint32_t kept = first ? f : g;
        const std::uint32_t gone = first ? g : f;
        EXPECT_TRUE(has(code, {op_branch, first ? 21U : 22U}));
        EXPECT_FALSE(has(code, {op_selection_merge, 23, 0}));
        EXPECT_TRUE(has(code, {op_function, 10, kept, 0, 11}));
        EXPECT_FALSE(has(code, {op_function, 10, gone, 0, 11}));
        EXPECT_TRUE(has(code, {op_decorate, kept + 2, 42})) << "what may not be contracted stays so";
        EXPECT_FALSE(has(code, {op_decorate, gone + 2, 42}));
        EXPECT_FALSE(has(code, {op_decorate, 2, 1, 0}));
        EXPECT_TRUE(has(code, first ? Code{op_phi, 13, 24, 3, 21} : Code{op_phi, 13, 24, 2, 22}));
        EXPECT_TRUE(has(code, {43, 13, 2, constants[0]})) << "a constant like others";
        EXPECT_TRUE(has(code, {first ? op_constant_true : op_constant_true + 1, 12, 4}));
    }
}

TEST(SpecialisedCodeTest, ConstantsHaveDefaults) {
    EXPECT_EQ(pt::specialised_code(two_ways(), {}), pt::specialised_code(two_ways(), Code{7}));
    EXPECT_NE(pt::specialised_code(two_ways(), {}), pt::specialised_code(two_ways(), Code{8}));
}

TEST(SpecialisedCodeTest, LeavesToTheDriverWhatItDoesNotKnow) {
    EXPECT_TRUE(pt::specialised_code(two_ways(op_switch), Code{7}).empty());
    Code code = two_ways();
    *std::ranges::find(code, 170U) = 9999; // an operation on constants
    EXPECT_TRUE(pt::specialised_code(code, Code{7}).empty());
    EXPECT_TRUE(pt::specialised_code(Code{}, Code{7}).empty());
    Code cut = two_ways();
    cut.pop_back();
    cut.back() += 5U << 16U; // longer than the rest
    EXPECT_TRUE(pt::specialised_code(cut, Code{7}).empty());
    Code endless = two_ways();
    endless[5] = 15; // an instruction of no words
    EXPECT_TRUE(pt::specialised_code(endless, Code{7}).empty());
}

// What is called, branched to and decorated has to be there.
void expect_whole(const Code &code) {
    std::set<std::uint32_t> there;
    for (const Code &instruction : instructions_of(code)) {
        there.insert(instruction[0] == op_label ? instruction.at(1) : 0);
        if (instruction.size() > 2)
            there.insert({instruction[1], instruction[2]});
    }
    std::set<std::uint32_t> functions;
    std::set<std::uint32_t> labels;
    for (const Code &instruction : instructions_of(code)) {
        if (instruction[0] == op_function)
            functions.insert(instruction[2]);
        if (instruction[0] == op_label)
            labels.insert(instruction[1]);
        EXPECT_FALSE(instruction[0] >= 48 && instruction[0] <= 52) << "a specialization constant is left";
    }
    const auto expect_in = [](const std::set<std::uint32_t> &ids, std::uint32_t id) {
        EXPECT_TRUE(ids.contains(id)) << id;
    };
    for (const Code &instruction : instructions_of(code)) {
        if (instruction[0] == op_function_call)
            expect_in(functions, instruction[3]);
        if (instruction[0] == op_branch || instruction[0] == op_selection_merge)
            expect_in(labels, instruction[1]);
        if (instruction[0] == op_branch_conditional)
            for (const std::size_t i : {2, 3})
                expect_in(labels, instruction[i]);
        if (instruction[0] == op_decorate)
            expect_in(there, instruction[1]);
    }
}

TEST(SpecialisedCodeTest, TheKernelIsAboutHalfForAnyScene) {
    const pt::KernelCode kernel = pt::embedded_code();
    for (const std::uint32_t lamps : {0U, 2U, 5U})
        for (const std::uint32_t length : {1U, 2U, 6U, 9U})
            for (const bool large : {false, true}) {
                pt::Features features{};
                features.sphere_count = 6;
                features.lamp_count = lamps;
                features.max_path_length = length;
                features.estimator = PT_ESTIMATOR_MIS;
                features.sampler = PT_SAMPLER_SOBOL;
                features.gloss = features.motion = features.inside = large;
                features.scene_in_uniform = !large;
                const auto constants = pt::specialization_constants(features);
                const Code code = pt::specialised_code(kernel.pathtrace, constants);
                ASSERT_FALSE(code.empty());
                EXPECT_LT(code.size(), kernel.pathtrace.size() * 9 / 10);
                expect_whole(code);
                EXPECT_EQ(pt::specialised_code(code, {}), code) << "nothing is left to do";
            }
}

} // namespace
