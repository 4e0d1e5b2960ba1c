// Folds a film's parts on the host, for devices that share its memory. lavapipe's kernel would access memory one
// invocation at a time.
#pragma once

#include "lib/film/pixel_sums.h"
#include "lib/kernel/device_film.h"

#include <cstdint>
#include <vector>

namespace pt {

class HostFold {
public:
    HostFold(DeviceFilm &film, std::uint32_t into) : film_(film), into_(into) {}

    // Undoes the fold, unless keep() was called.
    ~HostFold();
    HostFold(const HostFold &) = delete;
    HostFold &operator=(const HostFold &) = delete;

    // Call once, with the film in host memory and no submission under way. The next submission overwrites the other
    // part, except rare words (film.glsl), which it assumes to be 0. If one is nonzero, returns false and folds
    // nothing.
    bool fold(std::vector<PixelRange> pixels);

    // Call after submission.
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
