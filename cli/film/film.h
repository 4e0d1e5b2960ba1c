#pragma once

#include "cli/base/context.h"

#include <pt/film.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cli {

class FilmHandle {
public:
    FilmHandle(const std::string &path, std::span<const std::byte> bytes);
    FilmHandle(const FilmHandle &) = delete;
    FilmHandle &operator=(const FilmHandle &) = delete;
    ~FilmHandle() { pt_close_film(film_); }

    // Throws Failure(ExitCode::usage) if the film does not fit, with a line for each difference.
    void merge(const std::string &path, std::span<const std::byte> bytes);

    pt_film_info info() const;
    pt_stats stats() const;
    pt_error_estimate error_estimate() const;
    std::vector<pt_sample_range> ranges(std::uint32_t tile) const;
    pt_sample_range hull() const;

    // Throws Failure(ExitCode::usage) unless the films differ only in seed, kernel, estimator version or device.
    void require_same_picture(const std::string &path, std::span<const std::byte> bytes);

    std::vector<float> read_image(std::uint32_t quantity) const;

    std::vector<std::byte> bytes() const;

private:
    pt_film *film_ = nullptr;
};

// Needs at least one sample. Reuses the memory of `bytes`.
void save_film(const Context &context, std::vector<std::byte> &bytes);

void add_film(const Context &context, const std::string &path, std::span<const std::byte> bytes);

std::string ranges_text(const std::vector<pt_sample_range> &ranges);

std::uint64_t sample_count_of(const std::vector<pt_sample_range> &ranges);

// Returns the part of `wanted` outside the ascending ranges `there`.
std::vector<pt_sample_range> missing_of(const pt_sample_range &wanted, const std::vector<pt_sample_range> &there);

// Packs the film and writes it atomically. Throws Failure(ExitCode::file).
void write_film_file(const std::string &path, std::span<const std::byte> film);

// The film is unpacked, but not checked. Throws Failure: ExitCode::file for an unreadable file, ExitCode::usage for
// damaged packing.
std::vector<std::byte> read_film_file(const std::string &path);

} // namespace cli
