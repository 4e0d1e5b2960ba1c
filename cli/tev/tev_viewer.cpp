#include "cli/tev/tev_viewer.h"

#include <new>
#include <utility>

namespace cli {
namespace {

using std::chrono::seconds;

constexpr seconds look_interval{1};
constexpr seconds connect_limit{5};
// Once the rendering has ended: since a byte was taken, if only before its end, and in all.
constexpr seconds idle_limit{2};
constexpr seconds finish_limit{10};

} // namespace

void TevViewer::start() {
    task_.finish(); // of the last task nothing is left but its end
    is_working_ = true;
    task_.start([this] { work(); });
}

void TevViewer::show(TevPicture picture) {
    {
        const std::lock_guard lock(mutex_);
        if (!may_show()) {
            return;
        }
        waiting_ = std::move(picture);
        if (is_working_) {
            return; // it will be found
        }
    }
    start();
}

void TevViewer::look(Clock::time_point now) {
    {
        const std::lock_guard lock(mutex_);
        if (may_show() || now < next_look_) {
            return;
        }
    }
    start();
}

std::string TevViewer::take_complaint() {
    const std::lock_guard lock(mutex_);
    return std::exchange(complaint_, "");
}

void TevViewer::finish() {
    finishing_since_ = Clock::now();
    is_finishing_ = true;
    task_.finish();
}

void TevViewer::work() {
    try {
        if (!connection_.is_open()) {
            connect();
        }
        while (const std::optional<TevPicture> picture = take_waiting()) {
            send(*picture);
        }
    } catch (const TevFailure &failure) {
        give_up(failure.what());
    } catch (const std::bad_alloc &) {
        connection_.close(); // in the middle of a packet, maybe
        give_up("no memory for it");
    }
}

void TevViewer::connect() {
    created_.reset();
    connection_.open(address_, [this](Clock::time_point since) {
        return is_impatient(since) || Clock::now() - since > connect_limit;
    });
    is_connected_ = true;
}

void TevViewer::send(const TevPicture &picture) {
    const auto send_packet = [this](std::span<const std::byte> packet) {
        connection_.send(packet, [this](Clock::time_point since) { return is_impatient(since); });
    };
    const Created image{picture.name, picture.window, !picture.standard_error.empty()};
    if (created_ != image) {
        send_packet(create_image_packet(picture));
        created_ = image;
    }
    for_each_update_packet(picture, send_packet);
}

std::optional<TevPicture> TevViewer::take_waiting() {
    const std::lock_guard lock(mutex_);
    is_working_ = waiting_.has_value();
    return std::exchange(waiting_, std::nullopt);
}

void TevViewer::give_up(const std::string &reason) {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(has_complained_, true)) {
        complaint_ = "no pictures for tev at " + tev_address_text(address_) + ": " + reason;
    }
    waiting_.reset();
    is_connected_ = false;
    next_look_ = Clock::now() + look_interval;
    is_working_ = false;
}

bool TevViewer::is_impatient(Clock::time_point since) const {
    if (!is_finishing_) {
        return false;
    }
    const Clock::time_point now = Clock::now();
    return now - since > idle_limit || now - finishing_since_ > finish_limit;
}

} // namespace cli
