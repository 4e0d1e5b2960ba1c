// Owns the end of rendering by what happens outside of it.
// Called by the render loop.
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
