# cmake -DSPIRV=in -DHEADER=out -DSYMBOL=name -P SpirvToHeader.cmake: writes a SPIR-V file as a function that returns its
# words. They stand in four tenths of their size, as lib/base/packed_words.h says.
file(READ ${SPIRV} bytes HEX)
string(LENGTH "${bytes}" count)
math(EXPR count "${count} / 8")
string(REGEX REPLACE "(..)(..)(..)(..)" ",\\4\\3\\2\\1" words "${bytes}") # little-endian

# The first words of OpLoad, OpStore, OpVariable, OpLabel, OpAccessChain, OpBranch and OpFunctionParameter, a seventh of all.
set(frequent 0004003d 0003003e 0004003b 000200f8 00050041 000200f9 00030037)
set(tags 9 a b c d e f)
foreach(word tag IN ZIP_LISTS frequent tags)
  string(REPLACE ",${word}" ${tag} words "${words}")
endforeach()
foreach(digits RANGE 8)
  math(EXPR zeros "8 - ${digits}")
  string(REPEAT 0 ${zeros} zeros)
  string(REPEAT . ${digits} kept)
  string(REGEX REPLACE ",${zeros}(${kept})" "${digits}\\1" words "${words}")
endforeach()

string(REGEX REPLACE "(.)(.?)" "0x\\2\\1," words "${words}")
string(REPEAT "....." 24 line)
string(REGEX REPLACE "(${line})" "\\1\n" words "${words}")
list(TRANSFORM frequent PREPEND 0x)
list(JOIN frequent ", " frequent)
file(WRITE ${HEADER} "#pragma once
#include \"lib/base/packed_words.h\"
inline std::vector<std::uint32_t> ${SYMBOL}() {
    static constexpr std::uint8_t packed[] = {
${words}
    };
    return pt::unpacked_words(${count}, packed, {${frequent}});
}
")
