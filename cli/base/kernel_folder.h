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
    // A file is a device with a driver and a version of this program. What was used longest ago makes place.
    static constexpr std::size_t most_files = 32;
    static constexpr std::uint64_t most_bytes = std::uint64_t{64} << 20; // in all

    // An empty path: nothing is kept. The folder need not exist.
    explicit KernelFolder(std::filesystem::path path) : path_(std::move(path)) {}

    // How many bytes are kept under a key; written to bytes if there is room.
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
