// libFuzzer's interface between a target and its runner: libFuzzer or replay.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

// The target's. Returns 0.
int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

// The target's, optional. Changes `size` bytes in room for max_size; returns the new size.
__attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t *data, std::size_t size, std::size_t max_size,
                                                          unsigned int seed);

// The runner's own change.
std::size_t LLVMFuzzerMutate(std::uint8_t *data, std::size_t size, std::size_t max_size);
}
