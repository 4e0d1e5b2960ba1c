#include "tests/fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    const std::span bytes(data, size);
    fuzz::examine(fuzz::decoded_input(fuzz::Numbers(std::as_bytes(bytes))), bytes);
    return 0;
}
