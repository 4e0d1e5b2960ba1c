#include "tests/fuzz/examine.h"
#include "tests/fuzz/mutation.h"

#include "lib/scene_file/scene_file.h"

#include <algorithm>
#include <random>
#include <string>

namespace {

constexpr const char *path = "scene.json";

void examine_scene(const pt::SceneFile &scene, std::span<const std::uint8_t> bytes) {
    fuzz::Input input;
    input.materials = scene.materials;
    input.spheres = scene.spheres;
    input.planes = scene.planes;
    input.camera = scene.camera;
    input.render = scene.render;
    input.render.width = std::min(scene.render.width, 8U);
    input.render.height = std::min(scene.render.height, 4U);
    input.sample_count = std::min(scene.sample_count.value_or(4), 4U);
    fuzz::examine_neighbourhood(input, bytes);
}

bool is_number_character(std::uint8_t character) {
    return (character >= '0' && character <= '9') ||
           std::string_view("+-.eE").find(static_cast<char>(character)) != std::string_view::npos;
}

std::size_t exchange_number(std::span<std::uint8_t> room, std::size_t size, std::mt19937 &random) {
    static constexpr std::string_view numbers[] = {
        "0",     "-0",   "1",     "-1",       "2",      "0.5",    "0.999999999999", "1e18",   "-1e18",
        "1e-18", "1e19", "1e-19", "1e308",    "1e309",  "5e-324", "1e-45",          "1e9",    "65536",
        "180",   "1e-6", "1e6",   "16777217", "0.0625", "1e15",   "1.5e-9",         "3.4e38", "18446744073709551616"};
    const auto text = room.first(size);
    const auto start = text.begin() + static_cast<std::ptrdiff_t>(random() % (size + 1));
    const auto begin = std::find_if(start, text.end(), is_number_character);
    const auto end = std::find_if_not(begin, text.end(), is_number_character);
    const std::string_view number = numbers[random() % std::size(numbers)];
    const std::vector<std::uint8_t> rest(end, text.end());
    const auto kept = static_cast<std::size_t>(begin - text.begin());
    if (begin == text.end() || kept + number.size() + rest.size() > room.size())
        return 0;
    const auto rest_begin = std::ranges::copy(number, begin).out;
    std::ranges::copy(rest, rest_begin);
    return kept + number.size() + rest.size();
}

} // namespace

// Most single-character changes are syntax errors.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t *data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
    std::mt19937 random(seed);
    if (random() % 2 == 0)
        if (const std::size_t new_size = exchange_number({data, max_size}, size, random))
            return new_size;
    return LLVMFuzzerMutate(data, size, max_size);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    const std::string text(data, data + size);
    try {
        const pt::SceneFile scene = pt::scene_of_text(text, path);
        const auto index = static_cast<std::int32_t>(size);
        fuzz::require(scene.explain({text, index, text, index, text, text, text}).starts_with(path),
                      "messages are led back to the file");
        examine_scene(scene, {data, size});
    } catch (const pt::Error &error) {
        fuzz::require(error.code() == PT_ERROR_INVALID_SCENE, "what is refused is the scene file's fault");
        fuzz::require(std::string_view(error.what()).starts_with(path), "messages name the file");
    }
    return 0;
}
