#include "lib/glsl_module/glsl_module.h"

#include "lib/platform/input_file.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <spirv-tools/libspirv.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace pt::glsl {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::uint32_t>;

// Throws std::runtime_error with the reason.
std::string read_source(const fs::path &path) {
    std::string text;
    try {
        text = platform::InputFile(path).text();
    } catch (const platform::InputError &error) {
        throw std::runtime_error(path.string() + ": " + error.what());
    }
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (text.starts_with(byte_order_mark))
        text.erase(0, byte_order_mark.size());
    return text;
}

class Includer : public glslang::TShader::Includer {
public:
    Includer(fs::path directory, const fs::path &main_file) :
        directory_(std::move(directory)),
        open_files_{main_file} {}

    IncludeResult *includeLocal(const char *name, const char *including_file, std::size_t /*depth*/) override {
        if (is_endless_)
            return refuse("not read after this error");
        const fs::path path = find(name, including_file).lexically_normal();
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

    // Called for #include <name>, and if includeLocal has found no file. A result with an empty
    // name is a failure, and its text is the reason.
    IncludeResult *includeSystem(const char * /*name*/, const char * /*file*/, std::size_t /*depth*/) override {
        const std::string reason = std::exchange(reason_, "");
        return hand_over(
            "", std::make_unique<std::string>(reason.empty() ? "only #include \"name\" is supported" : reason));
    }

    void releaseInclude(IncludeResult *result) override {
        if (!result)
            return;
        if (!result->headerName.empty())
            open_files_.pop_back();
        delete static_cast<std::string *>(result->userData);
        delete result;
    }

private:
    // A file with an include guard may include itself, and is then open twice.
    static constexpr std::ptrdiff_t most_open_times = 2;

    // glslang uses the text until it calls releaseInclude.
    static IncludeResult *hand_over(const std::string &name, std::unique_ptr<std::string> text) {
        auto *const result = new IncludeResult(name, text->data(), text->size(), text.get());
        static_cast<void>(text.release()); // the result's user data owns the text
        return result;
    }

    fs::path find(const char *name, const char *including_file) const {
        const fs::path beside = fs::path(including_file).parent_path() / name;
        std::error_code ignored;
        return fs::exists(beside, ignored) ? beside : directory_ / name;
    }

    IncludeResult *refuse(const std::string &reason) {
        reason_ = reason;
        return nullptr;
    }

    fs::path directory_;
    std::vector<fs::path> open_files_; // each one includes the next
    std::string reason_;               // why the last #include was refused
    bool is_endless_ = false;          // every further #include is refused
};

// The rules of glslangValidator -V. All errors are reported, because glslang misreads the next directive if it stops
// within an included file.
constexpr auto rules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules | EShMsgCascadingErrors);

std::string trimmed(std::string log) {
    log.erase(log.find_last_not_of('\n') + 1);
    return log;
}

// glslang's tables of built-in functions stay, because making them takes most of the first compilation's time.
void start_glslang() {
    static const bool started = glslang::InitializeProcess();
    if (!started)
        throw std::runtime_error("glslang does not start");
}

// Uses the options of PtShaders.cmake, so that the words equal those embedded by the build.
Words spirv_of(const fs::path &path, const fs::path &directory) {
    const std::string name = path.string();
    const std::string text = read_source(path);
    const char *const texts[] = {text.data()};
    const int lengths[] = {static_cast<int>(text.size())};
    const char *const names[] = {name.c_str()};
    constexpr int vulkan_glsl = 100; // version of GL_KHR_vulkan_glsl
    constexpr int default_version = 100;

    glslang::TShader shader(EShLangCompute);
    shader.setStringsWithLengthsAndNames(texts, lengths, names, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, vulkan_glsl);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
    Includer includer(directory, path);
    if (!shader.parse(GetDefaultResources(), default_version, false, rules, includer))
        throw std::runtime_error(trimmed(shader.getInfoLog()));

    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(rules) || !program.mapIO())
        throw std::runtime_error(name + ": " + trimmed(program.getInfoLog()));

    Words words;
    glslang::SpvOptions options;
    options.stripDebugInfo = true;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), words, &options);
    return words;
}

// Needed, because drivers do not validate SPIR-V.
void validate(const Words &words, const fs::path &path) {
    std::string log;
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2);
    tools.SetMessageConsumer([&](spv_message_level_t, const char *, const spv_position_t &, const char *message) {
        log += '\n';
        log += path.string() + ": " + message;
    });
    if (!tools.Validate(words))
        throw std::runtime_error(path.string() + ": the SPIR-V is not valid" + log);
}

Words compile(const fs::path &directory, const char *name) {
    static std::mutex one_at_a_time; // glslang's tables are global
    const std::lock_guard lock(one_at_a_time);
    start_glslang();
    const fs::path path = directory / name;
    Words words = spirv_of(path, directory);
    validate(words, path);
    return words;
}

} // namespace

} // namespace pt::glsl

extern "C" PT_API int32_t pt_glsl_compile(const char *directory, const char *name, pt_glsl_receive_fn receive,
                                          void *user) {
    std::string_view log = "an exception of unknown type";
    try {
        const pt::glsl::Words compiled = pt::glsl::compile(platform::path_of(directory), name);
        receive(user, compiled.data(), compiled.size() * sizeof compiled[0]);
        return 0;
    } catch (const std::exception &error) {
        log = error.what();
        receive(user, log.data(), log.size());
    } catch (...) {
        receive(user, log.data(), log.size());
    }
    return -1;
}
