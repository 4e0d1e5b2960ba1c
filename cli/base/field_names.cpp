#include "cli/base/field_names.h"

#include <algorithm>

namespace cli {

const FieldName *find_field_name(const BrokenRule &rule) {
    const auto found = std::find_if(field_names.begin(), field_names.end(), [&rule](const FieldName &name) {
        return rule.subject == name.subject && rule.member == name.member;
    });
    return found == field_names.end() ? nullptr : &*found;
}

std::string in_words_of_options(const BrokenRule &rule) {
    const FieldName *name = find_field_name(rule);
    const bool is_option = name != nullptr && !name->option.empty();
    return rule_text(is_option ? std::string(name->option) : field_text(rule), rule);
}

std::string in_words_of_options(const LibraryError &error) {
    return error.in_words([](const BrokenRule &rule) { return in_words_of_options(rule); });
}

} // namespace cli
