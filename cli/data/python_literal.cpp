#include "cli/data/python_literal.h"

#include "cli/base/number.h"

#include <algorithm>

namespace cli {
namespace {

class PythonParser {
public:
    explicit PythonParser(std::string_view text) : rest_(text) {}

    std::optional<PythonLiteral> parse_all() {
        auto literal = parse(0);
        skip_blanks();
        return rest_.empty() ? std::move(literal) : std::nullopt;
    }

private:
    static constexpr int deepest = 8; // dtypes of fields within fields have some five levels

    void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size())); }

    bool take(std::string_view word) {
        skip_blanks();
        if (!rest_.starts_with(word)) {
            return false;
        }
        rest_.remove_prefix(word.size());
        return true;
    }

    std::optional<PythonLiteral> parse(int depth) {
        using Kind = PythonLiteral::Kind;
        if (depth == deepest) {
            return std::nullopt;
        }
        if (take("(")) {
            return parse_elements(")", Kind::sequence, depth);
        }
        if (take("[")) {
            return parse_elements("]", Kind::sequence, depth);
        }
        if (take("{")) {
            return parse_elements("}", Kind::dictionary, depth);
        }
        if (take("True")) {
            return PythonLiteral{Kind::boolean, {}, 1, {}};
        }
        if (take("False")) {
            return PythonLiteral{Kind::boolean, {}, 0, {}};
        }
        for (const char quote : {'\'', '"'}) {
            if (take({&quote, 1})) {
                return parse_text(quote);
            }
        }
        return parse_number_literal();
    }

    // A comma after the last one is allowed.
    std::optional<PythonLiteral> parse_elements(std::string_view end, PythonLiteral::Kind kind, int depth) {
        PythonLiteral sequence{kind, {}, 0, {}};
        while (!take(end)) {
            auto element = parse(depth + 1);
            if (!element) {
                return std::nullopt;
            }
            sequence.elements.push_back(std::move(*element));
            if (kind == PythonLiteral::Kind::dictionary && sequence.elements.size() % 2 == 1) {
                if (!take(":")) {
                    return std::nullopt;
                }
            } else if (!take(",")) {
                return take(end) && is_whole(sequence) ? std::optional(std::move(sequence)) : std::nullopt;
            }
        }
        return is_whole(sequence) ? std::optional(std::move(sequence)) : std::nullopt;
    }

    static bool is_whole(const PythonLiteral &literal) {
        return literal.kind != PythonLiteral::Kind::dictionary || literal.elements.size() % 2 == 0;
    }

    std::optional<PythonLiteral> parse_text(char quote) {
        PythonLiteral text{PythonLiteral::Kind::text, {}, 0, {}};
        for (; !rest_.empty() && rest_.front() != quote; rest_.remove_prefix(1)) {
            if (rest_.front() == '\\' && rest_.size() > 1) {
                rest_.remove_prefix(1);
            }
            text.text += rest_.front();
        }
        return take({&quote, 1}) ? std::optional(std::move(text)) : std::nullopt;
    }

    // Python 2 wrote an L after large ones.
    std::optional<PythonLiteral> parse_number_literal() {
        const std::size_t size = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
        const auto number = parse_number<std::uint64_t>(rest_.substr(0, size));
        if (!number) {
            return std::nullopt;
        }
        rest_.remove_prefix(size);
        rest_.remove_prefix(rest_.starts_with('L') ? 1 : 0);
        return PythonLiteral{PythonLiteral::Kind::whole_number, {}, *number, {}};
    }

    std::string_view rest_;
};

} // namespace

const PythonLiteral *PythonLiteral::find(std::string_view key) const {
    for (std::size_t i = 0; kind == Kind::dictionary && i + 1 < elements.size(); i += 2) {
        if (elements[i].kind == Kind::text && elements[i].text == key) {
            return &elements[i + 1];
        }
    }
    return nullptr;
}

std::optional<PythonLiteral> parse_python_literal(std::string_view text) {
    return PythonParser(text).parse_all();
}

} // namespace cli
