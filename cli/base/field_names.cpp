// What fields of pt.h are called where users give them; see field_names.h.
#include "cli/base/field_names.h"

#include <algorithm>

namespace cli {

const FieldName *find_field_name(std::string_view line) {
    const auto speaks_of = [line](const FieldName &name) {
        const std::string_view rest = line.substr(std::min(name.field.size(), line.size()));
        return line.starts_with(name.field) && (rest.empty() || rest.front() == ' ' || rest.front() == '[');
    };
    const auto found = std::find_if(field_names.begin(), field_names.end(), speaks_of);
    return found == field_names.end() ? nullptr : &*found;
}

std::string in_words_of_options(std::string_view line) {
    const FieldName *name = find_field_name(line);
    if (name == nullptr || name->option.empty()) {
        return std::string(line);
    }
    return std::string(name->option).append(line.substr(name->field.size()));
}

} // namespace cli
