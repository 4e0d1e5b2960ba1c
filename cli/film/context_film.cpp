#include "cli/film/context_film.h"

#include "cli/film/film_words.h"

#include <pt/film.h>

namespace cli {

void save_film(const Context &context, std::vector<std::byte> &bytes) {
    std::uint64_t size = 0;
    context.require(pt_save_film(context.get(), nullptr, &size));
    bytes.resize(size);
    context.require(pt_save_film(context.get(), bytes.data(), &size));
}

std::vector<std::byte> saved_film(const Context &context) {
    std::vector<std::byte> bytes;
    save_film(context, bytes);
    return bytes;
}

void add_film(const Context &context, const std::string &path, std::span<const std::byte> bytes) {
    const pt_result result = pt_add_film(context.get(), bytes.data(), bytes.size());
    if (result < 0)
        throw Failure(exit_code_of(result), film_words(path, context.last_error()));
}

} // namespace cli
