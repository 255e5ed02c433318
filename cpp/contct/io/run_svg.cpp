#include "contct/io/run_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "contct/io/frame_numbers.hpp"
#include "contct/io/load_text.hpp"
#include "contct/io/markup_text.hpp"
#include "contct/io/thinning.hpp"

namespace contct {
namespace {

constexpr double width = 900.0;
constexpr double picture_top = 96.0;

struct span_of {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void take(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
  [[nodiscard]] double range() const { return most > least ? most - least : 1.0; }
};

/// A straight scale: numbers onto the page.
struct scale {
  double from, per_unit, at;
  [[nodiscard]] double operator()(double x) const { return at + (x - from) * per_unit; }
};

/// 1, 2 or 5 times a power of ten, not above x.
double round_down(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  const double digit = x / power;
  return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

std::vector<double> ticks(double from, double to, int about) {
  const double step = round_down((to - from) / about * 2);
  std::vector<double> at;
  for (double i = std::ceil(from / step - 1e-9); i * step <= to + 1e-9 * step; ++i)
    at.push_back(i * step + 0.0);  // no -0
  return at;
}

std::string text_at(double x, double y, std::string_view kind, std::string_view words) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>\n", x, y, kind,
                     markup_text(words));
}

std::string line(double x1, double y1, double x2, double y2, std::string_view kind) {
  return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" class=\"{}\"/>\n", x1, y1, x2, y2, kind);
}

/// Open is a ring, closed a square, at its face a diamond.
std::string mark(pair_look look, double x, double y, double r, std::string_view words) {
  const std::string title = fmt::format("<title>{}</title>", markup_text(words));
  switch (look) {
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

std::string pair_words(const problem& p, const frame& f, std::size_t i) {
  const pair_reading r = reading_of(p, f, i);
  const contact_pair& at = p.pairs[i];
  return fmt::format("pair {}, node {}, face {} at {:.6g}, {}: {} {:.6g}", i + 1, at.node + 1,
                     at.surface > 0 ? "above" : "below", at.face, words_of(r.look),
                     f.closed(i) ? "force" : "gap", f.closed(i) ? r.force : r.gap);
}

/// A part of the picture, and the height it took.
struct drawn {
  std::string text;
  double height;
};

std::string face_of(const contact_pair& p, double x, double y, double half) {
  std::string text = line(x - half, y, x + half, y, "surface");
  for (double k = -half; k < half - 1; k += 6)
    text += line(x + k + 3, y, x + k + 3 - 3 * p.surface, y - 6 * p.surface, "hatch");
  return text;
}

std::string axis_below(const scale& X, double from, double to, double y) {
  std::string text;
  for (const double x : ticks(from, to, 8))
    text +=
        line(X(x), y, X(x), y + 5, "thin") + text_at(X(x), y + 20, "quiet middle", fmt::format("{:.4g}", x));
  return text;
}

/// The elements' cubics between the nodes shown, as Bezier curves: the same curves.
std::string curve_of(const finished_run& r, const beam& b, const frame& f, const shown_parts& shown,
                     const scale& X, const scale& Y) {
  std::string path;
  double x0 = 0.0, w0 = 0.0, slope0 = 0.0;
  for (const int node : shown.nodes) {
    const double x = b.x[static_cast<std::size_t>(node)];
    const double w = deflection_of(r.what, f, static_cast<std::size_t>(node));
    const double slope = f.displacement[static_cast<std::size_t>(node) * 2 + 1];
    const double third = (x - x0) / 3;
    path += path.empty()
                ? fmt::format("M{:.2f} {:.2f}", X(x), Y(w))
                : fmt::format("C{:.2f} {:.2f} {:.2f} {:.2f} {:.2f} {:.2f}", X(x0 + third),
                              Y(w0 + third * slope0), X(x - third), Y(w - third * slope), X(x), Y(w));
    x0 = x;
    w0 = w;
    slope0 = slope;
  }
  return path;
}

/// From the side; deflections and faces magnified alike.
drawn draw_beam(const finished_run& r, const beam& b, const frame& f, const shown_parts& shown) {
  span_of w;
  w.take(0.0);
  for (const int node : shown.nodes) w.take(deflection_of(r.what, f, static_cast<std::size_t>(node)));
  const double reach = std::max(std::abs(w.least), std::abs(w.most));
  for (const std::size_t i : shown.pairs) {
    const double face = r.what.pairs[i].face;
    if (std::abs(face) <= 2.5 * reach || reach == 0.0) w.take(face);
  }
  constexpr double room = 170.0;
  const scale X{b.x.front(), (width - 120) / (b.x.back() - b.x.front()), 60.0};
  const double magnified = w.most > w.least ? round_down(room / (w.range() * X.per_unit)) : 1.0;
  const scale Y{w.most, -magnified * X.per_unit, picture_top + 34};
  const double bottom = Y(w.least) + 44;
  std::string text =
      text_at(60, picture_top, "strong", fmt::format("Final state, deflection × {:.6g}", magnified));
  text += line(X(b.x.front()), Y(0), X(b.x.back()), Y(0), "undeformed");
  const std::string shape = curve_of(r, b, f, shown, X, Y);
  const double half =
      std::clamp((width - 120) / static_cast<double>(shown.pairs.size() + 1) * 0.36, 1.0, 14.0);
  for (const std::size_t i : shown.pairs) {
    const contact_pair& p = r.what.pairs[i];
    text += face_of(p, X(b.x[static_cast<std::size_t>(p.node)]),
                    std::clamp(Y(p.face), picture_top + 16, bottom - 10), half);
  }
  text += fmt::format("<path d=\"{}\" class=\"beam\"/>\n", shape);
  for (const support& s : r.what.supports) {
    const double x = X(b.x[static_cast<std::size_t>(s.node)]);
    const double y = Y(deflection_of(r.what, f, static_cast<std::size_t>(s.node)));
    if (s.dof == 0)
      text += fmt::format("<path d=\"M{:.1f} {:.1f}l8 13h-16z\" class=\"support\"/>\n", x, y + 2);
    if (s.dof == 1) text += line(x, y - 13, x, y + 13, "clamp");
  }
  for (const std::size_t i : shown.pairs) {
    const contact_pair& p = r.what.pairs[i];
    const pair_reading now = reading_of(r.what, f, i);
    text += mark(now.look, X(b.x[static_cast<std::size_t>(p.node)]), Y(now.w),
                 std::clamp(half * 0.5, 1.6, 5.0), pair_words(r.what, f, i));
  }
  text += axis_below(X, b.x.front(), b.x.back(), bottom);
  return {text, bottom + 30};
}

/// Lighter is higher.
std::string colour_of(double share) {
  const double stops[3][3] = {{22, 52, 98}, {104, 165, 200}, {250, 244, 228}};
  const double at = std::clamp(share, 0.0, 1.0) * 2;
  const int k = std::min(1, static_cast<int>(at));
  const auto mix = [&](int i) {
    return static_cast<int>(stops[k][i] + (stops[k + 1][i] - stops[k][i]) * (at - k));
  };
  return fmt::format("rgb({},{},{})", mix(0), mix(1), mix(2));
}

/// From above: a colour for each rectangle between the lines that are drawn.
drawn draw_plate(const finished_run& r, const plate& p, const frame& f, const shown_parts& shown) {
  const auto w = [&](int i, int j) {
    return deflection_of(r.what, f, static_cast<std::size_t>(p.node_at(i, j)));
  };
  span_of all;
  for (const int j : shown.rows) {
    for (const int i : shown.columns) all.take(w(i, j));
  }
  const double per_unit =
      std::min((width - 330) / (p.x.back() - p.x.front()), 430 / (p.y.back() - p.y.front()));
  const scale X{p.x.front(), per_unit, 60.0};
  const scale Y{p.y.back(), -per_unit, picture_top + 14};
  const double bottom = Y(p.y.front());
  std::string text =
      text_at(60, picture_top, "strong", "Final state from above: deflection w, and the pairs");
  for (std::size_t b = 0; b + 1 < shown.rows.size(); ++b) {
    for (std::size_t a = 0; a + 1 < shown.columns.size(); ++a) {
      const int i = shown.columns[a], k = shown.columns[a + 1], j = shown.rows[b], l = shown.rows[b + 1];
      const double mean = (w(i, j) + w(k, j) + w(k, l) + w(i, l)) / 4;
      const std::string colour = colour_of((mean - all.least) / all.range());
      const double left = X(p.x[static_cast<std::size_t>(i)]), top = Y(p.y[static_cast<std::size_t>(l)]);
      text += fmt::format(
          "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" stroke=\"{}\"/>\n",
          left, top, X(p.x[static_cast<std::size_t>(k)]) - left, Y(p.y[static_cast<std::size_t>(j)]) - top,
          colour, colour);
    }
  }
  text += "<g class=\"map\">\n";
  const double r_pair = std::clamp(per_unit * (p.x.back() - p.x.front()) / p.columns() * 0.25, 1.5, 6.0);
  for (const std::size_t i : shown.pairs) {
    const place at = place_of_node(r.what.geometry, r.what.pairs[i].node);
    text += mark(reading_of(r.what, f, i).look, X(at.x), Y(at.y), r_pair, pair_words(r.what, f, i));
  }
  text += "</g>\n";
  const double right = X(p.x.back()) + 40;
  for (int i = 0; i <= 10; ++i) {
    const double value = all.most - (all.most - all.least) * i / 10;
    text += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"20\" height=\"20\" fill=\"{}\"/>\n", right,
                        picture_top + 14 + 20.0 * i, colour_of((value - all.least) / all.range()));
    if (i % 5 == 0)
      text += text_at(right + 28, picture_top + 29 + 20.0 * i, "quiet", fmt::format("{:.4g}", value));
  }
  return {text + axis_below(X, p.x.front(), p.x.back(), bottom), std::max(bottom, picture_top + 260) + 30};
}

drawn draw_path(const finished_run& r, const shown_parts& shown, double top) {
  const load_path loads(r.what);
  std::vector<std::pair<double, double>> points;
  span_of x, y;
  for (const frame& f : r.kept.frames()) {
    points.emplace_back(deflection_of(r.what, f, shown.watched),
                        resultant_of(r.what.geometry, load_of(loads, f)).force);
    x.take(points.back().first);
    y.take(points.back().second);
  }
  constexpr double height = 260.0;
  const scale X{x.least, (width - 170) / x.range(), 110.0};
  const scale Y{y.most, -(height - 20) / y.range(), top + 44};
  const double bottom = top + 44 + height - 20;
  std::string text =
      text_at(60, top + 16, "strong",
              fmt::format("Sum of the loads over the deflection of node {}", shown.watched + 1));
  for (const double v : ticks(y.least, y.least + y.range(), 5))
    text += line(104, Y(v), width - 60, Y(v), "grid") +
            text_at(98, Y(v) + 4, "quiet end", fmt::format("{:.4g}", v));
  text += axis_below(X, x.least, x.least + x.range(), bottom + 10);
  std::string track, marks;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const frame& f = r.kept.frames()[i];
    const double px = X(points[i].first), py = Y(points[i].second);
    track += fmt::format("{}{:.2f} {:.2f}", i == 0 ? "M" : "L", px, py);
    const bool makes =
        std::any_of(f.events.begin(), f.events.end(), [](const event& e) { return e.what == change::make; });
    marks += fmt::format(
        "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\" class=\"{}\"><title>{}.{}</title></circle>\n", px, py,
        f.events.empty() ? "stop"
        : makes          ? "make"
                         : "break",
        f.step, f.number);
  }
  text += fmt::format("<path d=\"{}\" class=\"track\"/>\n{}", track, marks);
  return {text, bottom + 48};
}

constexpr std::string_view style = R"(<style>
svg { background: #fcfbf8; font-family: "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; }
text { fill: #1d1d1b; font-size: 13px; } .title { font-size: 19px; font-weight: 600; } .strong { font-weight: 600; font-size: 14px; }
.quiet { fill: #5f5e58; } .middle { text-anchor: middle; } .end { text-anchor: end; }
path { fill: none; } .thin { stroke: #5f5e58; } .grid { stroke: #e4e1d8; } .undeformed { stroke: #5f5e58; stroke-dasharray: 5 5; }
.beam { stroke: #1d1d1b; stroke-width: 3.5; stroke-linejoin: round; } .support { stroke: #1d1d1b; stroke-width: 1.5; fill: #fff; } .clamp { stroke: #1d1d1b; stroke-width: 4; }
.surface { stroke: #1d1d1b; stroke-width: 2; } .hatch { stroke: #5f5e58; }
.open { fill: #fff; stroke: #6b6a64; stroke-width: 1.8; } .closed { fill: #0b61a4; stroke: #fff; } .face { fill: #fff; stroke: #a85b00; stroke-width: 2.2; }
.map .closed { fill: #17181a; }
.track { stroke: #1d1d1b; stroke-width: 2; stroke-linejoin: round; } .make { fill: #1d1d1b; } .break { fill: #fff; stroke: #1d1d1b; stroke-width: 1.8; } .stop { fill: #b9b6ac; }
</style>
)";

}  // namespace

std::string run_svg(const finished_run& r) {
  const shown_parts shown = choose_parts(r);
  const frame& last = r.kept.frames().back();
  drawn picture{"", picture_top};
  if (const auto* b = std::get_if<beam>(&r.what.geometry.kind)) picture = draw_beam(r, *b, last, shown);
  if (const auto* p = std::get_if<plate>(&r.what.geometry.kind)) picture = draw_plate(r, *p, last, shown);
  const drawn path = draw_path(r, shown, picture.height + 20);
  const pair_counts n = count_pairs(r.what, last);
  const extreme most = largest_deflection(r.what, last);
  const std::string words = fmt::format(
      "{}: step {}, share {:.6g}; w = {:.6g} at node {}; pairs: {} closed (square), {} open (ring), {} at "
      "their faces (diamond)",
      r.status, last.step, last.fraction, most.value, most.at + 1, n.closed, n.open, n.at_face);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" "
             "height=\"{1:.0f}\" role=\"img\">\n"
             "<title>{2}</title>\n<desc>{3}</desc>\n",
             width, path.height, markup_text(title_of(r)), markup_text(words)) +
         std::string(style) +
         fmt::format("<rect width=\"{}\" height=\"{:.0f}\" fill=\"#fcfbf8\"/>\n", width, path.height) +
         text_at(60, 38, "title", title_of(r)) + text_at(60, 62, "quiet", words) + picture.text + path.text +
         "</svg>\n";
}

}  // namespace contct
