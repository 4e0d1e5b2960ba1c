#include "tests/fuzz/examine.h"
#include "tests/fuzz/mutation.h"

#include <pt/scene_file.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>

namespace {

constexpr const char *path = "scene.json";

template <typename Struct>
Struct sized() {
    Struct value{};
    value.struct_size = sizeof value;
    return value;
}

struct Close {
    void operator()(pt_scene_file *file) const { pt_close_scene_file(file); }
};
using File = std::unique_ptr<pt_scene_file, Close>;

void examine_scene(const pt_scene_file *file, std::span<const std::uint8_t> bytes) {
    auto scene = sized<pt_scene>();
    auto film = sized<pt_scene_film>();
    fuzz::Input input;
    input.camera = sized<pt_camera>();
    input.render = sized<pt_render>();
    fuzz::require(pt_get_scene_file(file, &scene, &input.camera, &input.render, &film) == PT_OK, "a file gives all");
    input.materials.assign(scene.materials, scene.materials + scene.material_count);
    input.spheres.assign(scene.spheres, scene.spheres + scene.sphere_count);
    input.planes.assign(scene.planes, scene.planes + scene.plane_count);
    input.render.width = std::min(input.render.width, 8U);
    input.render.height = std::min(input.render.height, 4U);
    input.sample_count = std::min(film.sample_count == 0 ? 4 : film.sample_count, 4U);
    fuzz::examine_neighbourhood(input, bytes);
}

void examine_rule(pt_scene_file *file, const std::string &text) {
    auto rule = sized<pt_broken_rule>();
    rule.index = rule.component = static_cast<std::int32_t>(text.size());
    rule.subject = rule.member = rule.with = rule.value = rule.rule = text.c_str();
    auto source = sized<pt_rule_source>();
    fuzz::require(pt_find_rule_source(file, &rule, &source) == PT_OK, "every rule has a message");
    fuzz::require(std::string_view(source.message).starts_with(path), "messages are led back to the file");
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
    auto info = sized<pt_scene_file_info>();
    info.path = path;
    info.text = text.c_str();
    info.text_bytes = text.size();
    pt_scene_file *opened = nullptr;
    const pt_result result = pt_open_scene_file(&info, &opened);
    const File file(opened);
    if (result == PT_OK) {
        examine_rule(file.get(), text);
        examine_scene(file.get(), {data, size});
        return 0;
    }
    fuzz::require(result == PT_ERROR_INVALID_SCENE || result == PT_ERROR_FILE, "what is refused is the files' fault");
    fuzz::require(opened == nullptr && std::string_view(pt_last_scene_error()).starts_with(path),
                  "messages name the file");
    return 0;
}
