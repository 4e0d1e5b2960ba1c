// Films added to a context, which afterwards has either its earlier film or sums with which it can go on. The fuzzer's
// bytes follow the lines of the context's identity, which differ from device to device.
#include "tests/fuzz/film_input.h"
#include "tests/fuzz/require.h"
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"

#include "lib/film/film_bytes.h"

#include <pt/film.h>
#include <pt/stats.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

namespace {

constexpr std::uint32_t width = 4;
constexpr std::uint32_t height = 3;
constexpr std::uint32_t sample_count = 4; // of the context

using Bytes = std::vector<std::byte>;

void complain(void *, std::int32_t level, const char *line) {
    fuzz::require(level == PT_LOG_INFO, line);
}

class Context {
public:
    Context() {
        pt_create_info info{};
        info.struct_size = sizeof info;
        info.flags = std::getenv("PT_TEST_NO_VALIDATION") ? 0 : PT_CREATE_VALIDATION;
        info.device = std::getenv("PT_TEST_DEVICE");
        info.log = complain;
        fuzz::require(pt_create(&info, &context_) == PT_OK, pt_last_error(nullptr));
        const pt_material material[] = {{{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {1, 1, 1}, 0, 0}};
        const pt_sphere sphere[] = {{{0, 0, -3}, 1, {0, 0, 0}, 0, 0}};
        const pt_scene scene = scene_of(material, sphere, {});
        pt_camera camera{};
        camera.struct_size = sizeof camera;
        camera.target[2] = -1;
        done(pt_set_scene(context_, &scene));
        done(pt_set_camera(context_, &camera));
        clear();
        take(sample_count);
        film_ = film();
    }
    ~Context() { pt_destroy(context_); }
    Context(const Context &) = delete;
    Context &operator=(const Context &) = delete;

    // The film of its own samples.
    const Bytes &own_film() const { return film_; }

    void reset() {
        clear();
        done(add(film_));
    }

    pt_result add(const Bytes &film) { return pt_add_film(context_, film.data(), film.size()); }

    void take(std::uint32_t count) {
        const pt_accumulate_info info{sizeof info, count, nullptr, nullptr, 0, 0, 0, nullptr, 0, 0};
        done(pt_accumulate(context_, &info));
    }

    Bytes film() {
        std::uint64_t size = 0;
        done(pt_save_film(context_, nullptr, &size));
        Bytes bytes(size);
        done(pt_save_film(context_, bytes.data(), &size));
        return bytes;
    }

    std::uint32_t count() {
        pt_stats stats{};
        stats.struct_size = sizeof stats;
        done(pt_get_stats(context_, &stats));
        return stats.sample_count;
    }

    bool shows_numbers() {
        std::array<float, std::size_t{3} * width * height> pixels{};
        const pt_image image = image_target(pixels);
        done(pt_readback(context_, &image));
        return std::ranges::all_of(pixels, [](float x) { return x >= 0.0F && std::isfinite(x); });
    }

private:
    void done(pt_result result) {
        fuzz::require(result == PT_OK, std::string(pt_result_name(result)) + ": " + pt_last_error(context_));
    }

    void clear() {
        pt_render render{};
        render.struct_size = sizeof render;
        render.width = width;
        render.height = height;
        render.max_path_length = 1;
        done(pt_set_render(context_, &render));
    }

    pt_context *context_ = nullptr;
    Bytes film_;
};

// The lines of a film before its tile.
std::span<const std::byte> identity_of(const Bytes &film) {
    const std::string_view text(reinterpret_cast<const char *>(film.data()), film.size());
    return std::span(film).first(text.find("\ntile ") + 1);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    static Context context;
    const Bytes film = fuzz::film_input(identity_of(context.own_film()), std::as_bytes(std::span(data, size)));
    const pt_result result = context.add(film);
    if (result != PT_OK) {
        fuzz::require(result == PT_ERROR_INCOMPATIBLE, pt_result_name(result));
        fuzz::require(context.film() == context.own_film(), "a refused film changes nothing");
        return 0;
    }
    const std::uint64_t added = pt::FilmReader(film).header().tiles.front().samples.count();
    fuzz::require(context.count() == sample_count + added, "all samples of the film were added");
    fuzz::require(context.shows_numbers(), "radiance is finite and not negative");
    if (added < UINT32_MAX - sample_count)
        context.take(1);
    fuzz::require(!context.film().empty(), "what was added is saved again");
    context.reset();
    return 0;
}
