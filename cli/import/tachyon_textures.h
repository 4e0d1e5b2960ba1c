// The materials of a Tachyon scene, which are called textures there.
#pragma once

#include "cli/import/tachyon_words.h"

#include <cstddef>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace cli {

class TachyonTextures {
public:
    // Materials and warnings go into scene. Refers to both.
    TachyonTextures(TachyonWords &words, ForeignScene &scene) : words_(words), scene_(scene) {}

    // All throw Failure. What follows TEXDEF: a name and a texture; TEXALIAS: a name, and that of another texture.
    void define();
    void define_alias();

    // Of a shape: TEXTURE and what it is, or a name. Returns the index of the material.
    std::size_t read_reference();

private:
    ForeignMaterial read_body();
    void skip_pattern();
    std::size_t find(const std::string &name) const;
    std::size_t add(ForeignMaterial material);
    void leave_out(bool &is_told, const std::string &what);

    TachyonWords &words_;
    ForeignScene &scene_;
    std::unordered_map<std::string, std::size_t> named_;
    std::map<std::vector<double>, std::size_t> by_look_; // of those without a name: files have one for each shape
    bool is_opacity_told_ = false;
    bool is_pattern_told_ = false;
    bool is_outline_told_ = false;
};

} // namespace cli
