// A folder with what drivers have made of kernels, so that the next start need not wait for that. It is a cache: where
// it cannot be read or written the program does without, and says nothing.
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
    // Each file is for one device with its driver and one version of this program. The file that was used longest ago
    // makes room.
    static constexpr std::size_t most_files = 32;
    static constexpr std::uint64_t most_bytes = std::uint64_t{64} << 20; // in all

    // With an empty path nothing is kept. The folder need not exist.
    explicit KernelFolder(std::filesystem::path path) : path_(std::move(path)) {}

    // Returns the size of what is kept under a key, and writes it to bytes if there is room.
    std::uint64_t load(const std::string &key, std::span<std::byte> bytes) const;

    // The file appears whole or not at all.
    void store(const std::string &key, std::span<const std::byte> bytes) const;

    // Sets the functions of a context to this folder, which must outlive it.
    void serve(pt_create_info &info);

private:
    void make_room() const;

    std::filesystem::path path_;
};

} // namespace cli
