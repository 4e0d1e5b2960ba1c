// A cache of drivers' compiled kernels. Without access the program silently does without.
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
    // A file per device, driver and version of this program; the least recently used makes room.
    static constexpr std::size_t most_files = 32;
    static constexpr std::uint64_t most_bytes = std::uint64_t{64} << 20; // in all

    // An empty path keeps nothing. The folder need not exist.
    explicit KernelFolder(std::filesystem::path path) : path_(std::move(path)) {}

    // Returns the data's size; writes to bytes if there is room.
    std::uint64_t load(const std::string &key, std::span<std::byte> bytes) const;

    // Whole or not at all.
    void store(const std::string &key, std::span<const std::byte> bytes) const;

    // The folder must outlive the context.
    void serve(pt_create_info &info);

private:
    void make_room() const;

    std::filesystem::path path_;
};

} // namespace cli
