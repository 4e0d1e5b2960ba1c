// Inputs start after the lines of the identity, because these depend on the device.
#include "tests/fuzz/film_input.h"
#include "tests/fuzz/on_device.h"
#include "tests/support/scene_of.h"

#include "lib/film/film_bytes.h"

#include <pt/film.h>

#include <string_view>

namespace {

constexpr std::uint32_t sample_count = 4;

using Bytes = std::vector<std::byte>;

pt_result add(const Bytes &film) {
    return pt_add_film(fuzz::context(), film.data(), film.size());
}

Bytes film() {
    std::uint64_t size = 0;
    fuzz::require_done(pt_save_film(fuzz::context(), nullptr, &size));
    Bytes bytes(size);
    fuzz::require_done(pt_save_film(fuzz::context(), bytes.data(), &size));
    return bytes;
}

void clear() {
    const pt_render render = render_of(4, 3, 1);
    fuzz::require_done(pt_set_render(fuzz::context(), &render));
}

const Bytes &own_film() {
    static const Bytes own = [] {
        const pt_material material[] = {{{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {1, 1, 1}, 0, 0}};
        const pt_sphere sphere[] = {{{0, 0, -3}, 1, {0, 0, 0}, 0, 0}};
        const pt_scene scene = scene_of(material, sphere, {});
        const pt_camera camera = camera_at({0, 0, 0}, {0, 0, -1});
        fuzz::require_done(pt_set_scene(fuzz::context(), &scene));
        fuzz::require_done(pt_set_camera(fuzz::context(), &camera));
        clear();
        fuzz::take_samples(sample_count);
        return film();
    }();
    return own;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char *>(own_film().data()), own_film().size());
    const auto identity = std::span(own_film()).first(text.find("\ntile ") + 1);
    const Bytes added_film = fuzz::film_input(identity, std::as_bytes(std::span(data, size)));
    const pt_result result = add(added_film);
    if (result != PT_OK) {
        fuzz::require(result == PT_ERROR_INCOMPATIBLE, pt_result_name(result));
        fuzz::require(film() == own_film(), "a refused film changes nothing");
        return 0;
    }
    const std::uint64_t added = pt::FilmReader(added_film).header().tiles.front().samples.count();
    fuzz::require(fuzz::stats().sample_count == sample_count + added, "all samples of the film were added");
    fuzz::read_radiance();
    if (added < UINT32_MAX - sample_count)
        fuzz::take_samples(1);
    fuzz::require(!film().empty(), "what was added is saved again");
    clear();
    fuzz::require_done(add(own_film()));
    return 0;
}
