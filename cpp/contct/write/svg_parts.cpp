#include "contct/write/svg_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/text/markup.hpp"
#include "contct/write/frame_numbers.hpp"
#include "contct/write/result_json.hpp"

namespace contct::svg {
namespace {

std::string pair_words(const problem& p, std::size_t pair, const pair_reading& r, bool closed) {
  const contact_pair& at = p.pairs[pair];
  return fmt::format("pair {}, {}, face {} at {:.6g}, {}: {} {:.6g}", pair + 1,
                     place_words(p.geometry, at.node), surface_name(at.surface), at.face, words_of(r.look),
                     closed ? "force" : "gap", closed ? r.force : r.gap);
}

}  // namespace

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

std::string text_at(double x, double y, std::string_view kind, std::string_view words) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>\n", x, y, kind,
                     markup_text(words));
}

std::string line(double x1, double y1, double x2, double y2, std::string_view kind) {
  return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" class=\"{}\"/>\n", x1, y1, x2, y2, kind);
}

std::string axis_below(const scale& X, double from, double to, double y) {
  std::string text;
  for (const double x : ticks(from, to, 8)) {
    text += line(X(x), y, X(x), y + 5, "thin");
    text += text_at(X(x), y + 20, "quiet middle", fmt::format("{:.4g}", x));
  }
  return text;
}

std::string mark_of_pair(const problem& p, const frame& f, std::size_t pair, double x, double y, double r) {
  const pair_reading now = reading_of(p, f, pair);
  const std::string title =
      fmt::format("<title>{}</title>", markup_text(pair_words(p, pair, now, f.closed(pair))));
  switch (now.look) {
    case pair_look::open:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" class=\"open\">{}</circle>\n", x,
                         y, r, title);
    case pair_look::closed:
      return fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"closed\">{}</rect>\n",
          x - r, y - r, 2 * r, 2 * r, title);
    case pair_look::at_face:
      return fmt::format(
          "<path d=\"M{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}z\" class=\"face\">{}</path>\n",
          x, y - 1.3 * r, 1.3 * r, 1.3 * r, -1.3 * r, 1.3 * r, -1.3 * r, -1.3 * r, title);
  }
  return "";
}

}  // namespace contct::svg
