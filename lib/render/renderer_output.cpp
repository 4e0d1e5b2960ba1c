#include "lib/base/error.h"
#include "lib/film/film_bytes.h"
#include "lib/film/film_facts.h"
#include "lib/film/pixel_format.h"
#include "lib/film/tile_map.h"
#include "lib/render/film_identity.h"
#include "lib/render/missed_lamps.h"
#include "lib/render/renderer.h"
#include "lib/render/saved_film.h"
#include "lib/view/displacement.h"
#include "lib/view/view.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <utility>

namespace pt {

namespace {

// Translates the kernel's surface numbers to the caller's.
void read_first_hits(const Image &image, const RenderSettings &settings, const std::shared_ptr<const View> &view,
                     RenderDevice &device) {
    FirstHitQuery query{image.layout.pixels, image.layout.quantity, image.layout.format};
    query.pixels.y += settings.first_row;
    ImageRows rows(image);
    device.read_first_hits(view, settings, query, [&](std::span<const std::byte> pixels) {
        if (query.quantity != PT_QUANTITY_OBJECT) {
            rows.put(pixels);
            return;
        }
        std::vector<std::uint32_t> objects(pixels.size() / sizeof(std::uint32_t));
        std::memcpy(objects.data(), pixels.data(), pixels.size());
        for (std::uint32_t &object : objects)
            object = view->object_of(object);
        rows.put(std::as_bytes(std::span(objects)));
    });
}

} // namespace

// Returns the camera at the origin of the kernel's coordinates, from which apparent sizes of lamps follow. Parallel
// rays may start far away from the camera.
Camera Renderer::ray_start() {
    Camera start = *camera_;
    if (start.is_orthographic())
        start.position += view()->start_distance * start.forward;
    return start;
}

const ErrorEstimate &Renderer::error() {
    if (!error_ && samples_.least() < min_estimate_samples)
        error_ = unknown_error();
    if (!error_)
        look({}, job_ && job_->accumulation.has_estimate());
    return *error_;
}

void Renderer::look(std::span<double> by_tile, bool is_recorded) {
    const KernelsKept kept(devices_);
    const std::uint64_t samples = samples_.total();
    ErrorEstimator estimator({settings_->sampler, may_miss_lamps(*scene_, ray_start(), *settings_, samples),
                              finds_lamps_by_chance(settings_->estimator, settings_->max_path_length)});
    film_view_.estimate(estimator, {scene_->film_unit, samples_, by_tile}, is_recorded);
    rejected_samples_ = estimator.rejected();
    const bool is_unknown = samples_.least() < min_estimate_samples || hides_error(estimator.rejected(), samples);
    error_ = is_unknown ? unknown_error() : estimator.result();
}

ErrorEstimate Renderer::error_with_lamps() {
    if (!settings_ || !is_alive())
        return unknown_error();
    ErrorEstimate known = error();
    if (samples_.least() < min_estimate_samples)
        return known;
    const bool is_random = settings_->sampler == PT_SAMPLER_RANDOM;
    const UnmetSquares sums = unmet_squares(small_lamps(), relative_offset, is_random, [this](const LampPiece &piece) {
        return samples_.of(samples_.grid().tile_at(piece.x, piece.y)).count();
    });
    take_in_unmet_lamps(known, sums, 3.0 * settings_->width * settings_->row_count);
    return known;
}

const std::vector<LampPiece> &Renderer::small_lamps() {
    if (!small_lamps_)
        small_lamps_ = small_lamps_in_view(*scene_, *projection_of(ray_start(), settings_->width, settings_->height),
                                           settings_->first_row, settings_->row_count);
    return *small_lamps_;
}

const std::vector<std::uint64_t> &Renderer::samples_for_lamps() {
    if (samples_for_lamps_.empty()) {
        const TileGrid &grid = samples_.grid();
        const bool is_random = settings_->sampler == PT_SAMPLER_RANDOM;
        std::vector<std::uint64_t> needed(grid.count());
        for (const LampPiece &piece : small_lamps()) {
            std::uint64_t &of_tile = needed[grid.tile_at(piece.x, piece.y)];
            of_tile = std::max(of_tile, samples_to_hit(piece, relative_offset, is_random));
        }
        samples_for_lamps_ = std::move(needed);
    }
    return samples_for_lamps_;
}

const std::vector<double> &Renderer::tile_squares() {
    if (tile_squares_.empty()) {
        std::vector<double> by_tile(samples_.grid().count());
        look(by_tile, false);
        tile_squares_ = std::move(by_tile);
    }
    return tile_squares_;
}

bool Renderer::is_on_target() {
    const std::uint64_t count = samples_.of(0).count();
    return job_->stopping.has_target() && is_check(count) && job_->stopping.is_reached(error()) &&
           std::ranges::all_of(samples_for_lamps(), [=](std::uint64_t needed) { return needed <= count; });
}

ImageQuery Renderer::query(const ImageLayout &layout) const {
    const std::optional<PartCounts> counts =
        samples_.even() ? std::optional(part_counts(samples_.of(0))) : std::nullopt;
    return {layout.pixels, layout.quantity, scene_->film_unit, counts, layout.format};
}

void Renderer::require_samples_of(std::uint32_t quantity) const {
    require_coverage(quantity, settings_->coverage);
    require_samples();
}

void Renderer::readback(const Image &image) {
    require_settings();
    const KernelsKept kept(devices_);
    const bool is_of_hits = is_of_first_hits(image.layout.quantity);
    if (!is_of_hits)
        require_samples_of(image.layout.quantity);
    if (is_of_hits)
        read_first_hits(image, *settings_, view(), *devices_.front());
    else
        film_view_.read(image, query(image.layout), samples_);
}

std::span<std::byte> Renderer::map(const ImageLayout &layout) {
    require_settings();
    if (!is_of_first_hits(layout.quantity)) {
        require_samples_of(layout.quantity);
        const KernelsKept kept(devices_);
        if (const std::optional<std::span<std::byte>> mapped = film_view_.map(query(layout)))
            return *mapped;
    }
    mapped_image_.resize(layout.row_bytes * layout.pixels.height);
    readback(Image{layout, mapped_image_.data()});
    return mapped_image_;
}

void Renderer::readback(const BufferImage &image) {
    require_alive();
    if (!is_on_lent_device())
        throw Error(PT_ERROR_INVALID_STATE,
                    "the context does not use your Vulkan device: lend it one by pt_create_info.vulkan");
    require_settings();
    require_samples_of(image.layout.quantity);
    const KernelsKept kept(devices_);
    devices_.front()->resolve_to_buffer().write(
        query(image.layout), {.buffer = std::bit_cast<VkBuffer>(image.buffer),
                              .offset = image.offset_bytes,
                              .row_bytes = image.layout.row_bytes,
                              .semaphores = {.wait = std::bit_cast<VkSemaphore>(image.wait_semaphore),
                                             .signal = std::bit_cast<VkSemaphore>(image.signal_semaphore)}});
}

FilmIdentity Renderer::identity() const {
    std::vector<pt_device_info> infos;
    for (const auto &device : devices_)
        infos.push_back(device->device().info());
    return identity_of(*scene_, *camera_, *settings_, code_, infos);
}

Rectangle Renderer::pixels() const {
    return {0, settings_->first_row, settings_->width, settings_->row_count};
}

FilmHeader Renderer::film_header() {
    require_settings();
    require_samples();
    std::vector<LampSquare> lamps;
    for (const LampPiece &piece : small_lamps())
        if (const auto needed = samples_to_hit(piece, relative_offset, settings_->sampler == PT_SAMPLER_RANDOM))
            lamps.push_back({piece.x / lamp_square * lamp_square,
                             (piece.y + settings_->first_row) / lamp_square * lamp_square,
                             static_cast<std::uint32_t>(needed)});
    return {identity(), film_tiles(samples_, pixels()), round_, united(std::move(lamps))};
}

void Renderer::save_film(const FilmHeader &header, std::span<std::byte> bytes) const {
    save(FilmView::films(devices_), samples_, header, pixels(), bytes);
}

void Renderer::add_film(std::span<const std::byte> bytes) {
    require_settings();
    const FilmReader film(bytes);
    require_same(film.header().identity, identity(), "as in this context");
    const TileSamples added = samples_of_film(film.header(), pixels());
    TileSamples all = united(samples_, added);
    add(film, added, FilmView::films(devices_), samples_, all, pixels(), devices_.front()->device());
    for (const auto &other : std::span(devices_).subspan(1))
        other->discard_samples();
    round_ = later_of(round_, film.header().round);
    take_over(std::move(all));
}

const BrokenRule *Renderer::warning() {
    warning_.reset();
    if (scene_ && camera_ && settings_)
        warning_ = displaced_surface(*scene_, *camera_, *settings_);
    return warning_ ? &*warning_ : nullptr;
}

pt_stats Renderer::stats() {
    if (!rejected_samples_ && settings_ && is_alive() && !samples_.empty()) {
        std::uint64_t rejected = 0;
        for (const auto &device : devices_)
            rejected += device->film().rejected_samples();
        rejected_samples_ = rejected;
    }
    pt_stats stats{};
    stats.sample_count = static_cast<std::uint32_t>(samples_.least());
    stats.max_sample_count = static_cast<std::uint32_t>(samples_.most());
    if (settings_)
        stats.mean_sample_count =
            static_cast<double>(samples_.total()) / (1.0 * settings_->width * settings_->row_count);
    stats.submit_count = work_.submit_count;
    stats.device_seconds = work_.seconds;
    for (const auto &device : devices_)
        stats.device_bytes += device->device().allocated_bytes();
    stats.rejected_samples = rejected_samples_.value_or(0);
    stats.features = view_ ? feature_bits(view_->features) : 0;
    stats.device_count = static_cast<std::uint32_t>(devices_.size());
    return stats;
}

} // namespace pt
