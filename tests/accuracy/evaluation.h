#pragma once

#include "tests/kernel/probe.h"

#include <span>
#include <vector>

namespace accuracy {

// The test fails if an output word stays unwritten. Negative control: a second run skips one item.
void evaluate_bytes(Probe &probe, std::span<const std::byte> inputs, std::span<std::byte> outputs,
                    std::uint32_t item_count);

template <typename Output, typename Input>
std::vector<Output> evaluate(Probe &probe, const std::vector<Input> &inputs) {
    static_assert(sizeof(Input) % sizeof(glm::vec4) == 0 && sizeof(Output) % sizeof(glm::vec4) == 0);
    std::vector<Output> outputs(inputs.size());
    evaluate_bytes(probe, std::as_bytes(std::span(inputs)), std::as_writable_bytes(std::span(outputs)),
                   static_cast<std::uint32_t>(inputs.size()));
    return outputs;
}

struct ItemRange {
    std::uint32_t count;
    std::uint32_t skipped;
};

} // namespace accuracy
