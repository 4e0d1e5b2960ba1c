// Lets headers compile as C++ and as GLSL. The host computes shared formulas in double, kernels in float32.
#ifndef PT_DIALECTS_H
#define PT_DIALECTS_H

#include "gpu_layout.h"

#ifdef __cplusplus

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#define PT_CONSTANT inline constexpr
#define PT_FUNCTION inline
#define PT_OUT(type) type &
#define PT_UNROLL

namespace pt::gpu {

using real = double;
using uvec4 = glm::uvec4;
using std::log;
using std::max;
using std::min;
using std::sqrt;

inline constexpr float infinity = std::numeric_limits<float>::infinity();

// Arguments are passed by value, so that compilers vectorise loops. If an argument is NaN, returns `a`, as std::min
// does.
template <typename Type>
constexpr Type less_of(Type a, Type b) {
    return b < a ? b : a;
}

template <typename Type>
constexpr Type more_of(Type a, Type b) {
    return a < b ? b : a;
}

inline int findMSB(uint number) {
    return 31 - std::countl_zero(number);
}

inline uint uaddCarry(uint a, uint b, uint &carry) {
    carry = a + b < a ? 1 : 0;
    return a + b;
}

inline uint usubBorrow(uint a, uint b, uint &borrow) {
    borrow = a < b ? 1 : 0;
    return a - b;
}

inline void umulExtended(uint a, uint b, uint &high, uint &low) {
    const std::uint64_t product = std::uint64_t{a} * b;
    high = static_cast<uint>(product >> 32);
    low = static_cast<uint>(product);
}

inline real square_of_quotient(real dividend, real square_of_divisor) {
    return dividend * dividend / square_of_divisor;
}

} // namespace pt::gpu

#else

#extension GL_EXT_control_flow_attributes : require

#define PT_CONSTANT const
#define PT_FUNCTION
#define PT_OUT(type) out type
#define PT_UNROLL [[unroll]]
#define real float
#define less_of min
#define more_of max
#define infinity uintBitsToFloat(0x7f800000u)

// Divides before squaring, because the dividend's square may overflow.
float square_of_quotient(float dividend, float square_of_divisor)
{
    float quotient = dividend == 0.0 ? 0.0 : dividend * inversesqrt(square_of_divisor);
    return quotient * quotient;
}

#endif
#endif
