// One pt_film, whose failures are thrown as Failure.
#pragma once

#include <pt/film.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cli {

class FilmHandle {
public:
    // path: what the film is called in messages.
    FilmHandle(const std::string &path, std::span<const std::byte> bytes);
    FilmHandle(const FilmHandle &) = delete;
    FilmHandle &operator=(const FilmHandle &) = delete;
    ~FilmHandle() { pt_close_film(film_); }

    // Throws Failure(ExitCode::usage) with a line for each way in which it does not belong.
    void merge(const std::string &path, std::span<const std::byte> bytes);

    pt_film_info info() const;
    pt_stats stats() const;
    std::vector<pt_film_tile> tiles() const;
    std::vector<pt_sample_range> ranges(std::uint32_t tile) const;

    // Of the film's rectangle, three components to a pixel. quantity: PT_QUANTITY_*.
    std::vector<float> read_image(std::uint32_t quantity) const;

    std::vector<std::byte> bytes() const;

private:
    pt_film *film_ = nullptr;
};

} // namespace cli
