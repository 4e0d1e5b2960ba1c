// The words of a Tachyon scene: keywords in large or small letters, and vectors of a left-handed world.
#pragma once

#include "cli/import/scene_words.h"

#include <string>
#include <string_view>

namespace cli {

class TachyonWords : public SceneWords {
public:
    using SceneWords::SceneWords;

    // The next word, in large letters.
    std::string keyword(std::string_view what);

    // The next word must be that one, in large letters.
    void expect(std::string_view word);

    // Takes the next word if it is that one.
    bool take_if(std::string_view word);

    // With z of the other sign.
    ForeignVector mirrored(std::string_view what);
    ForeignVector mirrored_direction(std::string_view what);
};

std::string in_large_letters(std::string_view word);

} // namespace cli
