#include "lib/glsl_module/includer.h"

#include "lib/platform/file.h"

#include <algorithm>
#include <cerrno>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

namespace pt::glsl {

namespace {

// A file that includes itself, perhaps by way of others, is fine if it has an include guard: it is then open twice.
constexpr std::ptrdiff_t most_open_times = 2;

// glslang refers to the text until it calls releaseInclude.
glslang::TShader::Includer::IncludeResult *hand_over(const std::string &name, std::unique_ptr<std::string> text) {
    auto *const result = new glslang::TShader::Includer::IncludeResult(name, text->data(), text->size(), text.get());
    static_cast<void>(text.release()); // the result's user data owns it
    return result;
}

} // namespace

std::string read_source(const std::filesystem::path &path) {
    const auto fail = [&] { throw std::runtime_error(path.string() + ": " + std::generic_category().message(errno)); };
    const platform::FileDescriptor file(platform::open_to_read(path));
    if (!file.is_open())
        fail();
    std::string text;
    char block[4096];
    for (std::ptrdiff_t count = 1; count > 0;) {
        count = platform::read_some(file.get(), block);
        if (count < 0)
            fail(); // for example because it is a directory
        text.append(block, static_cast<std::size_t>(count));
    }
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; // of UTF-8, which editors may add
    if (text.starts_with(byte_order_mark))
        text.erase(0, byte_order_mark.size());
    return text;
}

std::filesystem::path Includer::find(const char *name, const char *including_file) const {
    const std::filesystem::path beside = std::filesystem::path(including_file).parent_path() / name;
    std::error_code ignored;
    return std::filesystem::exists(beside, ignored) ? beside : directory_ / name;
}

glslang::TShader::Includer::IncludeResult *Includer::refuse(const std::string &reason) {
    reason_ = reason;
    return nullptr;
}

glslang::TShader::Includer::IncludeResult *Includer::includeLocal(const char *name, const char *including_file,
                                                                  std::size_t /*depth*/) {
    if (is_endless_)
        return refuse("not read after that");
    const std::filesystem::path path = find(name, including_file).lexically_normal();
    is_endless_ = std::ranges::count(open_files_, path) >= most_open_times;
    if (is_endless_)
        return refuse("the file includes itself, without an include guard");
    try {
        auto text = std::make_unique<std::string>(read_source(path));
        open_files_.push_back(path);
        return hand_over(path.string(), std::move(text));
    } catch (const std::runtime_error &error) {
        return refuse(error.what());
    }
}

// For glslang, an empty name means that there is no file; the text says why.
glslang::TShader::Includer::IncludeResult *
Includer::includeSystem(const char * /*name*/, const char * /*including_file*/, std::size_t /*depth*/) {
    const std::string reason = std::exchange(reason_, "");
    auto kept = std::make_unique<std::string>(reason.empty() ? "only #include \"name\" is known" : reason);
    return hand_over("", std::move(kept));
}

void Includer::releaseInclude(IncludeResult *result) {
    if (!result)
        return;
    if (!result->headerName.empty())
        open_files_.pop_back();
    delete static_cast<std::string *>(result->userData);
    delete result;
}

} // namespace pt::glsl
