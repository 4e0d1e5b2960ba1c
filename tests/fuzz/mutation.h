#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

// The target may define this function. It changes `size` bytes in memory of max_size bytes, and returns the new size.
__attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t *data, std::size_t size, std::size_t max_size,
                                                          unsigned int seed);

std::size_t LLVMFuzzerMutate(std::uint8_t *data, std::size_t size, std::size_t max_size);
}
