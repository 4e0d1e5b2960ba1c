// One open file descriptor, closed by its owner.
#pragma once

#include <unistd.h>
#include <utility>

namespace cli {

class FileDescriptor {
public:
    explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
    FileDescriptor(const FileDescriptor &) = delete;
    FileDescriptor &operator=(const FileDescriptor &) = delete;
    ~FileDescriptor() { close(); }

    bool is_open() const { return descriptor_ >= 0; }
    int get() const { return descriptor_; }

    void close() {
        const int descriptor = std::exchange(descriptor_, -1);
        if (descriptor >= 0)
            ::close(descriptor);
    }

private:
    int descriptor_;
};

} // namespace cli
