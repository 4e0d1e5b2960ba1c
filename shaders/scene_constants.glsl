// The scene as specialization constants, for SCENE_IN_CONSTANTS. A driver that compiles for a CPU folds them into the
// code, which makes the kernel half as fast again as one that reads a buffer.
#ifndef SCENE_CONSTANTS_GLSL
#define SCENE_CONSTANTS_GLSL

#include "specialization.h"

// Specialization constants are scalars, each with its own name and number, so macros have to write out every one.
#define SCENE_FLOAT(word, component, name)                                                                             \
    layout(constant_id = CONSTANT_COUNT + 4u * uint(word) + component) const float scene_##word##name = 0.0;
#define SCENE_WORD(word)                                                                                               \
    SCENE_FLOAT(word, 0u, x) SCENE_FLOAT(word, 1u, y) SCENE_FLOAT(word, 2u, z) SCENE_FLOAT(word, 3u, w)
SCENE_WORD(0) SCENE_WORD(1) SCENE_WORD(2) SCENE_WORD(3)
SCENE_WORD(4) SCENE_WORD(5) SCENE_WORD(6) SCENE_WORD(7)
SCENE_WORD(8) SCENE_WORD(9) SCENE_WORD(10) SCENE_WORD(11)
SCENE_WORD(12) SCENE_WORD(13) SCENE_WORD(14) SCENE_WORD(15)
SCENE_WORD(16) SCENE_WORD(17) SCENE_WORD(18) SCENE_WORD(19)
SCENE_WORD(20) SCENE_WORD(21) SCENE_WORD(22) SCENE_WORD(23)
SCENE_WORD(24) SCENE_WORD(25) SCENE_WORD(26) SCENE_WORD(27)
SCENE_WORD(28) SCENE_WORD(29) SCENE_WORD(30) SCENE_WORD(31)
SCENE_WORD(32) SCENE_WORD(33) SCENE_WORD(34) SCENE_WORD(35)
SCENE_WORD(36) SCENE_WORD(37) SCENE_WORD(38) SCENE_WORD(39)
SCENE_WORD(40) SCENE_WORD(41) SCENE_WORD(42) SCENE_WORD(43)
SCENE_WORD(44) SCENE_WORD(45) SCENE_WORD(46) SCENE_WORD(47)
SCENE_WORD(48) SCENE_WORD(49) SCENE_WORD(50) SCENE_WORD(51)
SCENE_WORD(52) SCENE_WORD(53) SCENE_WORD(54) SCENE_WORD(55)
SCENE_WORD(56) SCENE_WORD(57) SCENE_WORD(58) SCENE_WORD(59)
SCENE_WORD(60) SCENE_WORD(61) SCENE_WORD(62) SCENE_WORD(63)

#define WORD(word) vec4(scene_##word##x, scene_##word##y, scene_##word##z, scene_##word##w)
vec4 scene_constants[CONSTANT_SCENE_WORDS] = vec4[](
    WORD(0), WORD(1), WORD(2), WORD(3), WORD(4), WORD(5), WORD(6), WORD(7),
    WORD(8), WORD(9), WORD(10), WORD(11), WORD(12), WORD(13), WORD(14), WORD(15),
    WORD(16), WORD(17), WORD(18), WORD(19), WORD(20), WORD(21), WORD(22), WORD(23),
    WORD(24), WORD(25), WORD(26), WORD(27), WORD(28), WORD(29), WORD(30), WORD(31),
    WORD(32), WORD(33), WORD(34), WORD(35), WORD(36), WORD(37), WORD(38), WORD(39),
    WORD(40), WORD(41), WORD(42), WORD(43), WORD(44), WORD(45), WORD(46), WORD(47),
    WORD(48), WORD(49), WORD(50), WORD(51), WORD(52), WORD(53), WORD(54), WORD(55),
    WORD(56), WORD(57), WORD(58), WORD(59), WORD(60), WORD(61), WORD(62), WORD(63));
#undef WORD
#undef SCENE_WORD
#undef SCENE_FLOAT

#endif
