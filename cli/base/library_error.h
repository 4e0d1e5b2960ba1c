// The library's last error as the command line uses it: the broken rules come as data, and are put into the words of
// whoever gave the value.
#pragma once

#include <pt/pt.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cli {

// A struct of pt.h with its size, and else zeros.
template <typename Struct>
constexpr Struct sized() {
    Struct value{};
    value.struct_size = sizeof(Struct);
    return value;
}

// The members of pt_broken_rule, owned.
struct BrokenRule {
    std::string subject{};
    std::optional<std::size_t> index{};
    std::string member{};
    std::optional<std::size_t> component{};
    std::string with{};
    std::string value{};
    std::string rule{};
};

// What a rule says of a field, which is called as it is given: "--size: width * height = 0: must be >= 1".
std::string rule_text(const std::string &field, const BrokenRule &rule);

// What the library calls the field: "spheres[3].center[0]".
std::string field_text(const BrokenRule &rule);

// The option that gives the field: "--size: width"; nullptr if none does.
const char *find_option(const BrokenRule &rule);

struct LibraryError {
    std::string message;
    std::vector<BrokenRule> rules; // empty if the message is about no field
    std::uint64_t left_out = 0;    // rules more, which are not known in detail

    // A line for each rule in the words that it is given; the message if there are none.
    std::string in_words(const std::function<std::string(const BrokenRule &)> &words) const;
};

// With the option in the field's place: "--size: width = 0: must be >= 1". The library's name where no option gives it.
std::string in_words_of_options(const BrokenRule &rule);

// Of the context; of this thread's last call without one if it is NULL.
LibraryError last_error(const pt_context *context);

} // namespace cli
