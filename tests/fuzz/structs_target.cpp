#include "tests/fuzz/examine.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    const std::span bytes(data, size);
    fuzz::examine_neighbourhood(fuzz::decoded_input(fuzz::ByteReader(bytes)), bytes);
    return 0;
}
