#include "report/canvas.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace ream::report {
namespace {

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value == 0.0 ? 0.0 : value);
  return text.data();
}

std::string colour(const Ink& ink) {
  const auto level = [](double share) { return static_cast<unsigned>(std::floor(share * 255.0 + 0.5)); };
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", level(ink.red), level(ink.green), level(ink.blue));
  return text.data();
}

std::string points(std::span<const Place> path) {
  std::string text;
  for (const Place& place : path) text += (text.empty() ? "" : " ") + number(place.x) + "," + number(place.y);
  return text;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\'')
      result += "&#39;";
    else
      result += c;
  }
  return result;
}

void SvgCanvas::fill(std::span<const Place> polygon, const Ink& ink) {
  elements_ += "<polygon points=\"" + points(polygon) + "\" fill=\"" + colour(ink) + "\"/>\n";
}

void SvgCanvas::line(std::span<const Place> path, const Stroke& stroke) {
  elements_ += "<polyline points=\"" + points(path) + "\" fill=\"none\" stroke=\"" + colour(stroke.ink) +
               "\" stroke-width=\"" + number(std::max(stroke.width, 0.1)) + "\" stroke-linejoin=\"round\"" +
               (stroke.dashed ? " stroke-dasharray=\"3 2\"" : "") + "/>\n";
}

void SvgCanvas::text(const Place& at, const std::string& words, const Lettering& lettering) {
  constexpr std::array<const char*, 3> anchors = {"start", "middle", "end"};
  const std::string x = number(at.x), y = number(at.y);
  elements_ += "<text x=\"" + x + "\" y=\"" + y + "\" font-size=\"" + number(lettering.size) + "\" fill=\"" +
               colour(lettering.ink) + "\" text-anchor=\"" + anchors[static_cast<size_t>(lettering.anchor)] +
               "\"" + (lettering.bold ? " font-weight=\"600\"" : "") +
               (lettering.upwards ? " transform=\"rotate(-90 " + x + " " + y + ")\"" : "") + ">" +
               escaped(words) + "</text>\n";
}

std::string SvgCanvas::svg(double width, double height, const std::string& alt_text) const {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width) + " " + number(height) +
         "\" role=\"img\" aria-label=\"" + escaped(alt_text) + "\">\n" + elements_ + "</svg>\n";
}

}  // namespace ream::report
