// Files that hold one frame after the other.
#pragma once

#include "cli/data/data_stream.h"
#include "cli/data/particle_rows.h"

#include <memory>
#include <utility>

namespace cli {

class FrameFile {
public:
    explicit FrameFile(std::unique_ptr<DataStream> stream) : stream_(std::move(stream)) {}
    FrameFile(const FrameFile &) = delete;
    FrameFile &operator=(const FrameFile &) = delete;
    virtual ~FrameFile() = default;

    // Reads the head of the next frame; false at the end of the file. All throw Failure.
    virtual bool next() = 0;

    // The frame's particles: one of these is to be called before the next frame.
    virtual void skip() = 0;
    virtual void read(ParticleRows &rows) = 0;

    // Where the next frame begins.
    DataStream::Place place() const { return stream_->place(); }
    bool go_to(const DataStream::Place &place) { return stream_->go_to(place); }

protected:
    DataStream &stream() const { return *stream_; }

private:
    std::unique_ptr<DataStream> stream_;
};

} // namespace cli
