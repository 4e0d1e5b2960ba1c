// The interface between a target and its runner, which is libFuzzer or replay.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

// Defined by the target. Returns 0.
int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

// May be defined by the target. Changes `size` bytes in memory of max_size bytes, and returns the new size.
__attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t *data, std::size_t size, std::size_t max_size,
                                                          unsigned int seed);

// Defined by the runner.
std::size_t LLVMFuzzerMutate(std::uint8_t *data, std::size_t size, std::size_t max_size);
}
