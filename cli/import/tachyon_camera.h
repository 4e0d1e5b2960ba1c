// The section CAMERA of a Tachyon scene.
#pragma once

#include "cli/import/tachyon_words.h"

#include <string>
#include <vector>

namespace cli {

struct TachyonCamera {
    ForeignCamera camera; // without look_at
    ForeignVector view{}; // its direction
};

// What follows the word CAMERA. aspect: width / height of the picture. Throws Failure.
TachyonCamera read_tachyon_camera(TachyonWords &words, double aspect, std::vector<std::string> &left_out);

} // namespace cli
