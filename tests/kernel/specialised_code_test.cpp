#include "lib/code/specialised_code.h"

#include "lib/code/shader_source.h"
#include "lib/view/scene_features.h"

#include <pt/pt.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

namespace {

using Code = std::vector<std::uint32_t>;

constexpr std::uint32_t last_about_others = 16; // the last opcode of names, entry points and modes
constexpr std::uint32_t op_spec_constant_op = 52;
constexpr std::uint32_t op_decorate = 71;
constexpr std::uint32_t op_switch = 251;
constexpr std::uint32_t op_return = 253;
constexpr std::uint32_t no_contraction = 42;

std::vector<Code> instructions_of(const Code &code) {
    std::vector<Code> instructions;
    for (std::size_t i = 5; i < code.size(); i += code[i] >> 16U) {
        instructions.emplace_back(code.begin() + static_cast<std::ptrdiff_t>(i),
                                  code.begin() + static_cast<std::ptrdiff_t>(i + (code[i] >> 16U)));
        instructions.back()[0] &= 0xffffU;
    }
    return instructions;
}

std::uint32_t &first_of(Code &code, std::uint32_t opcode) {
    std::size_t i = 5;
    while ((code[i] & 0xffffU) != opcode)
        i += code[i] >> 16U;
    return code[i];
}

TEST(SpecialisedCodeTest, LeavesToTheDriverWhatItDoesNotKnow) {
    const Code kernel(pt::embedded_code().pathtrace.begin(), pt::embedded_code().pathtrace.end());
    EXPECT_FALSE(pt::specialised_code(kernel, {}).empty()) << "constants have defaults";
    const auto is_left = [&](void (*change)(Code &)) {
        Code changed = kernel;
        change(changed);
        return pt::specialised_code(changed, {}).empty();
    };
    EXPECT_TRUE(is_left([](Code &code) { first_of(code, op_return) = 1U << 16U | op_switch; }));
    EXPECT_TRUE(is_left([](Code &code) { (&first_of(code, op_spec_constant_op))[3] = 9999; }));
    EXPECT_TRUE(is_left([](Code &code) { code.clear(); }));
    EXPECT_TRUE(is_left([](Code &code) { code.back() += 5U << 16U; })) << "longer than the rest";
    EXPECT_TRUE(is_left([](Code &code) { code[5] &= 0xffffU; })) << "an instruction of no words";
}

// The validation layer checks the rest of the code.
void expect_no_contraction(const Code &code, const Code &kernel) {
    const std::vector<Code> instructions = instructions_of(code);
    const std::set<Code> all(instructions.begin(), instructions.end());
    std::set<std::uint32_t> there;
    for (const Code &instruction : instructions) {
        EXPECT_FALSE(instruction[0] >= 48 && instruction[0] <= 52) << "a specialization constant is left";
        if (instruction[0] > last_about_others && instruction[0] != op_decorate && instruction.size() > 2)
            there.insert(instruction[2]);
    }
    int kept = 0;
    for (const Code &instruction : instructions_of(kernel))
        if (instruction[0] == op_decorate && instruction[2] == no_contraction && there.contains(instruction[1])) {
            EXPECT_TRUE(all.contains(instruction)) << instruction[1];
            ++kept;
        }
    EXPECT_GT(kept, 0);
}

TEST(SpecialisedCodeTest, TheKernelIsAboutHalfForAnyScene) {
    const Code kernel(pt::embedded_code().pathtrace.begin(), pt::embedded_code().pathtrace.end());
    for (const std::uint32_t lamps : {0U, 2U, 5U})
        for (const std::uint32_t length : {1U, 2U, 6U, 9U})
            for (const bool large : {false, true}) {
                pt::Features features{};
                features[pt::gpu::ID_SPHERE_COUNT] = 6;
                features[pt::gpu::ID_LAMP_COUNT] = lamps;
                features[pt::gpu::ID_MAX_PATH_LENGTH] = length;
                features[pt::gpu::ID_ESTIMATOR] = PT_ESTIMATOR_MIS;
                features[pt::gpu::ID_SAMPLER] = PT_SAMPLER_SOBOL;
                features[pt::gpu::ID_GLOSS] = features[pt::gpu::ID_MOTION] = features[pt::gpu::ID_INSIDE] = large;
                features[pt::gpu::ID_SCENE_SOURCE] = large ? pt::gpu::SCENE_IN_STORAGE : pt::gpu::SCENE_IN_UNIFORM;
                const auto constants = pt::specialization_constants(features);
                const Code code = pt::specialised_code(kernel, constants);
                ASSERT_FALSE(code.empty());
                EXPECT_LT(code.size(), kernel.size() * 9 / 10);
                expect_no_contraction(code, kernel);
                EXPECT_EQ(pt::specialised_code(code, {}), code) << "nothing is left to do";
            }
}

} // namespace
