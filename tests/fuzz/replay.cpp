// Runs a target without libFuzzer. `replay CORPUS_FOLDER COUNT` runs the corpus and COUNT reproducible mutations. A
// fatal input is saved as ./failed-input.
#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t max_size = 4096;

std::mt19937 mutation_random;

// Read by the signal handler.
const Bytes *present_input = nullptr;

extern "C" void save_present_input(int signal) {
    const int file = open("failed-input", O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file >= 0 && present_input && write(file, present_input->data(), present_input->size()) >= 0)
        close(file);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

std::vector<Bytes> read_corpus(const char *folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto &entry : std::filesystem::directory_iterator(folder))
        paths.push_back(entry.path());
    std::ranges::sort(paths);
    std::vector<Bytes> corpus;
    for (const std::filesystem::path &path : paths) {
        std::ifstream file(path, std::ios::binary);
        corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    return corpus;
}

void run(const Bytes &input) {
    present_input = &input;
    LLVMFuzzerTestOneInput(input.data(), input.size());
}

Bytes mutated(const std::vector<Bytes> &corpus) {
    Bytes input = corpus[mutation_random() % corpus.size()];
    std::size_t size = std::min(input.size(), max_size);
    input.resize(max_size);
    const auto mutate = [&](unsigned int seed) {
        return LLVMFuzzerCustomMutator ? LLVMFuzzerCustomMutator(input.data(), size, max_size, seed)
                                       : LLVMFuzzerMutate(input.data(), size, max_size);
    };
    for (std::uint32_t changes = 1 + mutation_random() % 8; changes > 0; --changes)
        size = mutate(static_cast<unsigned int>(mutation_random()));
    input.resize(size);
    return input;
}

} // namespace

std::size_t LLVMFuzzerMutate(std::uint8_t *data, std::size_t size, std::size_t max_size) {
    const std::size_t place = mutation_random() % (size + 1);
    const auto byte = static_cast<std::uint8_t>(mutation_random());
    switch (mutation_random() % 4) {
    case 0:
        if (place == size)
            return size;
        std::copy(data + place + 1, data + size, data + place);
        return size - 1;
    case 1:
        if (size == max_size)
            return size;
        std::copy_backward(data + place, data + size, data + size + 1);
        data[place] = byte;
        return size + 1;
    default:
        if (place < size)
            data[place] = byte;
        return size;
    }
}

int main(int argument_count, char **arguments) {
    std::uint32_t count = 0;
    const std::string_view count_text = argument_count == 3 ? arguments[2] : "";
    if (std::from_chars(count_text.data(), count_text.data() + count_text.size(), count).ec != std::errc{}) {
        std::fputs("usage: CORPUS_FOLDER COUNT\n", stderr);
        return 2;
    }
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL})
        std::signal(signal, save_present_input);
    const std::vector<Bytes> corpus = read_corpus(arguments[1]);
    if (corpus.empty()) {
        std::fputs("the corpus is empty\n", stderr);
        return 1;
    }
    for (const Bytes &input : corpus)
        run(input);
    for (std::uint32_t i = 0; i < count; ++i)
        run(mutated(corpus));
    std::printf("%zu files and %u changes of them\n", corpus.size(), count);
}
