#include "contct/write/run_svg.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "contct/text/strings.hpp"
#include "contct/write/load_text.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace svg {

std::string mark_of_pair(const shown_state& s, int pair, const spot& at, double r) {
  const contact_pair& p = s.what.pairs[pair];
  const bool closed = s.at.closed(pair);
  const pair_reading now = reading_of(s.what, s.at, pair);
  const std::string words =
      title(fmt::format("pair {}, {}, face {} at {:.6g}, {}: {} {:.6g}", pair + 1,
                        place_words(s.what.geometry, p.node), surface_name(p.surface), p.face,
                        look_name(now.look), closed ? "force" : "gap", closed ? now.force : now.gap));
  switch (now.look) {
    case pair_look::open:
      return circle(at.x, at.y, r, R"(class="open")", words);
    case pair_look::closed:
      return rectangle(at.x - r, at.y - r, 2 * r, 2 * r, R"(class="closed")", words);
    case pair_look::at_face:
      return path(fmt::format("M{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}z", at.x,
                              at.y - 1.3 * r, 1.3 * r, 1.3 * r, -1.3 * r, 1.3 * r, -1.3 * r, -1.3 * r),
                  "face", words);
  }
  return "";
}

}  // namespace svg

namespace {

using namespace svg;

std::string_view kind_of(const frame& f) {
  if (f.events.empty()) return "stop";
  const bool makes =
      std::any_of(f.events.begin(), f.events.end(), [](const event& e) { return e.what == change::make; });
  return change_name(makes ? change::make : change::break_);
}

bool is_matrix(const finished_run& r) {
  return std::holds_alternative<assembled>(r.what.geometry.kind);
}

drawn draw_structure(const shown_state& s) {
  const model& m = s.what.geometry;
  if (const auto* b = std::get_if<beam>(&m.kind)) return draw_beam(*b, s);
  if (const auto* p = std::get_if<plate>(&m.kind)) return draw_plate(*p, s);
  const placed_nodes& places = std::get<assembled>(m.kind).places;
  return places.known() ? draw_mesh(places, s) : draw_table(s);
}

/// The frames of a path over the deflection of the node that deflects most, and the sum of the loads.
std::vector<spot> load_path_of(const finished_run& r, const shown_parts& shown) {
  const load_path loads(r.what);
  std::vector<spot> at;
  for (const frame& f : r.kept.frames())
    at.push_back({deflection_of(r.what, f, shown.watched),
                  resultant_of(r.what.geometry, loads.at(f.step, f.fraction)).force});
  return at;
}

/// The sum of the loads over the deflection of the node that deflects most, state by state.
drawn draw_path(const finished_run& r, const shown_parts& shown, double top) {
  const std::vector<spot> states = load_path_of(r, shown);
  span_of w;
  span_of force;
  for (const spot& s : states) {
    w.take(s.x);
    force.take(s.y);
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

/// How the run ended, and what the marks of pairs mean.
std::string words_of(const finished_run& r, const shown_parts& shown) {
  const frame& last = r.kept.frames().back();
  const pair_counts n = count_pairs(r.what, last);
  const extreme most = largest_deflection(r.what, last, shown.deflecting);
  return fmt::format(
      "{}: step {}, share {:.6g}; {} {:.6g} at {}; pairs: {} closed (square), {} open (ring), {} at "
      "their faces (diamond)",
      r.status, last.step, last.fraction, is_matrix(r) ? "u =" : "w =", most.value,
      place_words(r.what.geometry, most.at), n.closed, n.open, n.at_face);
}

constexpr std::string_view style = R"(
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
)";

}  // namespace

std::string run_svg(const finished_run& r) {
  const shown_parts shown = choose_parts(r);
  const drawn picture = draw_structure({r.what, r.kept.frames().back(), shown});
  const drawn path = draw_path(r, shown, picture.bottom + 20);
  const std::string words = words_of(r, shown);
  const std::string size = fmt::format(R"(width="{}" height="{:.0f}")", page_width, path.bottom);
  const std::string content = "\n" + title(title_of(r)) + "\n" + element("desc", "", markup_text(words)) +
                              element("style", "", style) + element("rect", size + R"( fill="#fcfbf8")") +
                              text_at(side, 38, "title", title_of(r)) + text_at(side, 62, "quiet", words) +
                              picture.text + path.text;
  return element("svg",
                 fmt::format(R"(xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {:.0f}" {} role="img")",
                             page_width, path.bottom, size),
                 content);
}

}  // namespace contct::write
