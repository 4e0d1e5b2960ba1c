// The scene as specialization constants (SCENE_IN_CONSTANTS), which CPU drivers fold into code.
#ifndef SCENE_CONSTANTS_GLSL
#define SCENE_CONSTANTS_GLSL

#include "specialization.h"

#define SCENE_FLOAT(word, component, name)                                                                             \
    layout(constant_id = CONSTANT_COUNT + 4u * uint(word) + component) const float scene_##word##name = 0.0;
#define SCENE_WORD(word)                                                                                               \
    SCENE_FLOAT(word, 0u, x) SCENE_FLOAT(word, 1u, y) SCENE_FLOAT(word, 2u, z) SCENE_FLOAT(word, 3u, w)
#define ALL_WORDS(first, next)                                                                                         \
    first(0) next(1) next(2) next(3) next(4) next(5) next(6) next(7)                                                   \
    next(8) next(9) next(10) next(11) next(12) next(13) next(14) next(15)                                              \
    next(16) next(17) next(18) next(19) next(20) next(21) next(22) next(23)                                            \
    next(24) next(25) next(26) next(27) next(28) next(29) next(30) next(31)                                            \
    next(32) next(33) next(34) next(35) next(36) next(37) next(38) next(39)                                            \
    next(40) next(41) next(42) next(43) next(44) next(45) next(46) next(47)                                            \
    next(48) next(49) next(50) next(51) next(52) next(53) next(54) next(55)                                            \
    next(56) next(57) next(58) next(59) next(60) next(61) next(62) next(63)
ALL_WORDS(SCENE_WORD, SCENE_WORD)

#define WORD(word) vec4(scene_##word##x, scene_##word##y, scene_##word##z, scene_##word##w)
#define NEXT_WORD(word) , WORD(word)
vec4 scene_constants[CONSTANT_SCENE_WORDS] = vec4[](ALL_WORDS(WORD, NEXT_WORD));
#undef NEXT_WORD
#undef WORD
#undef ALL_WORDS
#undef SCENE_WORD
#undef SCENE_FLOAT

#endif
