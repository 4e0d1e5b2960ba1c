// Films: one pt_film and that of a context, whose failures are thrown as Failure, and their samples as text.
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
    // path: the name of the film in messages.
    FilmHandle(const std::string &path, std::span<const std::byte> bytes);
    FilmHandle(const FilmHandle &) = delete;
    FilmHandle &operator=(const FilmHandle &) = delete;
    ~FilmHandle() { pt_close_film(film_); }

    // Throws Failure(ExitCode::usage) with a line for each way in which it does not belong.
    void merge(const std::string &path, std::span<const std::byte> bytes);

    pt_film_info info() const;
    pt_stats stats() const;
    pt_error_estimate error_estimate() const;
    std::vector<pt_sample_range> ranges(std::uint32_t tile) const;
    pt_sample_range hull() const; // from the first to the last sample of any pixel

    // Throws Failure(ExitCode::usage), with a line for each difference, unless a film of another seed is of the same
    // picture in all that does not just decide bits.
    void require_same_picture(const std::string &path, std::span<const std::byte> bytes);

    // The image of the film's rectangle, three components for each pixel. quantity: PT_QUANTITY_*.
    std::vector<float> read_image(std::uint32_t quantity) const;

    std::vector<std::byte> bytes() const;

private:
    pt_film *film_ = nullptr;
};

// The film of the samples so far, at least one. bytes: memory to be reused.
void save_film(const Context &context, std::vector<std::byte> &bytes);

// Adds a film to the samples of the context. path: what it is called in messages. Throws Failure(ExitCode::usage) with
// a line for each way in which it does not belong.
void add_film(const Context &context, const std::string &path, std::span<const std::byte> bytes);

// "[0, 64), [128, 256)"; "none" of none.
std::string ranges_text(const std::vector<pt_sample_range> &ranges);

// How many samples these ranges have.
std::uint64_t sample_count_of(const std::vector<pt_sample_range> &ranges);

// The samples of a range that the others, which ascend, do not have.
std::vector<pt_sample_range> missing_of(const pt_sample_range &wanted, const std::vector<pt_sample_range> &there);

// Packs the bytes and writes them to a file that appears whole or not at all. Throws Failure(ExitCode::file).
void write_film_file(const std::string &path, std::span<const std::byte> film);

// The bytes of a film, packed or not; whether they are a film is for the library to say. Throws Failure:
// ExitCode::file if the file cannot be read, ExitCode::usage if it was packed and is damaged or cut short.
std::vector<std::byte> read_film_file(const std::string &path);

} // namespace cli
