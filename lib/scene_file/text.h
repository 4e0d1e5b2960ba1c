#pragma once

#include <sstream>
#include <string>

namespace pt {

template <typename... Parts>
std::string concat(const Parts &...parts) {
    std::ostringstream text;
    (text << ... << parts);
    return text.str();
}

template <typename Texts>
std::string listed(const Texts &texts, const char *between = ", ") {
    std::string list;
    for (const auto &text : texts)
        list.append(list.empty() ? "" : between).append(text);
    return list;
}

} // namespace pt
