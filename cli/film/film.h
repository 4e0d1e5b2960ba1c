// Films, as pt_film or in a context, with failures thrown as Failure, and their samples as text.
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
    // path: for messages.
    FilmHandle(const std::string &path, std::span<const std::byte> bytes);
    FilmHandle(const FilmHandle &) = delete;
    FilmHandle &operator=(const FilmHandle &) = delete;
    ~FilmHandle() { pt_close_film(film_); }

    // Throws Failure(ExitCode::usage) with a line for each reason why it does not belong.
    void merge(const std::string &path, std::span<const std::byte> bytes);

    pt_film_info info() const;
    pt_stats stats() const;
    pt_error_estimate error_estimate() const;
    std::vector<pt_sample_range> ranges(std::uint32_t tile) const;
    pt_sample_range hull() const; // hull of all pixels' samples

    // Throws Failure(ExitCode::usage), with a line for each difference, unless the films differ only in seed and in
    // facts that merely decide bits.
    void require_same_picture(const std::string &path, std::span<const std::byte> bytes);

    // The film's rectangle, three components a pixel. quantity: PT_QUANTITY_*.
    std::vector<float> read_image(std::uint32_t quantity) const;

    std::vector<std::byte> bytes() const;

private:
    pt_film *film_ = nullptr;
};

// The film of the samples so far, at least one. bytes: reused memory.
void save_film(const Context &context, std::vector<std::byte> &bytes);

// Adds a film to the context's samples. path: for messages. Throws Failure(ExitCode::usage) with a line for each reason
// why it does not belong.
void add_film(const Context &context, const std::string &path, std::span<const std::byte> bytes);

// "[0, 64), [128, 256)", or "none".
std::string ranges_text(const std::vector<pt_sample_range> &ranges);

std::uint64_t sample_count_of(const std::vector<pt_sample_range> &ranges);

// The samples of `wanted` that are not in `there`, which ascends.
std::vector<pt_sample_range> missing_of(const pt_sample_range &wanted, const std::vector<pt_sample_range> &there);

// Packs the bytes into a file that appears whole or not at all. Throws Failure(ExitCode::file).
void write_film_file(const std::string &path, std::span<const std::byte> film);

// The bytes of a film file, unpacked; the library checks that they are a film. Throws Failure: ExitCode::file if the
// file cannot be read, ExitCode::usage if it was packed and is damaged or cut short.
std::vector<std::byte> read_film_file(const std::string &path);

} // namespace cli
