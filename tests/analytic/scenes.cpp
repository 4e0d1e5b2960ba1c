#include "tests/analytic/scenes.h"

#include "cli/scene/scene.h"
#include "tests/support/data_folder.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace analytic {

namespace {

const std::string folder = data_folder() + "/analytic/";

std::vector<std::string> fields(const std::string &line) {
    std::vector<std::string> found;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');)
        found.push_back(field);
    return found;
}

void add_lamp_grid(cli::SceneFile &scene) {
    for (std::uint32_t i = 0; i < 64; ++i)
        for (std::uint32_t j = 0; j < 64; ++j)
            scene.spheres.push_back({{-15.75 + 0.5 * i, 5, -21.75 + 0.5 * j}, 0.05, {0, 0, 0}, (64 * i + j) % 7, 0});
}

} // namespace

std::vector<Expectation> read_expectations() {
    std::ifstream file(folder + "expected.csv");
    if (!file)
        throw std::runtime_error("cannot open " + folder + "expected.csv");
    std::vector<Expectation> expectations;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        const std::vector<std::string> field = fields(line);
        if (expectations.empty() || expectations.back().scene != field.at(0))
            expectations.push_back({field.at(0), {}});
        expectations.back().pixels.push_back({static_cast<std::uint32_t>(std::stoul(field.at(1))),
                                              static_cast<std::uint32_t>(std::stoul(field.at(2))),
                                              {std::stod(field.at(3)), std::stod(field.at(4))}});
    }
    return expectations;
}

cli::SceneFile read_scene(const std::string &name) {
    cli::SceneFile scene = cli::read_scene_file(folder + name + ".json");
    if (name == "22-lights4096")
        add_lamp_grid(scene);
    return scene;
}

void brighten(cli::SceneFile &scene, float factor) {
    for (pt_material &material : scene.materials)
        for (float &component : material.emission)
            component *= factor;
}

} // namespace analytic
