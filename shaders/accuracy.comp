#version 450
#extension GL_GOOGLE_include_directive : require

#include "gpu_layout.h"
#include "maths.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

// Functions are numbered as in elementary_functions() of lib/kernel/accuracy.cpp.
layout(push_constant) uniform Push { uint arguments_per_function; };
layout(set = 0, binding = 0) readonly buffer Arguments { float arguments[]; };
layout(set = 0, binding = 1) writeonly buffer Values { float values[]; };

float value_of(uint function, float x)
{
    float sine, cosine;
    switch (function) {
    case 0u:
        sin_cos_turn(x, sine, cosine);
        return sine;
    case 1u:
        sin_cos_turn(x, sine, cosine);
        return cosine;
    case 2u:
        return log2_one_minus(x);
    case 3u:
        return exp2_negative(x);
    case 4u:
        return one_minus_exp2(x);
    case 5u:
        return PI / x;
    case 6u:
        return sqrt(x);
    default:
        return inversesqrt(x);
    }
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    values[index] = value_of(index / arguments_per_function, arguments[index]);
}
