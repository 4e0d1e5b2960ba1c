// The kernels' SPIR-V, embedded in the library or compiled from GLSL files.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace pt {

struct KernelCode {
    std::span<const std::uint32_t> pathtrace;
    std::span<const std::uint32_t> fold;
    std::span<const std::uint32_t> add;
    std::span<const std::uint32_t> resolve;
    std::span<const std::uint32_t> estimate;
    std::span<const std::uint32_t> accuracy;
    std::span<const std::uint32_t> first_hit;
    std::span<const std::uint32_t> coverage;
    std::shared_ptr<const std::vector<std::vector<std::uint32_t>>> words; // owns the members' words

    bool operator==(const KernelCode &other) const { return *words == *other.words; }
};

KernelCode embedded_code();

// Digest of the code that makes pixels.
std::string digest_of(const KernelCode &code);

class ShaderSource {
public:
    // directory: has a .comp file per member of KernelCode; empty: the embedded code.
    explicit ShaderSource(std::string directory) : directory_(std::move(directory)) {}

    bool is_embedded() const { return directory_.empty(); }

    // Compiles the files as they are now. Throws PT_ERROR_SHADER with the compiler's log, PT_ERROR_UNSUPPORTED without
    // the compiler's module.
    KernelCode read() const;

private:
    std::string directory_;
};

} // namespace pt
