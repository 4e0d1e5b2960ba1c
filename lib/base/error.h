// The library's own exception. Only guard.h catches it.
#pragma once

#include <pt/pt.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pt {

struct BrokenRule {
    std::string subject = {};
    std::int64_t index = -1;
    std::string member = {};
    std::int32_t component = -1;
    std::string with = {};
    std::string value = {};
    std::string rule = {};

    // "spheres[3].center[0]"
    std::string field() const;

    // "spheres[3].center[0] = nan: must be finite"
    std::string text() const { return text(field()); }
    std::string text(const std::string &name_of_field) const;
};

// The rules that one call broke. Only the first ones are kept, because there may be millions. All are counted.
class Violations {
public:
    static constexpr std::size_t most_kept = 8;

    void add(BrokenRule rule);

    bool only_count() const { return first_.size() == most_kept; }
    void count_one() { ++count_; }

    const std::vector<BrokenRule> &first() const { return first_; }
    std::size_t count() const { return count_; }

    // Returns a line for each kept rule, and the number of the others.
    std::string text() const;

    void throw_if_any(pt_result code) const;

private:
    std::vector<BrokenRule> first_;
    std::size_t count_ = 0;
};

class Error : public std::runtime_error {
public:
    Error(pt_result code, const std::string &message);

    Error(pt_result code, Violations rules);
    Error(pt_result code, BrokenRule rule);

    pt_result code() const { return code_; }

    // NULL if the error concerns no rule. Shared, because copies of an exception must not allocate.
    const std::shared_ptr<const Violations> &broken_rules() const { return broken_rules_; }

private:
    pt_result code_;
    std::shared_ptr<const Violations> broken_rules_;
};

[[noreturn]] void refuse_argument(std::string_view subject, std::string_view member, std::string_view value,
                                  std::string_view rule, pt_result code = PT_ERROR_INVALID_ARGUMENT);

const char *result_name(pt_result result) noexcept;

} // namespace pt
