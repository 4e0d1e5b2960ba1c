#include "cli/data/data_stream.h"

#include "cli/base/exit_code.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace cli {

DataStream::DataStream(std::string name, std::unique_ptr<ByteSource> source) :
    name_(std::move(name)),
    source_(std::move(source)),
    buffer_(std::make_unique_for_overwrite<char[]>(longest)) {} // nothing is read of it before it is written

// Keeps what is not taken, and moves it to the front if the buffer is full to its end.
bool DataStream::refill() {
    if (last_ == longest) {
        std::memmove(buffer_.get(), buffer_.get() + first_, last_ - first_);
        last_ -= first_;
        first_ = 0;
    }
    const std::size_t count = source_->read(buffer_.get() + last_, longest - last_);
    last_ += count;
    return count > 0;
}

void DataStream::consume(std::size_t count) {
    first_ += count;
    offset_ += count;
    if (first_ == last_) {
        first_ = 0;
        last_ = 0;
    }
}

std::string_view DataStream::peek(std::size_t count) {
    if (first_ + count > longest) {
        std::memmove(buffer_.get(), buffer_.get() + first_, last_ - first_);
        last_ -= first_;
        first_ = 0;
    }
    while (last_ - first_ < count && refill()) {
    }
    return {buffer_.get() + first_, std::min(count, last_ - first_)};
}

std::string_view DataStream::take(std::size_t count) {
    const std::string_view bytes = peek(count);
    consume(bytes.size());
    return bytes;
}

std::uint64_t DataStream::skip(std::uint64_t count) {
    std::uint64_t left = count;
    while (left > 0 && (first_ < last_ || refill())) {
        const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(left, last_ - first_));
        consume(step);
        left -= step;
    }
    return count - left;
}

bool DataStream::next_line(std::string_view &line) {
    const char *found = nullptr;
    for (std::size_t searched = 0;;) {
        const std::size_t size = last_ - first_;
        found = static_cast<const char *>(std::memchr(buffer_.get() + first_ + searched, '\n', size - searched));
        if (found != nullptr) {
            break;
        }
        if (size == longest) {
            throw Failure(ExitCode::scene, name_ + ":" + std::to_string(line_ + 1) + ": a line of more than " +
                                               std::to_string(longest) + " bytes: this is not a text file");
        }
        searched = size;
        if (!refill()) {
            break;
        }
    }
    was_line_ended_ = found != nullptr;
    const char *begin = buffer_.get() + first_;
    const auto size = was_line_ended_ ? static_cast<std::size_t>(found - begin) : last_ - first_;
    if (!was_line_ended_ && size == 0) {
        return false;
    }
    const bool has_return = size > 0 && begin[size - 1] == '\r';
    line = {begin, has_return ? size - 1 : size};
    consume(size + (was_line_ended_ ? 1 : 0));
    ++line_;
    return true;
}

std::optional<std::uint64_t> DataStream::size_left() const {
    const auto unread = source_->size_left();
    return unread ? std::optional(*unread + (last_ - first_)) : std::nullopt;
}

bool DataStream::go_to(const Place &place) {
    if (!source_->seek(place.offset)) {
        return false;
    }
    first_ = 0;
    last_ = 0;
    offset_ = place.offset;
    line_ = place.line;
    return true;
}

std::uint64_t DataStream::skip_lines(std::uint64_t count) {
    std::uint64_t skipped = 0;
    for (std::string_view ignored; skipped < count && next_line(ignored);) {
        ++skipped;
    }
    return skipped;
}

} // namespace cli
