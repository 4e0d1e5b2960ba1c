// What stands for the value of an option in its help, and what of it a shell can complete. Alternatives are parted by
// "|": those without capitals are words to be given as they are, the others say what kind of value is meant:
//   none|reinhard|aces    one of these words
//   EV|auto               a number, or the word
//   best|random,...       several of these words, parted by commas
//   IMAGE, SCENE, DIR     a file with one of the endings that this kind has, or a folder
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

struct ValueWords {
    std::vector<std::string> words;
    bool is_list = false;
    bool is_file = false;                  // any, if it has no endings
    std::vector<std::string_view> endings; // ".exr"
    bool is_folder = false;
};

ValueWords value_words(std::string_view value);

// "best|random|sobol", of these names.
std::string alternatives(std::span<const std::string_view> names);

} // namespace cli
