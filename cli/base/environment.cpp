#include "cli/base/environment.h"

#include "lib/platform/process.h"

namespace cli {

std::filesystem::path user_cache() {
    const std::filesystem::path folder = platform::cache_folder();
    return folder.empty() ? folder : folder / "pt";
}

} // namespace cli
