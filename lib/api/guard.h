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
    // If there is no memory for the message, stores a fixed message without rules.
    void store(std::string_view message, std::shared_ptr<const Violations> broken_rules = nullptr) noexcept {
        try {
            const std::string shown = platform::printable_lines(message);
            text_ = std::string_view(shown);
            shown_ = nullptr;
            broken_rules_ = std::move(broken_rules);
        } catch (...) {
            shown_ = "the call failed, and there was no memory left for the reason";
            broken_rules_.reset();
        }
    }

    const char *c_str() const noexcept { return shown_ ? shown_ : text_.c_str(); }

    const Violations *broken_rules() const noexcept { return broken_rules_.get(); }

private:
    std::string text_;
    const char *shown_ = nullptr; // NULL, or the message that replaces text_
    std::shared_ptr<const Violations> broken_rules_;
};

// Stores the current exception and returns its pt_result. Not inlined, because every C call uses it.
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

// Rounds to nearest in its scope. Threads that a driver starts in this scope inherit the mode.
class DefaultRounding {
public:
    DefaultRounding() noexcept : callers_(std::fegetround()) { set(FE_TONEAREST); }
    ~DefaultRounding() { set(callers_); }
    DefaultRounding(const DefaultRounding &) = delete;
    DefaultRounding &operator=(const DefaultRounding &) = delete;

private:
    // Reading the rounding mode is much cheaper than setting it.
    void set(int mode) const noexcept {
        if (callers_ != FE_TONEAREST)
            std::fesetround(mode);
    }

    int callers_;
};

// Runs the body of a C call, which returns a pt_result or void (PT_OK), or throws. Also catches exceptions of
// callbacks, because the caller may be written in C.
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
