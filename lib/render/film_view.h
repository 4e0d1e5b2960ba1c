// Computes the image of a context's films and its error, on the first device if its policy says so, otherwise on the
// host.
#pragma once

#include "lib/film/error_estimate.h"
#include "lib/film/tile_errors.h"
#include "lib/film/tile_samples.h"
#include "lib/kernel/error_reader.h"
#include "lib/kernel/film_sum.h"
#include "lib/kernel/resolve.h"
#include "lib/kernel/resolve_to_host.h"
#include "lib/render/image.h"
#include "lib/render/render_device.h"

#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>
#include <span>
#include <vector>

namespace pt {

class FilmView {
public:
    explicit FilmView(const RenderDevices &devices) : devices_(devices) {}

    void read(const Image &image, const ImageQuery &query, const TileSamples &samples);

    // Returns the pixels, without gaps, in the device's memory. Returns no value if the device does not compute images.
    // Valid until the next call or a new film.
    std::optional<std::span<std::byte>> map(const ImageQuery &query);

    // Adds the errors of all tiles to the estimator, and fills query.by_tile. If `is_recorded`, the last submission of
    // samples has already computed the errors. Throws PT_ERROR_INTERNAL if a driver lost work.
    void estimate(ErrorEstimator &estimator, const ErrorQuery &query, bool is_recorded);

    // Must be called when the samples have changed.
    void forget_samples() noexcept { errors_.forget(); }

    void prepare();

    // Must be called before films or kernels are replaced.
    void drop() noexcept { sums_.clear(); }

    static std::vector<DeviceFilm *> films(const RenderDevices &devices);

private:
    struct Sum {
        Sum(const std::vector<FilmSum::Source> &sources, RenderDevice &home, std::uint32_t row_count);

        FilmSum rows;
        ResolveToHost image;
        std::optional<ErrorReader> error;
    };

    struct Band {
        std::uint32_t first_row;
        std::uint32_t row_count;
    };

    RenderDevice &home() const { return *devices_.front(); }
    bool reads_on_device() const;
    bool is_one_film() const { return devices_.size() == 1; }
    std::vector<Band> bands() const;
    Sum &sum(std::uint32_t row_count);
    void estimate_bands(const ErrorQuery &query, const ErrorReader::Receive &receive);
    void estimate_on_host(const ErrorQuery &query, const ErrorReader::Receive &receive);
    void read_on_host(const Image &image, const ImageQuery &query, const TileSamples &samples) const;

    const RenderDevices &devices_;
    FilmErrors errors_;
    std::list<Sum> sums_; // at most two sums of different sizes
};

} // namespace pt
