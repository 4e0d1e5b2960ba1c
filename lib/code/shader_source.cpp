#include "lib/code/shader_source.h"

#include "accuracy.spv.h"
#include "add.spv.h"
#include "estimate.spv.h"
#include "first_hit.spv.h"
#include "fold.spv.h"
#include "lib/base/digest.h"
#include "lib/base/error.h"
#include "lib/glsl_module/glsl_module.h"
#include "lib/platform/module.h"
#include "pathtrace.spv.h"
#include "resolve.spv.h"

#include <cstddef>
#include <cstring>
#include <exception>
#include <filesystem>
#include <utility>

namespace pt {

namespace {

// Searches beside the library first, so that an installation can be moved. Then searches the system's path. The module
// stays loaded, because glslang keeps tables.
pt_compile_glsl_fn load_compiler(const std::string &shader_directory) {
    const std::filesystem::path folder = platform::folder_with(reinterpret_cast<const void *>(&load_compiler));
    const std::filesystem::path name = platform::module_file("pt-glsl");
    std::string reasons;
    for (const std::filesystem::path &path : {folder.empty() ? folder : folder / "pt" / name, name}) {
        if (path.empty())
            continue;
        if (void *const module = platform::load_module(path))
            if (void *const symbol = platform::find_function(module, PT_COMPILE_GLSL_SYMBOL))
                return reinterpret_cast<pt_compile_glsl_fn>(symbol);
        reasons += (reasons.empty() ? "" : "; ") + platform::module_error();
    }
    refuse_argument("create", "shader_dir", '"' + shader_directory + '"',
                    "the compiler's module cannot be loaded: " + reasons, PT_ERROR_UNSUPPORTED);
}

// Exceptions must not pass through the module's C code.
struct Compilation {
    std::vector<std::byte> bytes;
    std::exception_ptr error;

    static void receive(void *user, const void *bytes, std::size_t size) noexcept {
        auto *const self = static_cast<Compilation *>(user);
        try {
            self->bytes.assign(static_cast<const std::byte *>(bytes), static_cast<const std::byte *>(bytes) + size);
        } catch (...) {
            self->error = std::current_exception();
        }
    }
};

std::vector<std::uint32_t> compile(pt_compile_glsl_fn compiler, const std::string &directory, const char *name) {
    Compilation compilation;
    const std::int32_t result = compiler(directory.c_str(), name, &Compilation::receive, &compilation);
    if (compilation.error)
        std::rethrow_exception(compilation.error);
    const std::vector<std::byte> &bytes = compilation.bytes;
    if (result != 0)
        throw Error(PT_ERROR_SHADER, std::string(name) + " does not compile:\n" +
                                         std::string(reinterpret_cast<const char *>(bytes.data()), bytes.size()));
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof words[0]);
    return words;
}

KernelCode code_of(std::vector<std::vector<std::uint32_t>> words) {
    const auto kept = std::make_shared<const std::vector<std::vector<std::uint32_t>>>(std::move(words));
    const auto &of = *kept;
    return {of[0], of[1], of[2], of[3], of[4], of[5], of[6], kept};
}

} // namespace

KernelCode embedded_code() {
    static const KernelCode code = code_of({pathtrace_spirv(), fold_spirv(), add_spirv(), resolve_spirv(),
                                            estimate_spirv(), accuracy_spirv(), first_hit_spirv()});
    return code;
}

std::string digest_of(const KernelCode &code) {
    Digest digest;
    for (const auto &words : {code.pathtrace, code.fold})
        digest.add(words);
    return digest.text();
}

KernelCode ShaderSource::read() const {
    if (is_embedded())
        return embedded_code();
    const pt_compile_glsl_fn compiler = load_compiler(directory_);
    std::vector<std::vector<std::uint32_t>> compiled;
    for (const char *const name : {"pathtrace.comp", "fold.comp", "add.comp", "resolve.comp", "estimate.comp",
                                   "accuracy.comp", "first_hit.comp"})
        compiled.push_back(compile(compiler, directory_, name));
    return code_of(std::move(compiled));
}

} // namespace pt
