#include "contct/write/run_svg.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "contct/text/markup.hpp"
#include "contct/write/frame_numbers.hpp"
#include "contct/write/load_text.hpp"
#include "contct/write/page_sampling.hpp"
#include "contct/write/structure_svg.hpp"
#include "contct/write/svg_parts.hpp"

namespace contct {
namespace {

using namespace svg;

std::string kind_of(const frame& f) {
  if (f.events.empty()) return "stop";
  const bool makes =
      std::any_of(f.events.begin(), f.events.end(), [](const event& e) { return e.what == change::make; });
  return makes ? "make" : "break";
}

/// A matrix does not say what is a deflection.
const char* moves_by(const model& m) {
  return std::holds_alternative<assembled>(m.kind) ? "displacement" : "deflection";
}

/// The sum of the loads over the deflection of the node that deflects most, state by state.
drawn draw_path(const finished_run& r, const shown_parts& shown, double top) {
  const load_path loads(r.what);
  span_of w;
  span_of force;
  const auto force_in = [&](const frame& f) {
    return resultant_of(r.what.geometry, load_of(loads, f)).force;
  };
  for (const frame& f : r.kept.frames()) {
    w.take(deflection_of(r.what, f, shown.watched));
    force.take(force_in(f));
  }
  constexpr double height = 240.0;
  const scale X{w.least, (page_width - 170) / w.range(), 110.0};
  const scale Y{force.most, -height / force.range(), top + 44};
  const double bottom = top + 44 + height;
  std::string text = text_at(60, top + 16, "strong",
                             fmt::format("Sum of the loads over the {} of {}", moves_by(r.what.geometry),
                                         place_words(r.what.geometry, static_cast<int>(shown.watched))));
  for (const double v : ticks(force.least, force.least + force.range(), 5)) {
    text += line(104, Y(v), page_width - 60, Y(v), "grid");
    text += text_at(98, Y(v) + 4, "quiet end", fmt::format("{:.4g}", v));
  }
  text += axis_below(X, w.least, w.least + w.range(), bottom + 10);
  std::string track;
  std::string marks;
  for (const frame& f : r.kept.frames()) {
    const double x = X(deflection_of(r.what, f, shown.watched));
    const double y = Y(force_in(f));
    track += fmt::format("{}{:.2f} {:.2f}", track.empty() ? "M" : "L", x, y);
    marks += fmt::format(
        "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\" class=\"{}\"><title>{}.{}</title></circle>\n", x, y,
        kind_of(f), f.step, f.number);
  }
  return {text + fmt::format("<path d=\"{}\" class=\"track\"/>\n{}", track, marks), bottom + 48};
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
.was { stroke: #c4c0b5; } .member { stroke: #1d1d1b; stroke-width: 1.6; } .node { fill: #1d1d1b; } .force { stroke: #0b61a4; stroke-width: 2; }
.track { stroke: #1d1d1b; stroke-width: 2; stroke-linejoin: round; } .make { fill: #1d1d1b; } .break { fill: #fff; stroke: #1d1d1b; stroke-width: 1.8; } .stop { fill: #b9b6ac; }
</style>
)";

}  // namespace

std::string run_svg(const finished_run& r) {
  const shown_parts shown = choose_parts(r);
  const frame& last = r.kept.frames().back();
  drawn picture{"", picture_top};
  if (const auto* b = std::get_if<beam>(&r.what.geometry.kind)) picture = draw_beam(r.what, *b, last, shown);
  if (const auto* p = std::get_if<plate>(&r.what.geometry.kind))
    picture = draw_plate(r.what, *p, last, shown);
  if (const auto* a = std::get_if<assembled>(&r.what.geometry.kind))
    picture = a->places.known() ? draw_mesh(r.what, a->places, last, shown) : draw_table(r.what, last, shown);
  const drawn path = draw_path(r, shown, picture.bottom + 20);
  const pair_counts n = count_pairs(r.what, last);
  const extreme most = largest_deflection(r.what, last, shown.deflecting);
  const std::string words = fmt::format(
      "{}: step {}, share {:.6g}; {} {:.6g} at {}; pairs: {} closed (square), {} open (ring), {} at "
      "their faces (diamond)",
      r.status, last.step, last.fraction,
      std::holds_alternative<assembled>(r.what.geometry.kind) ? "u =" : "w =", most.value,
      place_words(r.what.geometry, static_cast<int>(most.at)), n.closed, n.open, n.at_face);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" "
             "height=\"{1:.0f}\" role=\"img\">\n"
             "<title>{2}</title>\n<desc>{3}</desc>\n",
             page_width, path.bottom, markup_text(title_of(r)), markup_text(words)) +
         std::string(style) +
         fmt::format("<rect width=\"{}\" height=\"{:.0f}\" fill=\"#fcfbf8\"/>\n", page_width, path.bottom) +
         text_at(60, 38, "title", title_of(r)) + text_at(60, 62, "quiet", words) + picture.text + path.text +
         "</svg>\n";
}

}  // namespace contct
