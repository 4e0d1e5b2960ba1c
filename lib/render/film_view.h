// The image in the films of a context's devices together, and its error. Found on the first device if its kernels do
// that, otherwise on the host. Owned by Renderer.
#pragma once

#include "lib/film/error_estimate.h"
#include "lib/film/tile_errors.h"
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
    // The devices must outlive it.
    explicit FilmView(const RenderDevices &devices) : devices_(devices) {}

    // Reads the image of the films' samples, in the format that it asks for. Throws PT_ERROR_INTERNAL if a driver lost
    // work.
    void read(const Image &image, const ImageQuery &query, const TileSamples &samples);

    // The same, without gaps, in memory of the first device, if that device makes images. The memory stays until the
    // film is replaced, or the next call. Otherwise nothing.
    std::optional<std::span<std::byte>> map(const ImageQuery &query);

    // Gives the estimator everything that is known about the error of the films, and answers what the query asks about
    // tiles. is_recorded: the only device has done this already, in the submission that took the samples. Throws
    // likewise.
    void estimate(ErrorEstimator &estimator, const ErrorQuery &query, bool is_recorded);

    // Forgets what is known, because the samples have changed.
    void forget_samples() noexcept { errors_.forget(); }

    // Builds the kernels that it needs beyond those of each device.
    void prepare();

    // To be called before films or kernels are replaced.
    void drop() noexcept { sums_.clear(); }

    // The films of the devices, brought up to date.
    static std::vector<DeviceFilm *> films(const RenderDevices &devices);

private:
    // The sum of some rows of the films, with its readers.
    struct Sum {
        Sum(const std::vector<FilmSum::Source> &sources, RenderDevice &home, std::uint32_t row_count);

        FilmSum rows;
        ImageReader image;
        std::optional<ErrorReader> error;
    };

    // Rows of the films that are summed on the first device at one time.
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
    FilmErrors errors_;   // as far as the host finds them
    std::list<Sum> sums_; // of the sizes that bands have: two at the most
};

} // namespace pt
