#include "cli/import/tachyon_words.h"

#include "cli/data/text_number.h"

#include <algorithm>

namespace cli {

std::string in_large_letters(std::string_view word) {
    std::string large(word);
    std::transform(large.begin(), large.end(), large.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    return large;
}

std::string TachyonWords::keyword(std::string_view what) {
    return in_large_letters(require(what));
}

void TachyonWords::expect(std::string_view word) {
    const std::string_view found = require(word);
    if (in_large_letters(found) != word) {
        refuse(quoted_text(found).append(" must be ").append(word));
    }
}

bool TachyonWords::take_if(std::string_view word) {
    const bool found = in_large_letters(peek()) == word;
    if (found) {
        next();
    }
    return found;
}

ForeignVector TachyonWords::mirrored(std::string_view what) {
    const ForeignVector found = vector(what);
    return {found[0], found[1], -found[2]};
}

ForeignVector TachyonWords::mirrored_direction(std::string_view what) {
    const ForeignVector found = direction(what);
    return {found[0], found[1], -found[2]};
}

} // namespace cli
