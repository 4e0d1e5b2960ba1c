// An accepted file must have all of its numbers.
#include "tests/fuzz/require.h"

#include "lib/base/error.h"
#include "lib/scene_file/sphere_columns.h"

#include <pt/pt.h>

#include <string>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>

namespace {

class MemoryFile {
public:
    MemoryFile(const std::uint8_t *data, std::size_t size) : file_(memfd_create("npy", 0)) {
        fuzz::require(write(file_.get(), data, size) == static_cast<ssize_t>(size), "there is memory");
    }
    std::string path() const { return "/proc/self/fd/" + std::to_string(file_.get()); }

private:
    platform::FileDescriptor file_;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    constexpr std::size_t longest_message = 150;
    try {
        const MemoryFile memory(data, size);
        platform::InputFile file(memory.path());
        const pt::NpyArray array = pt::read_npy(file, "a.npy");
        const std::size_t number_bytes = array.type == PT_TYPE_FLOAT64 ? 8 : array.type == PT_TYPE_FLOAT32 ? 4 : 1;
        fuzz::require(number_bytes > 1 || array.type == PT_TYPE_SRGB8, "columns have types that spheres take");
        fuzz::require(array.row_length <= 3, "rows are no longer than positions");
        const std::size_t row_bytes = number_bytes * (array.row_length ? array.row_length : 1);
        fuzz::require(array.row_bytes() == row_bytes && array.file.size() == size &&
                          (size - array.first) / row_bytes == array.row_count && (size - array.first) % row_bytes == 0,
                      "the numbers are the last bytes of the file");
    } catch (const pt::Error &error) {
        const std::string_view words = error.what();
        fuzz::require(error.code() == PT_ERROR_INVALID_SCENE, "what is refused is the scene's fault");
        fuzz::require(words.starts_with("a.npy: ") && words.size() < longest_message,
                      "messages are short and name the file");
    }
    return 0;
}
