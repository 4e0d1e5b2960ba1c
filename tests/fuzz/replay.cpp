// Runs a target without libFuzzer. `replay CORPUS_FOLDER COUNT` runs the corpus and COUNT reproducible mutations. A
// fatal input is saved as ./failed-input.
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

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

// Half of the new bytes are copies, because texts refuse most others.
Bytes changed(Bytes input, std::mt19937 &random) {
    for (std::uint32_t changes = 1 + random() % 4; changes > 0 && !input.empty(); --changes) {
        const auto place = input.begin() + static_cast<std::ptrdiff_t>(random() % input.size());
        const std::uint8_t byte =
            random() % 2 == 0 ? input[random() % input.size()] : static_cast<std::uint8_t>(random());
        const std::uint32_t kind = random() % 4;
        if (kind == 0)
            input.insert(place, byte);
        else if (kind == 1)
            input.erase(place);
        else
            *place = byte;
    }
    return input;
}

} // namespace

int main(int argument_count, char **arguments) {
    if (argument_count != 3) {
        std::fputs("usage: CORPUS_FOLDER COUNT\n", stderr);
        return 2;
    }
    const unsigned long count = std::strtoul(arguments[2], nullptr, 10);
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL})
        std::signal(signal, save_present_input);
    const std::vector<Bytes> corpus = read_corpus(arguments[1]);
    if (corpus.empty()) {
        std::fputs("the corpus is empty\n", stderr);
        return 1;
    }
    for (const Bytes &input : corpus)
        run(input);
    std::mt19937 random;
    for (unsigned long i = 0; i < count; ++i)
        run(changed(corpus[random() % corpus.size()], random));
    std::printf("%zu files and %lu changes of them\n", corpus.size(), count);
}
