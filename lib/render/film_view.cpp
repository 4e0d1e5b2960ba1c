#include "lib/render/film_view.h"

#include <algorithm>

namespace pt {

namespace {

// 56 MiB, much less than a large film.
constexpr std::uint32_t most_band_pixels = 1U << 19;

} // namespace

std::vector<DeviceFilm *> FilmView::films(const RenderDevices &devices) {
    std::vector<DeviceFilm *> films;
    for (const auto &device : devices)
        films.push_back(&device->film());
    return films;
}

std::vector<FilmView::Band> FilmView::bands() const {
    const TileGrid grid = home().film().grid();
    const std::uint32_t most = std::max<std::uint32_t>(most_band_pixels / gpu::TILE_SIZE / grid.width, 1);
    const std::uint32_t band_count = (grid.rows() + most - 1) / most;
    const std::uint32_t rows_of_band = (grid.rows() + band_count - 1) / band_count * gpu::TILE_SIZE;
    std::vector<Band> bands;
    for (std::uint32_t row = 0; row < grid.height; row += bands.back().row_count)
        bands.push_back({row, std::min(rows_of_band, grid.height - row)});
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

void FilmView::read(const Image &image, const ImageQuery &query, const TileSamples &samples) {
    if (!home().device().policy().resolve_on_device) {
        read_on_host(image, query, samples);
        return;
    }
    ImageRows rows(image);
    const auto put = [&](std::span<const std::byte> pixels) { rows.put(pixels); };
    if (is_one_film()) {
        home().resolve_to_host().read(query, put);
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
        sum.rows.gather(band.first_row, {first * width, (end - first) * width});
        ImageQuery in_band = query;
        in_band.pixels.y = first - band.first_row;
        in_band.pixels.height = end - first;
        sum.image.read(in_band, put);
    }
}

std::optional<std::span<std::byte>> FilmView::map(const ImageQuery &query) {
    if (!home().device().policy().resolve_on_device || !is_one_film())
        return std::nullopt;
    return home().resolve_to_host().map(query);
}

void FilmView::read_on_host(const Image &image, const ImageQuery &query, const TileSamples &samples) const {
    ImageRows rows(image);
    const std::uint32_t width = home().film().width();
    const PixelRange range{query.pixels.y * width, query.pixels.height * width};
    std::uint64_t first = range.first;
    read_films(films(devices_), samples, range, piece_pixels, [&](const PixelSums &sums) {
        rows.put_part(first, width, sums.values(query.quantity, query.unit));
        first += sums.pixel_count();
    });
}

bool FilmView::reads_on_device() const {
    return home().device().policy().resolve_on_device && home().film().has_whole_tiles();
}

void FilmView::estimate(ErrorEstimator &estimator, const ErrorQuery &query, bool is_recorded) {
    const auto add = [&](const TileErrors &tiles) { estimator.add(tiles); };
    if (!reads_on_device())
        estimate_on_host(query, add);
    else if (!is_one_film())
        estimate_bands(query, add);
    else if (is_recorded)
        home().error_reader().collect(query, add);
    else
        home().error_reader().read(query, add);
}

void FilmView::estimate_on_host(const ErrorQuery &query, const ErrorReader::Receive &receive) {
    const auto read = [this, &query](std::uint32_t first_row, PixelSums &rows) {
        read_films(films(devices_), query.samples, first_row * query.samples.grid().width, rows);
    };
    const std::span<const TileErrors> tiles = errors_.of(query.samples, query.unit, read);
    std::ranges::for_each(tiles, receive);
    if (!query.by_tile.empty())
        std::ranges::transform(tiles, query.by_tile.begin(), &TileErrors::own_square);
}

void FilmView::estimate_bands(const ErrorQuery &query, const ErrorReader::Receive &receive) {
    films(devices_);
    const TileGrid &grid = query.samples.grid();
    for (const Band &band : bands()) {
        Sum &sum = this->sum(band.row_count);
        sum.rows.gather(band.first_row, {band.first_row * grid.width, band.row_count * grid.width});
        if (!sum.error)
            sum.error.emplace(home().device(), home().estimate_pipeline(), sum.rows.film());
        const TileSamples samples = query.samples.rows(band.first_row, band.row_count);
        std::span<double> by_tile = query.by_tile;
        if (!by_tile.empty())
            by_tile = by_tile.subspan(grid.tile_at(0, band.first_row), samples.grid().count());
        sum.error->read({query.unit, samples, by_tile}, receive);
    }
}

} // namespace pt
