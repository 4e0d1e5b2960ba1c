#include "cli/base/kernel_folder.h"

#include "cli/base/exit_code.h"
#include "cli/base/file.h"

#include <algorithm>
#include <exception>
#include <fstream>
#include <system_error>
#include <vector>

namespace cli {
namespace {

namespace fs = std::filesystem;

// Keys are file names, so they must not contain paths.
bool is_key(const std::string &key) {
    return !key.empty() && key.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::uint64_t load_kernels(void *user, const char *key, void *data, std::uint64_t size_bytes) {
    try {
        return static_cast<const KernelFolder *>(user)->load(key, {static_cast<std::byte *>(data), size_bytes});
    } catch (const std::exception &) {
        return 0;
    }
}

void store_kernels(void *user, const char *key, const void *data, std::uint64_t size_bytes) {
    try {
        static_cast<const KernelFolder *>(user)->store(key, {static_cast<const std::byte *>(data), size_bytes});
    } catch (const std::exception &) {
        return; // the next start compiles again
    }
}

struct KeptFile {
    fs::path path;
    std::uint64_t size;
    fs::file_time_type last_use;
};

// Includes foreign files, such as temporary files of killed processes.
std::vector<KeptFile> files_in(const fs::path &folder) {
    std::vector<KeptFile> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code gone;
        const std::uint64_t size = entry->is_regular_file(gone) ? entry->file_size(gone) : 0;
        const fs::file_time_type last_use = entry->last_write_time(gone);
        if (!gone && entry->is_regular_file(gone))
            files.push_back({entry->path(), size, last_use});
    }
    return files;
}

} // namespace

std::uint64_t KernelFolder::load(const std::string &key, std::span<std::byte> bytes) const {
    if (path_.empty() || !is_key(key))
        return 0;
    const fs::path file = path_ / key;
    std::error_code error;
    const std::uint64_t size = fs::is_regular_file(file, error) ? fs::file_size(file, error) : 0;
    if (error || size == 0 || size > most_bytes || bytes.size() < size)
        return error || size > most_bytes ? 0 : size;
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(reinterpret_cast<char *>(bytes.data()), static_cast<std::streamsize>(size)))
        return 0;
    fs::last_write_time(file, fs::file_time_type::clock::now(), error); // marks the file as used
    return size;
}

void KernelFolder::store(const std::string &key, std::span<const std::byte> bytes) const {
    if (path_.empty() || !is_key(key) || bytes.size() > most_bytes)
        return;
    std::error_code error;
    fs::create_directories(path_, error);
    try {
        AtomicFile file((path_ / key).string());
        file.write(bytes);
        file.commit();
    } catch (const Failure &) {
        return;
    }
    make_room();
}

void KernelFolder::make_room() const {
    std::vector<KeptFile> files = files_in(path_);
    std::sort(files.begin(), files.end(),
              [](const KeptFile &one, const KeptFile &other) { return one.last_use > other.last_use; });
    std::size_t count = 0;
    std::uint64_t total = 0;
    for (const KeptFile &file : files) {
        total += file.size;
        if (++count > most_files || total > most_bytes) {
            std::error_code error;
            fs::remove(file.path, error);
        }
    }
}

void KernelFolder::serve(pt_create_info &info) {
    info.load_kernels = &load_kernels;
    info.store_kernels = &store_kernels;
    info.kernels_user = this;
}

} // namespace cli
