// Lives in which a fault happens at the first possible place, then at the second, and so on until there is none.
#pragma once

#include "tests/faults/life.h"

#include <cstddef>
#include <functional>
#include <memory>

namespace faults {

// What is to happen at the place with a number in each call, counted from 1.
using InjectionAt = std::function<std::unique_ptr<Injection>(std::size_t number)>;

// Lives one round for each number: in a round something happens to each of the steps where it did in the round
// before. After each life all Vulkan objects are gone, and all memory.
void sweep(const Setting &setting, const ExpectedImages &expected, const Steps &steps, const InjectionAt &injection_at);

} // namespace faults
