// libFuzzer's interface between a target and what runs it: libFuzzer itself, or replay.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

// Of the target. Returns 0.
int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

// Of the target, if it has one. Changes size bytes in room for max_size, and returns the new size.
__attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t *data, std::size_t size, std::size_t max_size,
                                                          unsigned int seed);

// Of what runs the target: the same with a change of its own.
std::size_t LLVMFuzzerMutate(std::uint8_t *data, std::size_t size, std::size_t max_size);
}
