#pragma once

#include "cli/scene/scene.h"
#include "tests/analytic/judge.h"

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace analytic {

struct Pixel {
    std::uint32_t x;
    std::uint32_t y; // rows count from the top
    Exact exact;
};

struct Expectation {
    std::string scene;
    std::vector<Pixel> pixels;
};

inline void PrintTo(const Expectation &expectation, std::ostream *stream) {
    *stream << expectation.scene;
}

std::vector<Expectation> read_expectations();

cli::SceneFile read_scene(const std::string &name);

void brighten(cli::SceneFile &scene, float factor);

} // namespace analytic
