#include "cli/base/common_options.h"

#include "cli/base/number.h"
#include "cli/base/text.h"

#include <utility>

namespace cli {
namespace {

std::string type_name(const ValueRule &rule) {
    switch (rule.form) {
    case ValueRule::Form::name:
        return listed(rule.names, "|");
    case ValueRule::Form::whole_number:
        return "N";
    case ValueRule::Form::number_or_auto:
        return "X|auto";
    default:
        return "X";
    }
}

} // namespace

void refuse_option(const std::string &option, const std::string &rule, const std::string &text) {
    throw CLI::ValidationError(option, rule + ", is \"" + text + "\"");
}

nlohmann::json read_value(const std::string &option, const std::string &text, const ValueRule &rule) {
    nlohmann::json value = text;
    if (const auto whole = parse_number<std::uint64_t>(text); whole && rule.form != ValueRule::Form::name)
        value = *whole;
    else if (const auto real = parse_number<double>(text); real && rule.form != ValueRule::Form::name)
        value = *real;
    try {
        check(rule, value, {});
    } catch (const JsonRefusal &refusal) {
        throw CLI::ValidationError(option, refusal.what());
    }
    return value;
}

CLI::Option *add_value(CLI::App &command, const std::string &name, const ValueRule &rule,
                       std::function<void(const nlohmann::json &)> store, const std::string &help) {
    const auto read = [name, rule, store = std::move(store)](const std::string &text) {
        store(read_value(name, text, rule));
    };
    return command.add_option_function<std::string>(name, read, help)->type_name(type_name(rule));
}

CLI::Option *add_text(CLI::App &command, const std::string &name, std::string &target, const std::string &value,
                      const std::string &help) {
    return command.add_option(name, target, help)->type_name(value);
}

CLI::Option *add_device(CLI::App &command, std::string &device) {
    return add_text(command, "--device", device, "INDEX|UUID|NAME|gpu|cpu|all",
                    "Index or UUID from `pt devices`, or several (0,1), or part of a name (default: the best one)");
}

CLI::Option *add_shader_dir(CLI::App &command, std::string &shader_dir) {
    return add_text(command, "--shader-dir", shader_dir, "DIR",
                    "Compile the kernels from the GLSL files in DIR, edited copies of the project's shaders/");
}

CLI::Option *add_quiet(CLI::App &command, bool &quiet) {
    return command.add_flag("-q,--quiet", quiet, "Print errors only");
}

} // namespace cli
