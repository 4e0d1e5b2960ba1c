// The words of a scene of another program, with the lines that they stand in.
#pragma once

#include "cli/import/foreign_scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cli {

class SceneWords {
public:
    // text stays where it is. path: for messages.
    SceneWords(std::string_view text, std::string path) : rest_(text), path_(std::move(path)) {}

    // The next word, what is between blanks; nothing at the end. What follows # in a line is a comment.
    std::optional<std::string_view> next();

    // All below throw Failure(ExitCode::scene) with file and line. what is for messages: "the radius of a sphere".
    std::string_view require(std::string_view what);
    double number(std::string_view what);
    double number_from_0(std::string_view what);
    std::uint32_t whole_number(std::string_view what); // from 1
    ForeignVector vector(std::string_view what);
    ForeignVector direction(std::string_view what); // not 0
    ForeignVector color(std::string_view what);     // of numbers from 0

    // The next word, which stays; empty at the end.
    std::string_view peek();

    std::uint64_t line() const { return line_; } // of the last word, from 1
    std::string place() const { return path_ + ":" + std::to_string(line_); }
    [[noreturn]] void refuse(const std::string &what) const;

private:
    void pass_blanks();

    std::string_view rest_;
    std::string path_;
    std::uint64_t line_ = 1;      // of the last word
    std::uint64_t next_line_ = 1; // of rest_
};

} // namespace cli
