#include "cli/import/tachyon_textures.h"

#include "cli/data/text_number.h"

#include <array>
#include <utility>

namespace cli {
namespace {

// What a pattern takes after its number: a file's name, CENTER, ROTATE and SCALE, and axes.
struct TachyonPattern {
    bool has_file;
    int axis_count; // -1: nothing at all
};

constexpr std::array<TachyonPattern, 11> tachyon_patterns{{{false, -1},
                                                           {false, 0},
                                                           {false, 0},
                                                           {false, 0},
                                                           {false, 0},
                                                           {false, 0},
                                                           {false, 0},
                                                           {true, 0},
                                                           {true, 0},
                                                           {true, 2},
                                                           {true, 3}}};

// Tachyon's mirrors are perfect. A lobe of this exponent is as wide as a pixel or so.
constexpr double mirror_glossiness = 1e6;

} // namespace

void TachyonTextures::leave_out(bool &is_told, const std::string &what) {
    if (!std::exchange(is_told, true)) {
        scene_.left_out.push_back(words_.place() + ": " + what);
    }
}

std::size_t TachyonTextures::add(ForeignMaterial material) {
    scene_.materials.push_back(std::move(material));
    return scene_.materials.size() - 1;
}

void TachyonTextures::define() {
    const std::string name(words_.require("the name of a TEXDEF"));
    ForeignMaterial material = read_body();
    // Later ones take a name over.
    material.name = name;
    if (named_.contains(name)) {
        material.name.append(":").append(std::to_string(words_.line()));
    }
    named_[name] = add(std::move(material));
}

void TachyonTextures::define_alias() {
    const std::string name(words_.require("the name of a TEXALIAS"));
    named_[name] = find(std::string(words_.require("the name of a texture")));
}

std::size_t TachyonTextures::find(const std::string &name) const {
    const auto found = named_.find(name);
    if (found == named_.end()) {
        words_.refuse(quoted_text(name) + ": must be TEXTURE or the name of a TEXDEF before it");
    }
    return found->second;
}

std::size_t TachyonTextures::read_reference() {
    const std::string name(words_.require("a texture"));
    if (in_large_letters(name) != "TEXTURE") {
        return find(name);
    }
    const std::uint64_t line = words_.line();
    ForeignMaterial material = read_body();
    std::vector<double> look(material.diffuse.begin(), material.diffuse.end());
    look.insert(look.end(), material.specular.begin(), material.specular.end());
    look.push_back(material.glossiness);
    const auto [entry, is_new] = by_look_.try_emplace(std::move(look), scene_.materials.size());
    if (is_new) {
        material.name = std::string("TEXTURE:").append(std::to_string(line));
        add(std::move(material));
    }
    return entry->second;
}

// AMBIENT has no counterpart: light that comes from everywhere is found by paths.
ForeignMaterial TachyonTextures::read_body() {
    ForeignMaterial material;
    const auto share = [this](const std::string &name) {
        words_.expect(name);
        return words_.number_from_0(name);
    };
    share("AMBIENT");
    const double diffuse = share("DIFFUSE");
    const double mirror = share("SPECULAR");
    if (share("OPACITY") < 1.0) {
        leave_out(is_opacity_told_, "OPACITY: light through surfaces is left out, they are opaque");
    }
    if (words_.take_if("TRANSMODE")) {
        words_.require("the kind of transparency");
    }
    if (words_.take_if("OUTLINE")) {
        if (words_.number("OUTLINE") != 0.0) {
            leave_out(is_outline_told_, "OUTLINE: outlines are left out");
        }
        words_.expect("OUTLINE_WIDTH");
        words_.number("OUTLINE_WIDTH");
    }
    double highlight = 0.0;
    double exponent = 0.0;
    bool is_metal = false;
    if (words_.take_if("PHONG")) {
        is_metal = words_.keyword("PLASTIC or METAL") == "METAL";
        highlight = words_.number_from_0("PHONG");
        exponent = share("PHONG_SIZE");
    }
    words_.expect("COLOR");
    const ForeignVector color = words_.color("COLOR");
    words_.expect("TEXFUNC");
    skip_pattern();
    for (std::size_t i = 0; i < 3; ++i) {
        material.diffuse[i] = diffuse * color[i];
        // The lobe's peak is (n + 2) / 2 times its weight, where Tachyon's is the highlight itself.
        material.specular[i] = mirror > 0.0 ? mirror : 2.0 * highlight / (exponent + 2.0) * (is_metal ? color[i] : 1.0);
    }
    const bool has_lobe = mirror > 0.0 || highlight > 0.0;
    material.glossiness = !has_lobe ? 0.0 : mirror > 0.0 ? mirror_glossiness : exponent;
    return material;
}

// After TEXFUNC: a number, and what it takes.
void TachyonTextures::skip_pattern() {
    const double number = words_.number("TEXFUNC");
    const auto index = static_cast<std::size_t>(number >= 0.0 && number < 11.0 ? number : 11.0);
    if (static_cast<double>(index) != number || index >= tachyon_patterns.size()) {
        words_.refuse("TEXFUNC: must be a whole number from 0 to 10");
    }
    const TachyonPattern &pattern = tachyon_patterns[index];
    if (pattern.axis_count < 0) {
        return;
    }
    leave_out(is_pattern_told_, "TEXFUNC: patterns and images on surfaces are left out, their plain colour is used");
    if (pattern.has_file) {
        words_.require("the name of an image");
    }
    constexpr std::array<const char *, 6> names{"CENTER", "ROTATE", "SCALE", "UAXIS", "VAXIS", "WAXIS"};
    for (int i = 0; i < 3 + pattern.axis_count; ++i) {
        words_.expect(names[static_cast<std::size_t>(i)]);
        words_.vector(names[static_cast<std::size_t>(i)]);
    }
}

} // namespace cli
