#pragma once

#include "tests/faults/life.h"

#include <cstddef>
#include <functional>
#include <memory>

namespace faults {

using InjectionAt = std::function<std::unique_ptr<Injection>(std::size_t number)>;

// Makes one round for each place of a fault. Each round has the steps of the previous round. After a round, no Vulkan
// objects or memory may remain.
void sweep(const Setting &setting, const ExpectedImages &expected, const Steps &steps, const InjectionAt &injection_at);

} // namespace faults
