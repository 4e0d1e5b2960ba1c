// Turns exceptions into a pt_result, a message and broken rules.
#pragma once

#include "lib/base/error.h"
#include "lib/platform/printable.h"

#include <cfenv>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace pt {

class LastError {
public:
    // Without memory, a fixed message without rules replaces the given one.
    void store(std::string_view message, std::shared_ptr<const Violations> broken_rules = nullptr) noexcept {
        try {
            const std::string shown = platform::printable_lines(message);
            text_ = std::string_view(shown); // copies, which keeps memory for later messages
            shown_ = nullptr;
            broken_rules_ = std::move(broken_rules);
        } catch (...) {
            shown_ = "the call failed, and there was no memory left for the reason";
            broken_rules_.reset();
        }
    }

    const char *c_str() const noexcept { return shown_ ? shown_ : text_.c_str(); }

    // NULL if the message concerns no rule.
    const Violations *broken_rules() const noexcept { return broken_rules_.get(); }

private:
    std::string text_;
    const char *shown_ = nullptr; // replaces text_ unless NULL
    std::shared_ptr<const Violations> broken_rules_;
};

// The pt_result of the current exception. Not inline, because every C call uses it.
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

// Rounds to nearest in this scope. Threads started meanwhile, such as a driver's, inherit it.
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

// Runs the body of a C call, which returns a pt_result or nothing (PT_OK), or throws. Callers may be written in C, so a
// callback's exception becomes PT_ERROR_INTERNAL with its message.
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
