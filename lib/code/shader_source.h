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
    std::shared_ptr<const std::vector<std::vector<std::uint32_t>>> words;

    bool operator==(const KernelCode &other) const { return *words == *other.words; }
};

KernelCode embedded_code();

std::string digest_of(const KernelCode &code);

class ShaderSource {
public:
    // The directory must have a .comp file for each member of KernelCode. Empty: embedded code.
    explicit ShaderSource(std::string directory) : directory_(std::move(directory)) {}

    bool is_embedded() const { return directory_.empty(); }

    // Compiles the current files. Throws PT_ERROR_SHADER with the compiler's log, or PT_ERROR_UNSUPPORTED if the
    // compiler's module is missing.
    KernelCode read() const;

private:
    std::string directory_;
};

} // namespace pt
