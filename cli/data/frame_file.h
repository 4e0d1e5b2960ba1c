// Files that hold one frame after the other.
#pragma once

#include "cli/data/particle_rows.h"

namespace cli {

class FrameFile {
public:
    FrameFile() = default;
    FrameFile(const FrameFile &) = delete;
    FrameFile &operator=(const FrameFile &) = delete;
    virtual ~FrameFile() = default;

    // Reads the head of the next frame; false at the end of the file. All throw Failure.
    virtual bool next() = 0;

    // The frame's particles: one of these is to be called before the next frame.
    virtual void skip() = 0;
    virtual void read(ParticleRows &rows) = 0;
};

} // namespace cli
