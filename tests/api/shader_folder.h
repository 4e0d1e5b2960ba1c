#pragma once

#include "tests/cli/temporary_folder.h"

#include <algorithm>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

class ShaderFolder : public TemporaryFolder {
public:
    ShaderFolder() { std::filesystem::copy(PT_TEST_SHADER_DIR, path(), std::filesystem::copy_options::recursive); }

    std::string path() const { return std::filesystem::path(file("x")).parent_path(); }

    // `old_part` must occur exactly once.
    void replace(const std::string &name, const std::string &old_part, const std::string &new_part) const {
        std::string text = read(name);
        const std::size_t place = text.find(old_part);
        ASSERT_NE(place, std::string::npos) << old_part << " is not in " << name;
        ASSERT_EQ(text.find(old_part, place + 1), std::string::npos) << old_part << " is in " << name << " again";
        write(name, text.replace(place, old_part.size(), new_part));
    }

    // Inserts a faulty line. Returns the place that the compiler's message names.
    std::string break_film() const {
        std::string text = read("film.glsl");
        const std::size_t place = text.find("uvec4 windows_of(");
        EXPECT_NE(place, std::string::npos);
        const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(place), '\n') + 1;
        write("film.glsl", text.insert(place, "float broken = nothing_like_it;\n"));
        return file("film.glsl") + ":" + std::to_string(line) + ": 'nothing_like_it' : undeclared identifier";
    }
};
