#include "cli/import/foreign_format.h"

#include "cli/import/nff_file.h"
#include "cli/import/tachyon_file.h"
#include "cli/import/tachyon_words.h"

#include <filesystem>

namespace cli {

std::optional<ForeignFormat> foreign_format(std::string_view text, const std::string &path) {
    SceneWords words(text, path);
    const std::string first(words.peek());
    if (first.starts_with('{') || first.starts_with('/')) { // of JSON and of its comments
        return std::nullopt;
    }
    words.next();
    if (in_large_letters(first) == "BEGIN_SCENE") {
        return ForeignFormat::tachyon;
    }
    if (first == "v" && words.peek() == "from") {
        return ForeignFormat::nff;
    }
    const std::string ending = in_large_letters(std::filesystem::path(path).extension().string());
    if (ending == ".NFF") {
        return ForeignFormat::nff;
    }
    return ending == ".DAT" || ending == ".TACHYON" ? std::optional(ForeignFormat::tachyon) : std::nullopt;
}

ForeignScene read_foreign_scene(ForeignFormat format, std::string_view text, const std::string &path) {
    return format == ForeignFormat::nff ? read_nff(text, path) : read_tachyon(text, path);
}

} // namespace cli
