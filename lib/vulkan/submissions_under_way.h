// Submissions that are finished in order. The destructor waits for all, even after errors.
#pragma once

#include "lib/vulkan/device.h"

#include <cstddef>
#include <vector>

namespace pt::vulkan {

class SubmissionsUnderWay {
public:
    SubmissionsUnderWay(Device &device, std::size_t most) : device_(device) { tickets_.reserve(most); }
    SubmissionsUnderWay(const SubmissionsUnderWay &) = delete;
    SubmissionsUnderWay &operator=(const SubmissionsUnderWay &) = delete;
    ~SubmissionsUnderWay() {
        try {
            finish_all();
        } catch (...) { // the failed call has reported the error
        }
    }

    std::size_t count() const { return tickets_.size(); }

    void start(const Device::Record &record) { tickets_.push_back(device_.start(record)); }

    void finish_first() {
        const Device::Ticket ticket = tickets_.front();
        tickets_.erase(tickets_.begin());
        device_.finish(ticket);
    }

    void finish_all() {
        while (!tickets_.empty())
            finish_first();
    }

private:
    Device &device_;
    std::vector<Device::Ticket> tickets_;
};

} // namespace pt::vulkan
