// Ends a rendering when a signal has come, or when nothing would become of its samples.
#pragma once

#include "cli/render/render_observer.h"

#include <functional>
#include <utility>

namespace cli {

// Says that no more samples are to be taken: a signal has come, or nothing would become of them. True for good then.
using Stop = std::function<bool()>;

class StopObserver : public RenderObserver {
public:
    explicit StopObserver(Stop stop) : stop_(std::move(stop)) {}

    bool stops() const override { return stop_(); }

private:
    Stop stop_;
};

} // namespace cli
