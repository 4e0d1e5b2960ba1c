# cmake -DSPIRV=in -DHEADER=out -DSYMBOL=name -P SpirvToHeader.cmake: writes a SPIR-V file's words as a C++ array.
file(READ ${SPIRV} bytes HEX)
# Words are little-endian; eight to a line.
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
string(REGEX REPLACE "(0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,0x[0-9a-f]+,)"
                     "\\1\n" words "${words}"
)
file(WRITE ${HEADER} "#pragma once\n#include <cstdint>\nconstexpr std::uint32_t ${SYMBOL}[] = {\n${words}\n};\n")
