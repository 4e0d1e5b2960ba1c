#include "cli/tev/tev_connection.h"

#include <cerrno>
#include <memory>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <system_error>

namespace cli {
namespace {

std::string reason_of(int error) {
    return std::generic_category().message(error);
}

// Until bytes can be written. The end of the connection is seen too, which else the second write would see first.
void wait_until_writable(int socket, const TevConnection::Impatience &is_impatient) {
    constexpr int look_milliseconds = 50; // how often is_impatient is asked
    const auto begun = TevConnection::Clock::now();
    for (;;) {
        pollfd state{socket, POLLOUT | POLLRDHUP, 0};
        const int ready = poll(&state, 1, look_milliseconds);
        if (ready > 0 && (state.revents & (POLLRDHUP | POLLHUP)) != 0 && (state.revents & POLLERR) == 0) {
            throw TevFailure("it has closed the connection");
        }
        if (ready > 0) {
            return; // an error is told by what is done next
        }
        if (ready < 0 && errno != EINTR) {
            throw TevFailure(reason_of(errno));
        }
        if (is_impatient(begun)) {
            throw TevFailure("it does not answer");
        }
    }
}

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

Addresses find_addresses(const TevAddress &address) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_NUMERICSERV;
    addrinfo *found = nullptr;
    const int error = getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found);
    if (error != 0) {
        throw TevFailure(gai_strerror(error));
    }
    return {found, &freeaddrinfo};
}

// 0, or why there is no connection.
int connect_to(int socket, const addrinfo &address, const TevConnection::Impatience &is_impatient) {
    if (connect(socket, address.ai_addr, address.ai_addrlen) == 0) {
        return 0;
    }
    if (errno != EINPROGRESS && errno != EINTR) {
        return errno;
    }
    pollfd state{socket, POLLOUT, 0};
    const auto begun = TevConnection::Clock::now();
    while (poll(&state, 1, 50) <= 0) {
        if (is_impatient(begun)) {
            return ETIMEDOUT;
        }
    }
    int error = 0;
    socklen_t size = sizeof error;
    return getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

} // namespace

void TevConnection::open(const TevAddress &address, const Impatience &is_impatient) {
    const Addresses addresses = find_addresses(address);
    int error = 0;
    for (const addrinfo *each = addresses.get(); each != nullptr; each = each->ai_next) {
        socket_.emplace(socket(each->ai_family, each->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, each->ai_protocol));
        error = socket_->is_open() ? connect_to(socket_->get(), *each, is_impatient) : errno;
        if (error == 0) {
            return;
        }
    }
    close();
    throw TevFailure(reason_of(error));
}

void TevConnection::send(std::span<const std::byte> bytes, const Impatience &is_impatient) {
    try {
        while (!bytes.empty()) {
            wait_until_writable(socket_->get(), is_impatient);
            // Without a signal where nobody reads any more.
            const ssize_t sent = ::send(socket_->get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (sent < 0 && errno != EAGAIN && errno != EINTR) {
                throw TevFailure(reason_of(errno));
            }
            bytes = bytes.subspan(sent > 0 ? static_cast<std::size_t>(sent) : 0);
        }
    } catch (const TevFailure &) {
        close();
        throw;
    }
}

} // namespace cli
