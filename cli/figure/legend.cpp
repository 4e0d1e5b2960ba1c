#include "cli/figure/legend.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

namespace cli {
namespace {

// What is not UTF-8 becomes U+FFFD.
std::string valid_utf8(const std::string &text) {
    const std::string quoted = nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return nlohmann::json::parse(quoted).get<std::string>();
}

// XML 1.0, section 2.2: of the control characters only tab, line feed and carriage return may stand in a document, and
// U+FFFE and U+FFFF may not; section 2.4: markup is to be escaped.
std::string xml_text(const std::string &text) {
    static const std::string replacement = "\xef\xbf\xbd"; // U+FFFD
    std::string escaped;
    const std::string valid = valid_utf8(text);
    for (std::size_t i = 0; i < valid.size(); ++i) {
        const char letter = valid[i];
        if (letter == '&') {
            escaped += "&amp;";
        } else if (letter == '<') {
            escaped += "&lt;";
        } else if (letter == '>') {
            escaped += "&gt;";
        } else if (static_cast<unsigned char>(letter) < 0x20 && letter != '\t') {
            escaped += replacement;
        } else if (valid.compare(i, 3, "\xef\xbf\xbe") == 0 || valid.compare(i, 3, "\xef\xbf\xbf") == 0) {
            escaped += replacement;
            i += 2;
        } else {
            escaped += letter;
        }
    }
    return escaped;
}

std::string number_text(const char *format, double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), format, number);
    return text.data();
}

std::string coordinate(double number) {
    return number_text("%.6g", number);
}

std::string colour_text(const DisplayColour &colour) {
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour[0], colour[1], colour[2]);
    return text.data();
}

std::size_t letter_count(const std::string &utf8) {
    return static_cast<std::size_t>(std::count_if(
        utf8.begin(), utf8.end(), [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0U) != 0x80U; }));
}

// Lengths of the drawing, in CSS pixels: 96 to an inch.
constexpr double margin = 8.0;
constexpr double font_size = 13.0;
constexpr double line_height = 20.0;
constexpr double letter_width = 0.62 * font_size; // of digits and most letters in fonts without serifs, with some room

class Drawing {
public:
    void rectangle(double x, double y, double width, double height, const std::string &style) {
        body_ += "  <rect x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" width=\"" + coordinate(width) +
                 "\" height=\"" + coordinate(height) + "\" " + style + "/>\n";
        grow(x + width, y + height);
    }

    void line(double x1, double y1, double x2, double y2) {
        body_ += "  <line x1=\"" + coordinate(x1) + "\" y1=\"" + coordinate(y1) + "\" x2=\"" + coordinate(x2) +
                 "\" y2=\"" + coordinate(y2) + "\" stroke=\"#333333\"/>\n";
        grow(x2, y2);
    }

    void circle(double x, double y, double radius, const std::string &style) {
        body_ += "  <circle cx=\"" + coordinate(x) + "\" cy=\"" + coordinate(y) + "\" r=\"" + coordinate(radius) +
                 "\" " + style + "/>\n";
        grow(x + radius, y + radius);
    }

    // y: of the middle of the line.
    void text(double x, double y, const std::string &words, const std::string &style = "") {
        body_ += "  <text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y + 0.35 * font_size) + "\"" + style + ">" +
                 xml_text(words) + "</text>\n";
        grow(x + letter_width * static_cast<double>(letter_count(words)), y + 0.5 * line_height);
    }

    void define(const std::string &definition) { body_ += definition; }

    std::string svg(const std::string &title) const {
        const std::string width = coordinate(std::ceil(right_ + margin));
        const std::string height = coordinate(std::ceil(bottom_ + margin));
        return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
               "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
               width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height +
               "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"" + coordinate(font_size) +
               "\" fill=\"#222222\">\n  <title>" + xml_text(title) + "</title>\n" + body_ + "</svg>\n";
    }

private:
    void grow(double right, double bottom) {
        right_ = std::max(right_, right);
        bottom_ = std::max(bottom_, bottom);
    }

    std::string body_;
    double right_ = 0.0;
    double bottom_ = 0.0;
};

// Both ends have their numbers, and round ones are between them.
void draw_bar(Drawing &drawing, const ColourBar &bar, double top) {
    constexpr double width = 18.0;
    constexpr double height = 180.0;
    constexpr double tick_length = 5.0;
    constexpr std::size_t most_ticks = 7;
    std::string gradient = "  <defs><linearGradient id=\"colours\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">\n";
    for (std::size_t i = 0; i < bar.colours.size(); ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(bar.colours.size() - 1);
        gradient +=
            "    <stop offset=\"" + coordinate(share) + "\" stop-color=\"" + colour_text(bar.colours[i]) + "\"/>\n";
    }
    drawing.define(gradient + "  </linearGradient></defs>\n");
    drawing.rectangle(margin, top, width, height, "fill=\"url(#colours)\" stroke=\"#333333\"");
    const double range = bar.high - bar.low;
    std::vector<double> ticks{bar.low};
    if (range > 0.0) {
        const double apart = line_height / height * range; // of words that do not overlap
        for (const double tick : tick_values(bar.low, bar.high, most_ticks)) {
            if (tick > bar.low + apart && tick < bar.high - apart) {
                ticks.push_back(tick);
            }
        }
        ticks.push_back(bar.high);
    }
    for (const double tick : ticks) {
        const double share = range > 0.0 ? (tick - bar.low) / range : 0.5;
        const double y = top + height * (1.0 - share);
        drawing.line(margin + width, y, margin + width + tick_length, y);
        drawing.text(margin + width + 2.0 * tick_length, y, number_text("%.6g", tick));
    }
}

void draw_swatches(Drawing &drawing, const std::vector<Swatch> &swatches, double top) {
    constexpr double radius = 7.0;
    for (std::size_t i = 0; i < swatches.size(); ++i) {
        const double y = top + (static_cast<double>(i) + 0.5) * line_height;
        drawing.circle(margin + radius, y, radius,
                       "fill=\"" + colour_text(swatches[i].colour) + "\" stroke=\"#333333\"");
        drawing.text(margin + 3.0 * radius, y, swatches[i].name);
    }
}

} // namespace

std::vector<double> tick_values(double low, double high, std::size_t most_count) {
    const double range = high - low;
    double step = std::pow(10.0, std::floor(std::log10(range)) - 2.0); // far too small
    const auto count = [&] { return std::floor(high / step + 1e-9) - std::ceil(low / step - 1e-9) + 1.0; };
    for (const double factor : {2.0, 2.5, 2.0, 2.0, 2.5, 2.0, 2.0, 2.5, 2.0}) { // 1, 2, 5, 10, ...
        if (count() <= static_cast<double>(most_count)) {
            break;
        }
        step *= factor;
    }
    std::vector<double> ticks;
    const double first = std::ceil(low / step - 1e-9);
    for (double i = 0.0; i < count(); ++i) {
        const double tick = (first + i) * step;
        ticks.push_back(std::abs(tick) < 1e-9 * range ? 0.0 : tick);
    }
    return ticks;
}

std::string legend_svg(const Legend &legend) {
    Drawing drawing;
    double top = margin;
    if (!legend.title.empty()) {
        drawing.text(margin, top + 0.5 * line_height, legend.title, " font-weight=\"bold\"");
        top += 1.5 * line_height;
    }
    if (legend.bar) {
        draw_bar(drawing, *legend.bar, top);
    } else {
        draw_swatches(drawing, legend.swatches, top);
    }
    return drawing.svg(legend.title);
}

} // namespace cli
