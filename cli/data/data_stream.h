// Lines and runs of bytes of a file, through a buffer of bounded size.
#pragma once

#include "cli/data/byte_source.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace cli {

class DataStream {
public:
    // Of what peek and take give at a time, and of lines.
    static constexpr std::size_t longest = std::size_t{1} << 20;

    // name: of the file, for messages.
    DataStream(std::string name, std::unique_ptr<ByteSource> source);

    // The next bytes, which stay to be read; fewer at the end.
    std::string_view peek(std::size_t count);

    // The same, but they are taken; valid until the next call.
    std::string_view take(std::size_t count);

    // Returns how many there were.
    std::uint64_t skip(std::uint64_t count);

    // The next line without its end, \n or \r\n, valid until the next call; false at the end of the file. Throws
    // Failure(ExitCode::scene) for lines that are too long.
    bool next_line(std::string_view &line);

    // Whether the last line had an end: where a file is cut short, its last line may have lost a part.
    bool was_line_ended() const { return was_line_ended_; }

    // Returns how many there were.
    std::uint64_t skip_lines(std::uint64_t count);

    // How many there are yet, if that is known.
    std::optional<std::uint64_t> size_left() const;

    // Where the next byte is; and a way back to it, which what cannot be read twice does not have: false then.
    struct Place {
        std::uint64_t offset;
        std::uint64_t line;
    };
    Place place() const { return {offset_, line_}; }
    bool go_to(const Place &place);

    std::uint64_t line() const { return line_; }     // of the last line that was read or skipped, from 1
    std::uint64_t offset() const { return offset_; } // of the next byte; where a file is compressed, of what it holds

    // "melt.dump:17" and "cloud.ply: byte 1234", for messages.
    const std::string &name() const { return name_; }
    std::string line_place() const { return name_ + ":" + std::to_string(line_); }
    std::string byte_place() const { return byte_place(offset_); }
    std::string byte_place(std::uint64_t offset) const { return name_ + ": byte " + std::to_string(offset); }

private:
    bool refill(); // false at the end
    void consume(std::size_t count);

    std::string name_;
    std::unique_ptr<ByteSource> source_;
    std::unique_ptr<char[]> buffer_; // of longest bytes
    std::size_t first_ = 0;          // of the bytes in the buffer that are not taken
    std::size_t last_ = 0;
    std::uint64_t offset_ = 0;
    std::uint64_t line_ = 0;
    bool was_line_ended_ = true;
};

} // namespace cli
