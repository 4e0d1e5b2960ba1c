// The one exception of the library: a pt_result and its message. Thrown everywhere inside, caught by guard.h alone.
#pragma once

#include <pt/pt.h>

#include <stdexcept>
#include <string>

namespace pt {

class Error : public std::runtime_error {
public:
    Error(pt_result code, const std::string &message);

    pt_result code() const { return code_; }

private:
    pt_result code_;
};

// What pt_result_name returns.
const char *result_name(pt_result result) noexcept;

} // namespace pt
