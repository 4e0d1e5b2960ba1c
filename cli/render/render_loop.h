// The loop of `pt render`: samples are taken in steps, between which observers look at what there is. However they are
// split, the image has the same bits.
#pragma once

#include "cli/base/context.h"
#include "cli/render/render_observer.h"
#include "cli/render/render_task.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace cli {

// The device idles for a moment between steps, and its work is cut best where it has samples to choose from. So a step
// has no fewer than the first one, and takes about so long.
inline constexpr std::uint32_t first_step_length = 16;
inline constexpr double step_seconds = 2.0;

// After a step of so many samples that took so long. The first one builds the kernel: it says too little, not too much.
inline std::uint32_t next_step_length(std::uint32_t length, double seconds) {
    constexpr double most = 1U << 30; // where the clock saw no time pass
    const double wanted = seconds > 0.0 ? std::floor(length * (step_seconds / seconds)) : most;
    return static_cast<std::uint32_t>(std::clamp(wanted, double{first_step_length}, most));
}

// From the samples that the context has on, until there are enough, the target error is reached or an observer stops
// it. The target error is looked at by the library, at counts that do not depend on the steps. Throws Failure.
void run_render_loop(const Context &context, const RenderTask &task, std::span<RenderObserver *const> observers);

} // namespace cli
