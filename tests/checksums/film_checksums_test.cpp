// tests/data/film_checksums.txt may change only if radiance was meant to change.
#include "cli/scene/scene.h"
#include "lib/base/digest.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/data_folder.h"
#include "tests/support/shared_context.h"

#include <pt/film.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr std::uint32_t width = 27;
constexpr std::uint32_t height = 20;
constexpr std::uint32_t tile_count = 4 * 3;
constexpr std::uint32_t most_of_tile = 13;

std::string hexadecimal(std::uint64_t number) {
    std::ostringstream text;
    text << std::hex << number;
    return text.str();
}

std::string checksum_of(const std::vector<float> &values) {
    return hexadecimal(pt::checksum(std::as_bytes(std::span(values))));
}

std::string checksum_of_sums(const std::vector<char> &film) {
    const std::size_t first = std::string_view(film.data(), film.size()).find("\ntile ");
    return hexadecimal(pt::checksum(std::as_bytes(std::span(film).first(film.size() - 8).subspan(first))));
}

class FilmChecksums : public ContextFixture {
protected:
    static void take(pt_context *on, std::uint32_t samples, const std::vector<std::uint32_t> &by_tile = {}) {
        pt_accumulate_info info{};
        info.struct_size = sizeof info;
        info.sample_count = samples;
        info.tile_samples = by_tile.empty() ? nullptr : by_tile.data();
        info.tile_count = static_cast<std::uint32_t>(by_tile.size());
        ASSERT_EQ(pt_accumulate(on, &info), PT_OK) << pt_last_error(on);
    }

    static std::string checksums(pt_context *on, const cli::SceneFile &file, std::uint32_t sampler) {
        pt_render render = render_of(width, height, std::min(file.render.max_path_length, 4U));
        render.sampler = sampler;
        set_picture(on, file.scene(), file.camera, render);
        take(on, 5);
        take(on, 35);
        const std::string found = checksum_of_sums(film_of(on)) + ' ' +
                                  checksum_of(values_of(on, std::size_t{width} * height)) + ' ' +
                                  checksum_of(values_of(on, std::size_t{width} * height, PT_QUANTITY_STANDARD_ERROR));
        std::vector<std::uint32_t> by_tile(tile_count);
        for (std::uint32_t tile = 0; tile < tile_count; ++tile)
            by_tile[tile] = tile * 7 % most_of_tile;
        take(on, most_of_tile, by_tile);
        take(on, 30);
        return found + ' ' + checksum_of_sums(film_of(on));
    }

    Context shared(std::uint32_t devices, std::uint32_t submit_milliseconds, bool like_gpus) {
        return create_context([&](pt_create_info &info) { info.submit_milliseconds = submit_milliseconds; },
                              shared_by(devices, like_gpus));
    }

    std::string device_name() const {
        pt_device_info info{};
        EXPECT_EQ(pt_get_context_device(context(), &info), PT_OK);
        return std::string(info.name) + ", " + info.driver;
    }
};

std::vector<std::string> lines_of(const std::string &device) {
    std::ifstream file(data_folder() + "/film_checksums.txt");
    std::vector<std::string> lines;
    bool is_of_device = false;
    for (std::string line; std::getline(file, line);)
        if (constexpr std::string_view start = "device "; line.starts_with(start))
            is_of_device = line.substr(start.size()) == device;
        else if (is_of_device)
            lines.push_back(line);
    return lines;
}

// A line of the file names a scene and a sampler. Each line is rendered with one context, or with
// PT_TEST_MANY with every context.
TEST_F(FilmChecksums, AreThoseOfBefore) {
    const std::vector<std::string> expected = lines_of(device_name());
    if (expected.empty())
        GTEST_SKIP() << "no checksums of " << device_name() << ": other devices round otherwise";
    const std::map<std::string, std::uint32_t> samplers{{"random", PT_SAMPLER_RANDOM},
                                                        {"halton", PT_SAMPLER_HALTON},
                                                        {"halton-cp", PT_SAMPLER_HALTON_CP},
                                                        {"sobol", PT_SAMPLER_SOBOL}};
    const Context ways[] = {shared(1, 50, false), shared(1, 50, true), shared(2, 1, false)};
    std::set<std::string> named;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        std::istringstream line(expected[i]);
        std::string scene;
        std::string sampler;
        line >> scene >> sampler;
        ASSERT_TRUE(samplers.contains(sampler)) << expected[i];
        named.insert(scene + ".json");
        const cli::SceneFile file = cli::read_scene_file(PT_SCENES_DIRECTORY "/" + scene + ".json");
        for (std::size_t way = 0; way < std::size(ways); ++way) {
            if (way != i % std::size(ways) && !std::getenv("PT_TEST_MANY"))
                continue;
            EXPECT_EQ(scene + ' ' + sampler + ' ' + checksums(ways[way].get(), file, samplers.at(sampler)), expected[i])
                << "way " << way;
        }
    }
    for (const auto &entry : std::filesystem::directory_iterator(PT_SCENES_DIRECTORY))
        if (entry.path().extension() == ".json") {
            EXPECT_TRUE(named.contains(entry.path().filename().string())) << entry.path() << " has no checksums";
        }
}

} // namespace
