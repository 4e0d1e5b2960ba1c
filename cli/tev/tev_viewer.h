// Shows pictures in the image viewer tev, from a thread of its own: a rendering neither waits for the viewer nor fails
// with it. At most one picture waits while another is sent; a newer one takes its place.
#pragma once

#include "cli/base/background_task.h"
#include "cli/tev/tev_address.h"
#include "cli/tev/tev_connection.h"
#include "cli/tev/tev_packets.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace cli {

class TevViewer {
public:
    using Clock = TevConnection::Clock;

    explicit TevViewer(TevAddress address) : address_(std::move(address)) {}
    TevViewer(const TevViewer &) = delete;
    TevViewer &operator=(const TevViewer &) = delete;
    ~TevViewer() { finish(); }

    // Whether a picture would be sent at once.
    bool is_idle() const { return is_connected_ && !is_working_; }

    // Whether show() is of any use: the viewer is there, or is being looked for.
    bool may_show() const { return is_connected_ || is_working_; }

    void show(TevPicture picture);

    // Begins to look for the viewer, and again every second or so where it is not there or has left. Not before the
    // last call of setenv(): names of hosts are looked up, which reads the environment in another thread.
    void look(Clock::time_point now);

    // What went wrong, the first time that anything did; empty ever after.
    std::string take_complaint();

    // Gives a picture that is under way the time that a viewer takes which reads it, and no more.
    void finish();

private:
    struct Created { // the image that the viewer has of this connection
        std::string name;
        ImageWindow window;
        bool has_standard_error;

        bool operator==(const Created &) const = default;
    };

    void start();
    void work();
    void connect();
    void send(const TevPicture &picture);
    std::optional<TevPicture> take_waiting();
    void give_up(const std::string &reason);
    bool is_impatient(Clock::time_point since) const;

    TevAddress address_;
    TevConnection connection_; // of the thread, and what follows
    std::optional<Created> created_;
    std::atomic<bool> is_connected_ = false;
    std::atomic<bool> is_working_ = false; // falls only with the lock, where nothing waits
    std::atomic<bool> is_finishing_ = false;
    Clock::time_point finishing_since_; // before is_finishing_
    std::mutex mutex_;                  // of what follows
    std::optional<TevPicture> waiting_;
    std::string complaint_;
    bool has_complained_ = false;
    Clock::time_point next_look_;
    BackgroundTask task_; // destroyed first: it uses the others
};

} // namespace cli
