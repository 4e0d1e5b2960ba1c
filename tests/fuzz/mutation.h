// The interface between a target and its runner, which is libFuzzer or replay.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

// The target defines this function.
int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

// The target may define this function. It changes `size` bytes in memory of max_size bytes, and returns the new size.
__attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t *data, std::size_t size, std::size_t max_size,
                                                          unsigned int seed);

// The runner defines this function.
std::size_t LLVMFuzzerMutate(std::uint8_t *data, std::size_t size, std::size_t max_size);
}
