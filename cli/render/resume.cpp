#include "cli/render/resume.h"

#include "cli/film/context_film.h"
#include "cli/film/film_file.h"
#include "cli/film/film_handle.h"
#include "cli/film/sample_ranges.h"

#include <filesystem>
#include <system_error>

namespace cli {
namespace {

// Runs take their samples in order, so those that one has left are the first of the next.
void require_first_samples(const std::string &path, const std::vector<pt_sample_range> &ranges,
                           const RenderTask &task) {
    const std::uint64_t first = task.render.first_sample;
    const pt_sample_range wanted{first, first + task.sample_count};
    const bool are_first =
        ranges.size() == 1 && ranges.front().first == wanted.first && ranges.front().end <= wanted.end;
    if (!are_first) {
        throw Failure(ExitCode::usage, path + ": has the samples " + ranges_text(ranges) +
                                           ", which are not the first ones of " + ranges_text({wanted}) +
                                           ", those of --first-sample and --spp");
    }
}

} // namespace

std::uint32_t resume(const Context &context, const RenderTask &task) {
    const std::string &path = task.options.checkpoint;
    std::error_code error;
    if (!std::filesystem::exists(path, error) && !error)
        return 0;
    const std::vector<std::byte> bytes = read_film_file(path);
    const std::vector<pt_sample_range> ranges = FilmHandle(path, bytes).ranges(0);
    add_film(context, path, bytes);
    require_first_samples(path, ranges, task);
    return context.sample_count();
}

} // namespace cli
