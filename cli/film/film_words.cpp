#include "cli/film/film_words.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace cli {
namespace {

// Facts that are digests, which tell people no more than that they differ.
constexpr std::array<std::string_view, 3> digests{"scene", "camera", "kernel"};

std::string words_of(const std::string &path, const BrokenRule &rule) {
    if (std::find(digests.begin(), digests.end(), rule.member) != digests.end())
        return path + ": was made with another " + rule.member + " (" + rule.value + ": " + rule.rule + ")";
    const std::string text = rule_text(path + ": " + rule.member, rule);
    return rule.member == "device" ? text + "; choose that model of device by --device, or on a CPU the width of its "
                                            "vectors by LP_NATIVE_VECTOR_WIDTH, or begin anew"
                                   : text;
}

// The library's own subject is not a name that the user gave.
std::string without_subject(const std::string &message) {
    constexpr std::string_view subject = "film: ";
    return message.starts_with(subject) ? message.substr(subject.size()) : message;
}

} // namespace

std::string film_words(const std::string &path, const LibraryError &error) {
    if (error.rules.empty())
        return path + ": " + without_subject(error.message);
    return error.in_words([&](const BrokenRule &rule) { return words_of(path, rule); });
}

} // namespace cli
