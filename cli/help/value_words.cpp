#include "cli/help/value_words.h"

#include <algorithm>
#include <array>

namespace cli {
namespace {

struct FileKind {
    std::string_view name;
    std::vector<std::string_view> endings;
};

// Kinds of files by what stands for them. A kind that is not here is no file.
const std::vector<FileKind> &file_kinds() {
    static const std::vector<std::string_view> pictures{".png", ".jpg", ".jpeg"};
    static const std::vector<std::string_view> images{".exr", ".png", ".jpg", ".jpeg"};
    static const std::vector<FileKind> kinds{
        {"FILE", {}},        {"IMAGE", images}, {"REFERENCE", images}, {"OUT", pictures},     {"IN", {".exr"}},
        {"EXR", {".exr"}},   {"PNG", {".png"}}, {"FILM", {".ptfilm"}}, {"PART", {".ptfilm"}}, {"SCENE", {".json"}},
        {"JSON", {".json"}}, {"CSV", {".csv"}}, {"SVG", {".svg"}},     {"DATA", {}},
    };
    return kinds;
}

bool is_word(std::string_view text) {
    return std::none_of(text.begin(), text.end(), [](char letter) { return letter >= 'A' && letter <= 'Z'; });
}

void add_alternative(ValueWords &value, std::string_view text) {
    if (is_word(text)) {
        value.words.emplace_back(text);
        return;
    }
    const auto has_its_name = [&](const FileKind &kind) { return kind.name == text; };
    const auto kind = std::find_if(file_kinds().begin(), file_kinds().end(), has_its_name);
    if (kind != file_kinds().end()) {
        value.is_file = true;
        value.endings = kind->endings;
    }
    value.is_folder = value.is_folder || text == "DIR";
}

} // namespace

ValueWords value_words(std::string_view value) {
    ValueWords found;
    constexpr std::string_view list_ending = ",...";
    found.is_list = value.ends_with(list_ending);
    if (found.is_list) {
        value.remove_suffix(list_ending.size());
    }
    while (!value.empty()) {
        const std::size_t end = std::min(value.find('|'), value.size());
        add_alternative(found, value.substr(0, end));
        value.remove_prefix(std::min(end + 1, value.size()));
    }
    return found;
}

std::string alternatives(std::span<const std::string_view> names) {
    std::string text;
    for (const std::string_view name : names) {
        text.append(text.empty() ? "" : "|").append(name);
    }
    return text;
}

} // namespace cli
