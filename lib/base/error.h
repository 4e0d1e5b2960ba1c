// The one exception of the library: a pt_result, its message, and the broken rules that the message is about. Thrown
// everywhere inside, caught by guard.h alone.
#pragma once

#include "lib/base/broken_rule.h"

#include <pt/pt.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace pt {

class Error : public std::runtime_error {
public:
    Error(pt_result code, const std::string &message);

    // The message is made of the rules.
    Error(pt_result code, BrokenRules rules);
    Error(pt_result code, BrokenRule rule);

    pt_result code() const { return code_; }

    // NULL if the error is about no rule. Shared, so that keeping them allocates nothing.
    const std::shared_ptr<const BrokenRules> &broken_rules() const { return broken_rules_; }

private:
    pt_result code_;
    std::shared_ptr<const BrokenRules> broken_rules_;
};

// What pt_result_name returns.
const char *result_name(pt_result result) noexcept;

} // namespace pt
