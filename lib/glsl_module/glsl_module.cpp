// The module that compiles GLSL to SPIR-V with glslang; glsl_module.h says why it is one.
#include "lib/glsl_module/glsl_module.h"

#include "lib/glsl_module/includer.h"
#include "lib/platform/file.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <spirv-tools/libspirv.hpp>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pt::glsl {

namespace {

using Words = std::vector<std::uint32_t>;

// The rules of glslangValidator -V; and going on after an error, so that all errors are reported at once. If glslang
// stopped within an included file, it would take the next directive for another error.
constexpr auto rules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules | EShMsgCascadingErrors);

// glslang's log ends with empty lines.
std::string trimmed(std::string log) {
    log.erase(log.find_last_not_of('\n') + 1);
    return log;
}

// Never undone: making the tables of built-in functions takes most of the time of the first compilation.
void start_glslang() {
    static const bool started = glslang::InitializeProcess();
    if (!started)
        throw std::runtime_error("glslang does not start");
}

// The options are those of the command in PtShaders.cmake, so that the words equal the embedded ones.
Words spirv_of(const std::filesystem::path &path, const std::filesystem::path &directory) {
    const std::string name = path.string();
    const std::string text = read_source(path);
    const char *const texts[] = {text.data()};
    const int lengths[] = {static_cast<int>(text.size())};
    const char *const names[] = {name.c_str()};
    constexpr int vulkan_glsl = 100; // version of the dialect GL_KHR_vulkan_glsl
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

// Validates as the build does: drivers do not check the SPIR-V that they are given.
void validate(const Words &words, const std::filesystem::path &path) {
    std::string log;
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2);
    tools.SetMessageConsumer([&](spv_message_level_t, const char *, const spv_position_t &, const char *message) {
        log += '\n';
        log += path.string() + ": " + message;
    });
    if (!tools.Validate(words))
        throw std::runtime_error(path.string() + ": the SPIR-V is not valid" + log);
}

Words compile(const std::filesystem::path &directory, const char *name) {
    static std::mutex one_at_a_time; // glslang's memory pools belong to threads, its tables to the process
    const std::lock_guard lock(one_at_a_time);
    start_glslang();
    const std::filesystem::path path = directory / name;
    Words words = spirv_of(path, directory);
    validate(words, path);
    return words;
}

} // namespace

} // namespace pt::glsl

extern "C" PT_API int32_t pt_compile_glsl(const char *directory, const char *name, pt_glsl_words_fn words,
                                          pt_glsl_log_fn log, void *user) {
    try {
        const pt::glsl::Words compiled = pt::glsl::compile(platform::path_of(directory), name);
        words(user, compiled.data(), compiled.size());
        return 0;
    } catch (const std::exception &error) {
        const std::string_view text = error.what();
        log(user, text.data(), text.size());
    } catch (...) {
        constexpr std::string_view text = "an exception of unknown type";
        log(user, text.data(), text.size());
    }
    return -1;
}
