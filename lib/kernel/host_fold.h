// Adds one part of a film to the other on the host. On lavapipe this is faster than a kernel, whose invocations access
// memory one at a time.
#pragma once

#include "lib/film/pixel_sums.h"
#include "lib/kernel/device_film.h"

#include <cstdint>
#include <vector>

namespace pt {

class HostFold {
public:
    HostFold(DeviceFilm &film, std::uint32_t into) : film_(film), into_(into) {}

    // Undoes the fold unless keep() was called.
    ~HostFold();
    HostFold(const HostFold &) = delete;
    HostFold &operator=(const HostFold &) = delete;

    // The film must be in host memory, and no submission may be running. May be called once. Folds nothing and returns
    // false if the part to be added has a word other than 0 in its rare planes, where the next submission expects
    // zeros.
    bool fold(std::vector<PixelRange> pixels);

    // Must be called after the submission.
    void keep() noexcept { folded_.clear(); }

private:
    using Operation = decltype(add_words) *;

    bool has_rare_words(const PixelRange &pixels) const;
    void combine(const PixelRange &pixels, Operation operation) noexcept;

    DeviceFilm &film_;
    std::uint32_t into_;
    std::vector<PixelRange> folded_;
};

} // namespace pt
