#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/text/strings.hpp"
#include "contct/write/structure_svg.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace svg {

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
  if (!std::isfinite(step) || !(step > 0.0)) return {};  // a span that doubles do not hold
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

}  // namespace svg

using namespace svg;

namespace {

std::string_view kind_of(const frame& f) {
  if (f.events.empty()) return "stop";
  const bool makes =
      std::any_of(f.events.begin(), f.events.end(), [](const event& e) { return e.what == change::make; });
  return change_name(makes ? change::make : change::break_);
}

bool is_matrix(const finished_run& r) {
  return std::holds_alternative<assembled>(r.what.geometry.kind);
}

/// The sum of the loads over the deflection of the node that deflects most, state by state.
drawn draw_path(const finished_run& r, const shown_parts& shown, double top) {
  const load_path loads(r.what);
  std::vector<spot> states;
  span_of w;
  span_of force;
  for (const frame& f : r.kept.frames()) {
    states.push_back({deflection_of(r.what, f, shown.watched), loads.force_at(f.step, f.fraction)});
    w.take(states.back().x);
    force.take(states.back().y);
  }
  constexpr double height = 240.0;
  const scale X{w.least, (page_width - 170) / w.range(), 110.0};
  const scale Y{force.most, -height / force.range(), top + 44};
  const double bottom = top + 44 + height;
  std::string text =
      text_at(side, top + 16, "strong",
              fmt::format("Sum of the loads over the {} of {}", is_matrix(r) ? "displacement" : "deflection",
                          place_words(r.what.geometry, shown.watched)));
  for (const double v : ticks(force.least, force.least + force.range(), 5)) {
    text += line(104, Y(v), page_width - 60, Y(v), "grid");
    text += text_at(98, Y(v) + 4, "quiet end", fmt::format("{:.4g}", v));
  }
  text += axis_below(X, w.least, w.least + w.range(), bottom + 10);
  std::string track;
  std::string marks;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const frame& f = r.kept.frames()[i];
    const spot at{X(states[i].x), Y(states[i].y)};
    track += fmt::format("{}{:.2f} {:.2f}", i == 0 ? "M" : "L", at.x, at.y);
    marks +=
        element("circle", fmt::format(R"(cx="{:.2f}" cy="{:.2f}" r="4" class="{}")", at.x, at.y, kind_of(f)),
                title(fmt::format("{}.{}", f.step, f.number)));
  }
  return {text + path(track, "track") + marks, bottom + 48};
}

/// Pairs by their looks, with what their marks are.
std::string counts_of(const problem& p, const frame& f) {
  const pair_counts n = count_pairs(p, f);
  return fmt::format("pairs: {} in contact (square), {} separated (ring), {} at their faces (diamond)",
                     n.closed, n.open, n.at_face);
}

/// How the run ended, and what the marks of pairs mean.
std::string words_of(const finished_run& r, const shown_parts& shown) {
  const frame& last = r.kept.frames().back();
  const extreme most = largest_deflection(r.what, last, shown.deflecting);
  return fmt::format("{}: step {}, share {:.6g}; {} {:.6g} at {}; {}", r.status, last.step, last.fraction,
                     is_matrix(r) ? "u =" : "w =", most.value, place_words(r.what.geometry, most.at),
                     counts_of(r.what, last));
}

constexpr std::string_view style = R"(
svg { background: #fcfbf8; font-family: "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; }
text { fill: #1d1d1b; font-size: 13px; } .title { font-size: 19px; font-weight: 600; } .strong { font-weight: 600; font-size: 14px; }
.quiet { fill: #5f5e58; } .middle { text-anchor: middle; } .end { text-anchor: end; }
path { fill: none; } .thin { stroke: #5f5e58; } .grid { stroke: #e4e1d8; } .undeformed { stroke: #5f5e58; stroke-dasharray: 5 5; }
.beam { stroke: #1d1d1b; stroke-width: 3.5; stroke-linejoin: round; } .support { stroke: #1d1d1b; stroke-width: 1.5; fill: #fff; } .clamp { stroke: #1d1d1b; stroke-width: 4; }
.surface { stroke: #1d1d1b; stroke-width: 2; } .hatch { stroke: #5f5e58; }
.open { fill: #fff; stroke: #6b6a64; stroke-width: 1.8; } .closed { fill: #0b61a4; stroke: #fff; } .face { fill: #fff; stroke: #a85b00; stroke-width: 2.2; }
.reaction { fill: none; stroke: #a85b00; stroke-width: 1.6; }
.map .closed { fill: #17181a; }
.was { stroke: #c4c0b5; } .member { stroke: #1d1d1b; stroke-width: 1.6; } .node { fill: #1d1d1b; } .force { stroke: #0b61a4; stroke-width: 2; }
.track { stroke: #1d1d1b; stroke-width: 2; stroke-linejoin: round; } .make { fill: #1d1d1b; } .break { fill: #fff; stroke: #1d1d1b; stroke-width: 1.8; } .stop { fill: #b9b6ac; }
)";

/// A whole picture: a title, a line under it, and parts down to `bottom`.
std::string document(const std::string& heading, const std::string& words, const std::string& parts,
                     double bottom) {
  const std::string size = fmt::format(R"(width="{}" height="{:.0f}")", page_width, bottom);
  const std::string content = "\n" + title(heading) + "\n" + element("desc", "", markup_text(words)) +
                              element("style", "", style) + element("rect", size + R"( fill="#fcfbf8")") +
                              text_at(side, 38, "title", heading) + text_at(side, 62, "quiet", words) + parts;
  return element("svg",
                 fmt::format(R"(xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {:.0f}" {} role="img")",
                             page_width, bottom, size),
                 content);
}

}  // namespace

std::string run_svg(const finished_run& r) {
  const shown_parts shown = choose_parts(r);
  const drawn picture = draw_structure({r.what, r.kept.frames().back(), shown});
  const drawn path = draw_path(r, shown, picture.bottom + 20);
  return document(title_of(r), words_of(r, shown), picture.text + path.text, path.bottom);
}

std::string problem_svg(const problem& p, const std::string& file) {
  frame unloaded;
  unloaded.displacement.resize(dofs(p.geometry));
  for (const contact_pair& pair : p.pairs) unloaded.isep.push_back(pair.closed ? in_contact : separated);
  const shown_parts shown = choose_parts(shown_states{p, {&unloaded, 1}});
  const drawn picture = draw_structure({p, unloaded, shown, "Without load"});
  return document(title_of(p, file), "nothing is solved; " + counts_of(p, unloaded), picture.text,
                  picture.bottom + 10);
}

}  // namespace contct::write
