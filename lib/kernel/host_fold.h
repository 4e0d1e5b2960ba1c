// A fold of a film's parts on the host, where the device's memory is the host's too: lavapipe's kernel, which reads and
// writes for one invocation after the other, takes many times as long. Made by Kernel for the submission that follows.
#pragma once

#include "lib/film/part_words.h"
#include "lib/kernel/device_film.h"

#include <cstdint>
#include <vector>

namespace pt {

class HostFold {
public:
    // Of the other part in memory into this one. The film must outlive it.
    HostFold(DeviceFilm &film, std::uint32_t into) : film_(film), into_(into) {}

    // The film is as it was before, unless keep() was called.
    ~HostFold();
    HostFold(const HostFold &) = delete;
    HostFold &operator=(const HostFold &) = delete;

    // Once, where the host sees the film's memory, and while no submission is under way. The other part's words stay,
    // for the submission to overwrite as what a kernel knows to be empty. Such a kernel takes the rare words
    // (film.glsl) to be 0, so where one of them is not, nothing is folded, and this is false.
    bool fold(std::vector<PixelRange> pixels);

    // The submission has been made.
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
