#include "cli/course/traced_numbers.h"

#include "cli/base/exit_code.h"
#include "cli/base/file.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <system_error>

namespace cli {

namespace fs = std::filesystem;

TracedFolder::TracedFolder() {
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    for (int attempt = 0; path_.empty() && !error; ++attempt)
        if (const fs::path path = parent / temporary_name(attempt); fs::create_directory(path, error))
            path_ = path.string();
    refuse_if(path_.empty(), "the kernels need a temporary folder: " + error.message(), ExitCode::file);
}

// After the first constructor, failures run the destructor.
TracedFolder::TracedFolder(const std::string &shader_dir) : TracedFolder() {
    std::error_code error;
    const fs::path folder = path_;
    for (fs::directory_iterator file(shader_dir, error), end; !error && file != end; file.increment(error))
        if (file->is_regular_file())
            fs::copy_file(file->path(), folder / file->path().filename(), error);
    if (!error)
        fs::rename(folder / "trace.glsl", folder / "hooks.glsl", error);
    refuse_if(static_cast<bool>(error), shader_dir + ": cannot be copied: " + error.message(), ExitCode::file);
    write_report_file((folder / "trace.glsl").string(), "#define TRACE_PIXEL 0u\n#include \"hooks.glsl\"\n");
}

TracedFolder::~TracedFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
}

std::vector<double> traced_numbers(std::span<const float> film) {
    constexpr std::uint32_t number_kind = 2;
    constexpr std::size_t record_size = 6;
    const double unit = double{film[0]} / 0x1p23;
    std::vector<double> numbers;
    for (std::size_t i = 0; unit > 0.0 && i + record_size <= film.size(); i += record_size) {
        const auto half = [&](std::size_t at) { return static_cast<std::uint32_t>(std::lround(film[i + at] / unit)); };
        if ((half(3) >> 8 & 7) == number_kind)
            numbers.push_back(std::bit_cast<float>(half(0) << 8 | (half(3) & 255)));
    }
    return numbers;
}

} // namespace cli
