#include "lib/platform/file.h"

#include "lib/platform/windows/windows.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <io.h>
#include <system_error>
#include <vector>

namespace platform {
namespace {

namespace fs = std::filesystem;

template <typename Byte>
unsigned size_of_part(std::span<Byte> bytes) {
    constexpr std::size_t most = std::size_t{1} << 30;
    return static_cast<unsigned>(std::min(bytes.size(), most));
}

int failed() {
    const auto reason =
        std::error_code(static_cast<int>(GetLastError()), std::system_category()).default_error_condition();
    errno = reason.category() == std::generic_category() ? reason.value() : EIO;
    return -1;
}

HANDLE handle_of(int descriptor) {
    return reinterpret_cast<HANDLE>(_get_osfhandle(descriptor));
}

int opened(HANDLE file, int flags) {
    return file == INVALID_HANDLE_VALUE ? failed() : _open_osfhandle(reinterpret_cast<std::intptr_t>(file), flags);
}

} // namespace

void close_file(int descriptor) {
    _close(descriptor);
}

// Lets other processes rename and remove the open file.
int open_to_read(const fs::path &path) {
    constexpr DWORD sharing = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    return opened(
        CreateFileW(path.c_str(), GENERIC_READ, sharing, nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr),
        _O_RDONLY | _O_BINARY);
}

int create_file(const fs::path &path) {
    return opened(CreateFileW(path.c_str(), GENERIC_WRITE | DELETE, FILE_SHARE_READ, nullptr, CREATE_NEW,
                              FILE_ATTRIBUTE_NORMAL, nullptr),
                  _O_WRONLY | _O_BINARY);
}

std::ptrdiff_t read_some(int descriptor, std::span<char> bytes) {
    return _read(descriptor, bytes.data(), size_of_part(bytes));
}

std::ptrdiff_t write_some(int descriptor, std::span<const std::byte> bytes) {
    return _write(descriptor, bytes.data(), size_of_part(bytes));
}

bool lock_created(int) {
    return true;
}

void remove_abandoned(const fs::path &path) {
    DeleteFileW(path.c_str());
}

// Renames the file while it is open, so that no other process can remove it first.
bool rename_written(int descriptor, const fs::path &from, const fs::path &to) {
    static_cast<void>(from);
    const std::wstring name = fs::absolute(to).make_preferred().wstring();
    std::vector<std::byte> bytes(sizeof(FILE_RENAME_INFO) + name.size() * sizeof(wchar_t));
    auto &info = *reinterpret_cast<FILE_RENAME_INFO *>(bytes.data());
    info.ReplaceIfExists = TRUE;
    info.FileNameLength = static_cast<DWORD>(name.size() * sizeof(wchar_t));
    std::copy(name.begin(), name.end(), info.FileName);
    const HANDLE file = handle_of(descriptor);
    const auto size = static_cast<DWORD>(bytes.size());
    return (FlushFileBuffers(file) && SetFileInformationByHandle(file, FileRenameInfo, &info, size)) || failed() == 0;
}

std::optional<std::uint64_t> regular_size(int descriptor) {
    LARGE_INTEGER size{};
    const HANDLE file = handle_of(descriptor);
    return GetFileType(file) == FILE_TYPE_DISK && GetFileSizeEx(file, &size)
               ? std::optional<std::uint64_t>(size.QuadPart)
               : std::nullopt;
}

std::optional<std::string> file_state(const fs::path &path) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error)
        return std::nullopt;
    const fs::file_time_type written = fs::last_write_time(path, error);
    return std::to_string(size) + " bytes at " +
           std::to_string(duration_cast<std::chrono::nanoseconds>(written.time_since_epoch()).count());
}

bool may_write(const fs::path &path) {
    return _waccess(path.c_str(), 2) == 0; // mode 2: writing
}

// On Windows only administrators and developers can create links.
bool may_follow(const fs::path &) {
    return true;
}

} // namespace platform
