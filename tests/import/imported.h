// Reads scenes of other programs for tests.
#pragma once

#include "cli/scene/scene_file.h"

#include <fstream>
#include <sstream>
#include <string>

namespace imported {

inline std::string text_of(const std::string &name) {
    std::ostringstream text;
    text << std::ifstream(std::string(PT_TEST_DATA_DIR "/import/").append(name), std::ios::binary).rdbuf();
    return text.str();
}

// What is said of a text that is refused.
inline std::string message_of(const std::string &text, const std::string &name) {
    try {
        cli::parse_scene(text, name);
    } catch (const cli::Failure &failure) {
        return failure.code() == cli::ExitCode::scene ? failure.what() : "another exit code";
    }
    return "no failure";
}

// The text with a part of it replaced; the part has to be there.
inline std::string changed(std::string text, const std::string &from, const std::string &to) {
    return text.replace(text.find(from), from.size(), to);
}

// In the order of the file, after which lamps and the sky come.
inline const pt_material &material_of(const cli::SceneFile &scene, std::size_t sphere) {
    return scene.materials[scene.spheres[sphere].material];
}

} // namespace imported
