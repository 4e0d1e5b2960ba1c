#include "lib/render/film_view.h"

#include "lib/render/image_rows.h"

#include <algorithm>

namespace pt {

namespace {

// Pixels of a band, 56 MiB: many times what is on its way between two devices, and little beside a large film.
constexpr std::uint32_t most_band_pixels = 1U << 19;

} // namespace

std::vector<DeviceFilm *> FilmView::films(const Devices &devices) {
    std::vector<DeviceFilm *> films;
    for (const auto &device : devices)
        films.push_back(&device->film());
    return films;
}

// Whether the first film has all samples, in parts that no sample of another has moved.
bool FilmView::is_one_film(const SampleSet &samples) const {
    return devices_.size() == 1 && home().film().parts().split() == split_of(samples.hull());
}

// As few bands of whole rows of regions as there may be, all of one size but for the last.
std::vector<FilmView::Band> FilmView::bands() const {
    const std::uint32_t width = home().film().width();
    const std::uint32_t row_count = home().film().pixel_count() / width;
    const std::uint32_t regions = (row_count + gpu::REGION_SIZE - 1) / gpu::REGION_SIZE; // one above the other
    const std::uint32_t most = std::max<std::uint32_t>(most_band_pixels / gpu::REGION_SIZE / width, 1);
    const std::uint32_t band_count = (regions + most - 1) / most;
    const std::uint32_t rows_of_band = (regions + band_count - 1) / band_count * gpu::REGION_SIZE;
    std::vector<Band> bands;
    for (std::uint32_t row = 0; row < row_count; row += bands.back().row_count)
        bands.push_back({row, std::min(rows_of_band, row_count - row)});
    return bands;
}

FilmView::Sum::Sum(const std::vector<FilmSum::Source> &sources, RenderDevice &home, std::uint32_t row_count) :
    rows(sources, home.add_pipeline(), row_count),
    image(home.device(), home.resolve_pipelines(), rows.film()) {}

FilmView::Sum &FilmView::sum(std::uint32_t row_count) {
    const std::uint32_t width = home().film().width();
    const auto found =
        std::ranges::find_if(sums_, [&](Sum &sum) { return sum.rows.film().pixel_count() == row_count * width; });
    if (found != sums_.end())
        return *found;
    std::vector<FilmSum::Source> sources;
    for (const auto &device : devices_)
        sources.push_back({device->device(), device->film()});
    return sums_.emplace_back(sources, home(), row_count);
}

void FilmView::prepare() {
    if (devices_.size() > 1 && home().device().policy().resolve_on_device)
        home().add_pipeline();
}

void FilmView::read(const Image &image, const ImageQuery &query, const SampleSet &samples) {
    if (!home().device().policy().resolve_on_device) {
        read_on_host(image, query, samples);
        return;
    }
    ImageRows rows(image);
    const auto put = [&](std::span<const std::byte> pixels) { rows.put(pixels); };
    if (is_one_film(samples)) {
        home().image_reader().read(query, put);
        return;
    }
    films(devices_);
    const std::uint32_t width = home().film().width();
    for (const Band &band : bands()) {
        const std::uint32_t first = std::max(band.first_row, query.pixels.y);
        const std::uint32_t end = std::min(band.first_row + band.row_count, query.pixels.y + query.pixels.height);
        if (first >= end)
            continue;
        Sum &sum = this->sum(band.row_count);
        sum.rows.gather(band.first_row, {first * width, (end - first) * width}, samples.hull());
        ImageQuery in_band = query;
        in_band.pixels.y = first - band.first_row;
        in_band.pixels.height = end - first;
        sum.image.read(in_band, put);
    }
}

// Of the rows that the image has a part of.
void FilmView::read_on_host(const Image &image, const ImageQuery &query, const SampleSet &samples) const {
    ImageRows rows(image);
    const std::uint32_t width = home().film().width();
    const PixelRange range{query.pixels.y * width, query.pixels.height * width};
    std::uint64_t first = range.first;
    read_films(films(devices_), samples, range, piece_pixels, [&](const PixelSums &sums) {
        const PixelEstimates pixels = sums.estimates(query.unit, query.standard_error);
        rows.put_part(first, width, query.standard_error ? pixels.standard_error : pixels.radiance);
        first += sums.pixel_count();
    });
}

// Regions come in one order, whoever sums them up: an image has the same estimate on one device and on several.
void FilmView::estimate(ErrorEstimator &estimator, double unit, const SampleSet &samples, bool is_recorded) {
    const ErrorQuery query{unit, part_counts(samples)};
    const auto add = [&](const RegionErrors &region) { estimator.add(region); };
    if (!home().device().policy().resolve_on_device || !home().film().has_whole_regions()) {
        read_films(films(devices_), samples, piece_pixels,
                   [&](const PixelSums &sums) { estimator.add(sums.estimates(unit, true)); });
        return;
    }
    if (is_one_film(samples)) {
        if (is_recorded)
            home().error_reader().collect(query, add);
        else
            home().error_reader().read(query, add);
        return;
    }
    films(devices_);
    const std::uint32_t width = home().film().width();
    for (const Band &band : bands()) {
        Sum &sum = this->sum(band.row_count);
        sum.rows.gather(band.first_row, {band.first_row * width, band.row_count * width}, samples.hull());
        if (!sum.error)
            sum.error.emplace(home().device(), home().estimate_pipeline(), sum.rows.film());
        sum.error->read(query, add);
    }
}

} // namespace pt
