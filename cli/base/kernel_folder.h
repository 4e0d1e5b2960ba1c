// A cache of compiled kernels. If it cannot be written, the program compiles each time.
#pragma once

#include <pt/pt.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace cli {

class KernelFolder {
public:
    // The least recently used files are removed first.
    static constexpr std::size_t most_files = 32;
    static constexpr std::uint64_t most_bytes = std::uint64_t{64} << 20;

    explicit KernelFolder(std::filesystem::path path) : path_(std::move(path)) {}

    // Returns the size of the data. Fills `bytes` if they are large enough.
    std::uint64_t load(const std::string &key, std::span<std::byte> bytes) const;

    void store(const std::string &key, std::span<const std::byte> bytes) const;

    // This object must outlive the context.
    void serve(pt_create_info &info);

private:
    void make_room() const;

    std::filesystem::path path_;
};

} // namespace cli
