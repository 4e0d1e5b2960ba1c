// The rules that a failed call found broken, as data. Made by rules.h and by whoever throws an Error about one field;
// kept by LastError for pt_get_broken_rule.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pt {

// The field that breaks a rule, what it holds and what it must be: the same members as in pt_broken_rule.
struct BrokenRule {
    std::string subject;
    std::int64_t index = -1;
    std::string member = {};
    std::int32_t component = -1;
    std::string with = {};
    std::string value;
    std::string rule;

    // "spheres[3].center[0] = nan: must be finite", "render.width * height = 0: ..."
    std::string text() const;
};

// The first rules in full, and the number of all of them: a scene of a million spheres may break millions.
class BrokenRules {
public:
    static constexpr std::size_t most_kept = 8;

    void add(BrokenRule rule);

    // Whether further rules are only counted: they need not be put into words.
    bool is_full() const { return first_.size() == most_kept; }
    void count_one() { ++count_; }

    const std::vector<BrokenRule> &first() const { return first_; }
    std::size_t count() const { return count_; }

    // A line for each rule that is kept, and the number of the others.
    std::string text() const;

private:
    std::vector<BrokenRule> first_;
    std::size_t count_ = 0;
};

} // namespace pt
