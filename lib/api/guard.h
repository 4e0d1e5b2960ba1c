// The end of exceptions: turns them into a pt_result, with a message for pt_last_error and the broken rules for
// pt_get_broken_rule.
#pragma once

#include "lib/base/error.h"

#include <cfenv>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace pt {

// Message of the last call that failed, and the rules that it is about.
class LastError {
public:
    // Never throws: if there is no memory for the message, a fixed one replaces it, without rules.
    void store(std::string_view message, std::shared_ptr<const Violations> broken_rules = nullptr) noexcept {
        try {
            text_.assign(message);
            shown_ = nullptr;
            broken_rules_ = std::move(broken_rules);
        } catch (...) {
            shown_ = "the call failed, and there was no memory left for the reason";
            broken_rules_.reset();
        }
    }

    const char *c_str() const noexcept { return shown_ ? shown_ : text_.c_str(); }

    // NULL if the message is about no rule.
    const Violations *broken_rules() const noexcept { return broken_rules_.get(); }

private:
    std::string text_;
    const char *shown_ = nullptr; // replaces text_ unless NULL
    std::shared_ptr<const Violations> broken_rules_;
};

// The pt_result of the exception that is being handled. Not inline: every call of the C interface ends in it.
[[gnu::noinline]] inline pt_result failure(LastError &last_error) noexcept {
    const auto failed = [&](pt_result code, std::string_view message) {
        last_error.store(message);
        return code;
    };
    try {
        throw;
    } catch (const Error &error) {
        last_error.store(error.what(), error.broken_rules());
        return error.code();
    } catch (const std::bad_alloc &) {
        return failed(PT_ERROR_OUT_OF_HOST_MEMORY, "out of host memory");
    } catch (const std::exception &error) {
        return failed(PT_ERROR_INTERNAL, error.what());
    } catch (...) {
        return failed(PT_ERROR_INTERNAL, "an exception of unknown type");
    }
}

// Sets the rounding mode that the library computes in, whatever the caller's is. While it lives, this thread rounds to
// nearest. Threads that are started meanwhile inherit that, such as those with which a driver builds and runs kernels.
class DefaultRounding {
public:
    DefaultRounding() noexcept : callers_(std::fegetround()) { set(FE_TONEAREST); }
    ~DefaultRounding() { set(callers_); }
    DefaultRounding(const DefaultRounding &) = delete;
    DefaultRounding &operator=(const DefaultRounding &) = delete;

private:
    // Reading the mode is cheap, setting it is not.
    void set(int mode) const noexcept {
        if (callers_ != FE_TONEAREST)
            std::fesetround(mode);
    }

    int callers_;
};

// Runs the body of a call of the C interface, which returns a pt_result or nothing (for PT_OK), or throws. An exception
// from a caller's callback ends here too, as PT_ERROR_INTERNAL with its message: it must not reach the caller, who may
// be written in C. Samples taken before it stay, as if the callback had asked to stop.
template <typename Call>
pt_result guard(LastError &last_error, Call &&call) noexcept {
    const DefaultRounding rounding;
    try {
        if constexpr (std::is_void_v<std::invoke_result_t<Call>>) {
            call();
            return PT_OK;
        } else {
            return call();
        }
    } catch (...) {
        return failure(last_error);
    }
}

} // namespace pt
