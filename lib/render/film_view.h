// What the films of a context's devices say together: the image of their samples, and its error. On the first device,
// if it is of those whose kernels do so, else on the host. Owned by Renderer.
#pragma once

#include "lib/film/error_estimate.h"
#include "lib/film/film_errors.h"
#include "lib/film/tile_samples.h"
#include "lib/kernel/error_reader.h"
#include "lib/kernel/film_sum.h"
#include "lib/kernel/image_reader.h"
#include "lib/kernel/resolve.h"
#include "lib/render/image.h"
#include "lib/render/render_device.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace pt {

class FilmView {
public:
    using Devices = std::vector<std::unique_ptr<RenderDevice>>;

    // The devices must outlive it.
    explicit FilmView(const Devices &devices) : devices_(devices) {}

    // Of the films' samples, pixels as an image wants them. Throws PT_ERROR_INTERNAL if a driver lost work.
    void read(const Image &image, const ImageQuery &query, const TileSamples &samples);

    // Likewise, without gaps, in memory of the first device, where that makes the image; it stays until the film is
    // replaced, or the next call. Elsewhere none.
    std::optional<std::span<std::byte>> map(const ImageQuery &query);

    // Gives the estimator all that is known of the films' error, and where a kernel finds both at once what the query
    // asks of tiles. is_recorded: it is there already, of a submission that took the samples on the only device.
    // Throws likewise.
    void estimate(ErrorEstimator &estimator, const ErrorQuery &query, bool is_recorded);

    // Whether the host finds what is expected of tiles, without the error of the image: it takes less time.
    bool finds_tile_squares_alone() const { return !reads_on_device(); }
    std::span<const double> tile_squares(double unit, const TileSamples &samples);

    // What was known of the films' samples is void.
    void forget_samples() noexcept { errors_.forget(); }

    // Builds what it needs of kernels beside those of each device.
    void prepare();

    // Films or kernels are about to be replaced.
    void drop() noexcept { sums_.clear(); }

    // Brought up to date.
    static std::vector<DeviceFilm *> films(const Devices &devices);

private:
    // A sum of some rows of the films, and what reads it.
    struct Sum {
        Sum(const std::vector<FilmSum::Source> &sources, RenderDevice &home, std::uint32_t row_count);

        FilmSum rows;
        ImageReader image;
        std::optional<ErrorReader> error;
    };

    // Rows of the films that meet on the first device at a time.
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
    FilmErrors::ReadRows reader_of(const TileSamples &samples) const;
    void read_on_host(const Image &image, const ImageQuery &query, const TileSamples &samples) const;

    const Devices &devices_;
    FilmErrors errors_;   // as far as the host finds them
    std::list<Sum> sums_; // of the sizes that bands have: two at the most
};

} // namespace pt
