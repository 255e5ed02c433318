#include "contct/write/svg_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/text/strings.hpp"

namespace contct::write::svg {

void span_of::take(double x) {
  least = std::min(least, x);
  most = std::max(most, x);
}

double round_down(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  const double digit = x / power;
  return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

std::vector<double> ticks(double from, double to, int about) {
  const double step = round_down((to - from) / about * 2);
  const auto first = static_cast<long>(std::ceil(from / step - 1e-9));
  const auto last = static_cast<long>(std::floor(to / step + 1e-9));
  std::vector<double> at;
  for (long i = first; i <= last; ++i) at.push_back(static_cast<double>(i) * step);
  return at;
}

std::string element(std::string_view name, std::string_view attributes, std::string_view content) {
  return fmt::format("<{}{}{}", name, attributes.empty() ? "" : " ", attributes) +
         (content.empty() ? "/>\n" : fmt::format(">{}</{}>\n", content, name));
}

std::string circle(double x, double y, double r, std::string_view attributes, std::string_view content) {
  return element("circle", fmt::format(R"(cx="{:.1f}" cy="{:.1f}" r="{:.1f}" {})", x, y, r, attributes),
                 content);
}

std::string rectangle(double x, double y, double width, double height, std::string_view attributes,
                      std::string_view content) {
  return element("rect",
                 fmt::format(R"(x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" {})", x, y, width,
                             height, attributes),
                 content);
}

std::string text_markup(double x, double y, std::string_view attributes, std::string_view markup) {
  return element("text", fmt::format(R"(x="{:.1f}" y="{:.1f}" {})", x, y, attributes), markup);
}

std::string title(std::string_view words) {
  return fmt::format("<title>{}</title>", markup_text(words));
}

std::string text_at(double x, double y, std::string_view kind, std::string_view words) {
  return text_markup(x, y, fmt::format(R"(class="{}")", kind), markup_text(words));
}

std::string path(std::string_view d, std::string_view kind, std::string_view content) {
  return d.empty() ? "" : element("path", fmt::format(R"(d="{}" class="{}")", d, kind), content);
}

std::string line(double x1, double y1, double x2, double y2, std::string_view kind) {
  return path(fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", x1, y1, x2, y2), kind);
}

std::string axis_below(const scale& X, double from, double to, double y) {
  std::string text;
  for (const double x : ticks(from, to, 8)) {
    text += line(X(x), y, X(x), y + 5, "thin");
    text += text_at(X(x), y + 20, "quiet middle", fmt::format("{:.4g}", x));
  }
  return text;
}

}  // namespace contct::write::svg
