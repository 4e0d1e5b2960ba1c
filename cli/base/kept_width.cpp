#include "cli/base/kept_width.h"

#include "cli/base/exit_code.h"
#include "cli/base/file.h"

#include <array>
#include <fstream>
#include <span>
#include <sstream>
#include <system_error>
#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace cli {
namespace {

std::string processor() {
    std::string name;
#if defined(__x86_64__)
    for (unsigned int leaf = 0x80000002; leaf <= 0x80000004; ++leaf) {
        std::array<unsigned int, 4> words{};
        __get_cpuid(leaf, words.data(), &words[1], &words[2], &words[3]);
        name.append(reinterpret_cast<const char *>(words.data()), sizeof(words));
    }
#endif
    std::erase_if(name, [](char letter) { return letter < ' ' || letter > '~'; });
    return name;
}

} // namespace

std::optional<KeptWidth> read_width(const std::filesystem::path &file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        return std::nullopt;
    constexpr std::size_t longest_record = 1024;
    std::string text(longest_record, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    std::istringstream lines(text);
    std::string bits;
    std::string owner;
    std::string driver;
    std::getline(lines, bits);
    std::getline(lines, owner);
    std::getline(lines, driver);
    if ((bits != "256" && bits != "512") || owner != processor() || lines.eof())
        return std::nullopt;
    return KeptWidth{bits == "512" ? 512U : 256U, driver};
}

void write_width(const std::filesystem::path &file, const KeptWidth &width) {
    const std::string text = std::to_string(width.bits) + '\n' + processor() + '\n' + width.driver + '\n';
    try {
        AtomicFile written(file.string());
        written.write(std::as_bytes(std::span(text)));
        written.commit();
    } catch (const Failure &) {
        return; // measured again next time
    }
}

} // namespace cli
