// Whether samples are under way, and whether somebody wants no more of them. The one part of a context that every
// thread may touch at any time. Owned by Renderer, looked at by Accumulation.
#pragma once

#include <atomic>

namespace pt {

class Cancellation {
public:
    void begin() noexcept { state_ = State::UnderWay; }
    void end() noexcept { state_ = State::Idle; }

    // False if nothing is under way.
    bool ask() noexcept {
        State state = State::UnderWay;
        return state_.compare_exchange_strong(state, State::Asked) || state == State::Asked;
    }

    bool is_asked() const noexcept { return state_ == State::Asked; }

private:
    enum class State { Idle, UnderWay, Asked };
    std::atomic<State> state_{State::Idle};
};

} // namespace pt
