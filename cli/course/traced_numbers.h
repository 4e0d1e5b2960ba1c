// Numbers of a sample, by the hooks of shaders/trace.glsl.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace cli {

// A temporary copy of kernels that traces pixel 0.
class TracedFolder {
public:
    explicit TracedFolder(const std::string &shader_dir);
    TracedFolder(const TracedFolder &) = delete;
    TracedFolder &operator=(const TracedFolder &) = delete;
    ~TracedFolder();

    const std::string &path() const { return path_; }

private:
    TracedFolder();

    std::string path_;
};

std::vector<double> traced_numbers(std::span<const float> film);

} // namespace cli
