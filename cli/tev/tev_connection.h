// A connection to the image viewer tev, over which nothing but packets is sent: tev answers nothing.
#pragma once

#include "cli/base/file_descriptor.h"
#include "cli/tev/tev_address.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>

namespace cli {

// Why there is no connection, or no more.
class TevFailure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

class TevConnection {
public:
    using Clock = std::chrono::steady_clock;

    // Whether to wait no longer, where nothing has happened since the given time.
    using Impatience = std::function<bool(Clock::time_point)>;

    bool is_open() const { return socket_.has_value(); }

    // Both throw TevFailure, after which there is no connection; also when they are to wait no longer.
    void open(const TevAddress &address, const Impatience &is_impatient);
    void send(std::span<const std::byte> bytes, const Impatience &is_impatient);

    void close() { socket_.reset(); }

private:
    std::optional<FileDescriptor> socket_;
};

} // namespace cli
