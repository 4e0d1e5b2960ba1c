// Files of films: the bytes of pt/film.h in a frame of zstd, or as they are.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace cli {

// Packs the bytes and writes them to a file that appears whole or not at all. Throws Failure(ExitCode::file).
void write_film_file(const std::string &path, std::span<const std::byte> film);

// The bytes of a film, packed or not; whether they are a film is for the library to say. Throws Failure:
// ExitCode::file if the file cannot be read, ExitCode::usage if it was packed and is damaged or cut short.
std::vector<std::byte> read_film_file(const std::string &path);

} // namespace cli
