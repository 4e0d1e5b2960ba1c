// An accepted film must be written as the same bytes.
#include "tests/fuzz/film_input.h"
#include "tests/fuzz/require.h"

#include "lib/base/error.h"
#include "lib/film/film_bytes.h"

#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    const std::vector<std::byte> bytes = fuzz::film_input({}, std::as_bytes(std::span(data, size)));
    try {
        const pt::FilmReader film(bytes);
        std::vector<std::byte> written(pt::FilmLayout(film.header()).size_bytes());
        pt::FilmWriter writer(film.header(), written);
        for (std::size_t tile = 0; tile < film.header().tiles.size(); ++tile) {
            pt::PixelSums sums;
            sums.resize(film.header().tiles[tile].pixels.pixel_count());
            film.read(tile, 0, sums);
            writer.write(tile, 0, sums);
        }
        writer.end();
        fuzz::require(written == bytes, "what is accepted is written back to the same bytes");
    } catch (const pt::Error &error) {
        fuzz::require(error.code() == PT_ERROR_INCOMPATIBLE, "what is refused is no film");
        fuzz::require(std::string_view(error.what()).starts_with("film"), "messages say what they are about");
    }
    return 0;
}
