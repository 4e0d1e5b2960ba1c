// Folds a film's parts on the host, for devices whose memory is the host's too. lavapipe's kernel reads and writes
// memory for one invocation after the other, so there the host is many times as fast. Kernel makes one for the
// submission that follows.
#pragma once

#include "lib/film/pixel_sums.h"
#include "lib/kernel/device_film.h"

#include <cstdint>
#include <vector>

namespace pt {

class HostFold {
public:
    // Folds the other part into this one. The film must outlive the object.
    HostFold(DeviceFilm &film, std::uint32_t into) : film_(film), into_(into) {}

    // Undoes the fold, unless keep() was called.
    ~HostFold();
    HostFold(const HostFold &) = delete;
    HostFold &operator=(const HostFold &) = delete;

    // Call it once, while the host can see the film's memory and no submission is under way. The words of the other
    // part stay: the submission that follows takes the part as empty and overwrites it. It assumes that the rare words
    // (film.glsl) of that part are 0; if one is not, nothing is folded and the result is false.
    bool fold(std::vector<PixelRange> pixels);

    // To be called when the submission has been made.
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
