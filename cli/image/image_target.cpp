#include "cli/image/image_target.h"

#include "cli/base/atomic_file.h"
#include "cli/base/exit_code.h"
#include "cli/base/output_file.h"

#include <algorithm>
#include <unistd.h>

namespace cli {

void check_image_names(std::span<const std::string> paths, std::optional<ImageFormat> format) {
    const bool to_standard_output = std::find(paths.begin(), paths.end(), standard_stream) != paths.end();
    if (to_standard_output && !format)
        throw Failure(ExitCode::usage, "-o -: standard output needs --format exr, png or jpg");
    if (to_standard_output && isatty(STDOUT_FILENO) == 1)
        throw Failure(ExitCode::usage, "-o -: standard output is a terminal; send it to a file or a program");
    if (format && !to_standard_output)
        throw Failure(ExitCode::usage, "--format: is for -o - alone; the names of files tell their formats");
    for (const std::string &path : paths)
        if (path != standard_stream && !image_format(path))
            throw Failure(ExitCode::usage, "-o " + path + ": the name must end in .exr, .png, .jpg or .jpeg");
}

ImageTarget image_target(const std::string &path, std::optional<ImageFormat> format) {
    return {path, path == standard_stream ? format.value() : image_format(path).value()};
}

void check_image_target(const ImageTarget &target, const ImageWindow &window) {
    const std::uint32_t side = std::max(window.part.width, window.part.height);
    const std::uint32_t longest = longest_side(target.format);
    if (side > longest) {
        throw Failure(ExitCode::usage, "-o " + target.path + ": this format holds at most " + std::to_string(longest) +
                                           " pixels a side, not " + std::to_string(side));
    }
    if (target.path != standard_stream)
        AtomicFile::check_writable(target.path);
}

} // namespace cli
