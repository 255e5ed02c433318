#include "contct/write/run_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/text/markup.hpp"
#include "contct/write/frame_numbers.hpp"
#include "contct/write/words.hpp"

namespace contct::write {

using namespace svg;

namespace {

constexpr double page_width = 900.0;
constexpr double picture_top = 96.0;
constexpr double side = 60.0;  // left and right of pictures

/// What is drawn of a structure: a frame of a problem, and which of its parts. All must outlive it.
class structure_picture {
 public:
  structure_picture(const problem& p, const frame& f, const shown_parts& shown)
      : what_(p), at_(f), shown_(shown) {}

 protected:
  [[nodiscard]] double w_of(int node) const { return deflection_of(what_, at_, node); }
  [[nodiscard]] std::string mark(int pair, const spot& at, double r) const {
    return mark_of_pair(what_, at_, pair, at, r);
  }

  const problem& what_;
  const frame& at_;
  const shown_parts& shown_;
  scale X_{}, Y_{};
  double magnified_ = 1.0;
  double bottom_ = 0.0;
};

/// A beam from the side; deflections and faces magnified alike, as the heading says.
class beam_picture : structure_picture {
 public:
  beam_picture(const beam& b, const structure_picture& s) : structure_picture(s), x_(b.x) {
    X_ = {x_.front(), (page_width - 2 * side) / (x_.back() - x_.front()), side};
    const span_of w = reach();
    constexpr double room = 170.0;
    if (w.most > w.least) magnified_ = round_down(room / (w.range() * X_.per_unit));
    Y_ = {w.most, -magnified_ * X_.per_unit, picture_top + 34};
    bottom_ = Y_(w.least) + 44;
    half_ =
        std::clamp((page_width - 2 * side) / static_cast<double>(shown_.pairs.size() + 1) * 0.36, 1.0, 14.0);
  }

  [[nodiscard]] drawn whole() const {
    return {
        text_at(side, picture_top, "strong", fmt::format("Final state, deflection × {:.6g}", magnified_)) +
            line(X_(x_.front()), Y_(0), X_(x_.back()), Y_(0), "undeformed") + faces() +
            path(curve(), "beam") + supports() + pairs() + axis_below(X_, x_.front(), x_.back(), bottom_),
        bottom_ + 30};
  }

 private:
  [[nodiscard]] spot spot_of(int node) const { return {X_(x_[node]), Y_(w_of(node))}; }

  /// What has to fit in: the beam, where it was, and the faces that are not too far away.
  [[nodiscard]] span_of reach() const {
    span_of w;
    w.take(0.0);
    for (const int node : shown_.nodes) w.take(w_of(node));
    const double largest = std::max(std::abs(w.least), std::abs(w.most));
    for (const int i : shown_.pairs) {
      const double face = what_.pairs[i].face;
      if (std::abs(face) <= 2.5 * largest || largest == 0.0) w.take(face);
    }
    return w;
  }

  /// Hatched on the side away from the beam; one that is too far away stands at the edge.
  [[nodiscard]] std::string faces() const {
    std::string text;
    for (const int i : shown_.pairs) {
      const contact_pair& p = what_.pairs[i];
      const double x = X_(x_[p.node]);
      const double y = std::clamp(Y_(p.face), picture_top + 16, bottom_ - 10);
      text += line(x - half_, y, x + half_, y, "surface");
      for (int k = 0; 6 * k < 2 * half_ - 1; ++k) {
        const double at = x - half_ + 6 * k + 3;
        text += line(at, y, at - 3 * p.surface, y - 6 * p.surface, "hatch");
      }
    }
    return text;
  }

  /// The elements' cubics between the nodes shown, as Bezier curves: the same curves.
  [[nodiscard]] std::string curve() const {
    std::string d;
    double x0 = 0.0;
    double w0 = 0.0;
    double slope0 = 0.0;
    for (const int node : shown_.nodes) {
      const double x = x_[node];
      const double w = w_of(node);
      const double slope = at_.displacement[2 * node + 1];
      const double third = (x - x0) / 3;
      d += d.empty()
               ? fmt::format("M{:.2f} {:.2f}", X_(x), Y_(w))
               : fmt::format("C{:.2f} {:.2f} {:.2f} {:.2f} {:.2f} {:.2f}", X_(x0 + third),
                             Y_(w0 + third * slope0), X_(x - third), Y_(w - third * slope), X_(x), Y_(w));
      x0 = x;
      w0 = w;
      slope0 = slope;
    }
    return d;
  }

  [[nodiscard]] std::string supports() const {
    std::string text;
    for (const support& s : what_.supports) {
      if (!shown_.has_support_at(s.node)) continue;
      const auto [x, y] = spot_of(s.node);
      text += s.dof == 0 ? path(fmt::format("M{:.1f} {:.1f}l8 13h-16z", x, y + 2), "support")
                         : line(x, y - 13, x, y + 13, "clamp");
    }
    return text;
  }

  [[nodiscard]] std::string pairs() const {
    const double r = std::clamp(half_ * 0.5, 1.6, 5.0);
    std::string text;
    for (const int i : shown_.pairs) text += mark(i, spot_of(what_.pairs[i].node), r);
    return text;
  }

  const std::vector<double>& x_;
  double half_ = 0.0;  // of a face
};

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

/// A plate from above: a colour for each rectangle between the lines that are drawn.
class plate_picture : structure_picture {
 public:
  plate_picture(const plate& p, const structure_picture& s) : structure_picture(s), plate_(p) {
    const double per_unit =
        std::min((page_width - 330) / (p.x.back() - p.x.front()), 430 / (p.y.back() - p.y.front()));
    X_ = {p.x.front(), per_unit, side};
    Y_ = {p.y.back(), -per_unit, picture_top + 14};
    bottom_ = Y_(p.y.front());
    for (const int j : shown_.rows) {
      for (const int i : shown_.columns) range_.take(w_at(i, j));
    }
  }

  [[nodiscard]] drawn whole() const {
    const std::vector<int>& columns = shown_.columns;
    const std::vector<int>& rows = shown_.rows;
    std::string text =
        text_at(side, picture_top, "strong", "Final state from above: deflection w, and the pairs");
    for (std::size_t b = 0; b + 1 < rows.size(); ++b) {
      for (std::size_t a = 0; a + 1 < columns.size(); ++a)
        text += cell(columns[a], columns[a + 1], rows[b], rows[b + 1]);
    }
    text += pairs() + legend() + axis_below(X_, plate_.x.front(), plate_.x.back(), bottom_);
    return {text, std::max(bottom_, picture_top + 260) + 30};
  }

 private:
  [[nodiscard]] double w_at(int i, int j) const { return w_of(plate_.node_at(i, j)); }
  [[nodiscard]] std::string colour(double w) const { return colour_of((w - range_.least) / range_.range()); }

  /// Between two columns and two rows, in the colour of its mean.
  [[nodiscard]] std::string cell(int from, int to, int low, int high) const {
    const double mean = (w_at(from, low) + w_at(to, low) + w_at(to, high) + w_at(from, high)) / 4;
    const double left = X_(plate_.x[from]);
    const double top = Y_(plate_.y[high]);
    return element(
        "rect",
        fmt::format(R"(x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}" fill="{}" stroke="{}")", left,
                    top, X_(plate_.x[to]) - left, Y_(plate_.y[low]) - top, colour(mean), colour(mean)));
  }

  [[nodiscard]] std::string pairs() const {
    const double spacing = X_.per_unit * (plate_.x.back() - plate_.x.front()) / plate_.columns();
    const double r = std::clamp(spacing * 0.25, 1.5, 6.0);
    std::string text = "\n";
    for (const int i : shown_.pairs) {
      const place at = place_of_node(what_.geometry, what_.pairs[i].node);
      text += mark(i, {X_(at.x), Y_(at.y)}, r);
    }
    return element("g", R"(class="map")", text);
  }

  /// What the colours mean.
  [[nodiscard]] std::string legend() const {
    const double left = X_(plate_.x.back()) + 40;
    std::string text;
    for (int i = 0; i <= 10; ++i) {
      const double w = range_.most - (range_.most - range_.least) * i / 10;
      const double top = picture_top + 14 + 20.0 * i;
      text += rectangle(left, top, 20, 20, fmt::format(R"(fill="{}")", colour(w)));
      if (i % 5 == 0) text += text_at(left + 28, top + 15, "quiet", fmt::format("{:.4g}", w));
    }
    return text;
  }

  const plate& plate_;
  span_of range_;
};

/// A structure from elsewhere in the view that shows most: its edges as they were, faint, and displaced, with
/// pairs and supports at their nodes.
class mesh_picture : structure_picture {
 public:
  mesh_picture(const placed_nodes& places, const structure_picture& s)
      : structure_picture(s),
        places_(places),
        of_node_(dofs_of_nodes(places)),
        view_(all_views.at(fitting_view(places))) {
    fit();
  }

  [[nodiscard]] drawn whole() const {
    std::string text =
        text_at(side, picture_top, "strong",
                fmt::format("Final state ({}), displacement × {:.6g}", view_.words, magnified_));
    text += path(edges(0.0), "was") + path(edges(magnified_), "member");
    if (shown_.edges.empty()) text += points();
    text += path(crosses(), "thin") + supports();
    for (const int i : shown_.pairs) text += pair(i);
    return {text, bottom_ + 24};
  }

 private:
  /// Room for the structure as it was, and for all displacements around it.
  void fit() {
    constexpr double most_height = 430.0;
    constexpr double share_of_displacements = 0.12;  // of the picture's size, for the largest of them
    span_of x;
    span_of y;
    for (const int node : shown_.nodes) {
      x.take(view_.x_of(places_.nodes[node].at));
      y.take(view_.y_of(places_.nodes[node].at));
    }
    const double size = std::max({x.most - x.least, y.most - y.least, 0.0});
    // By the whole path: a structure that came back is drawn where it was.
    if (shown_.reach > 0.0 && size > 0.0)
      magnified_ = round_down(share_of_displacements * size / shown_.reach);
    const double room = std::max(magnified_ * shown_.reach, 0.02 * size);
    for (span_of* s : {&x, &y}) {
      s->take(s->least - room);
      s->take(s->most + room);
    }
    const double per_unit = std::min((page_width - 2 * side) / x.range(), most_height / y.range());
    X_ = {(x.least + x.most) / 2, per_unit, page_width / 2};
    Y_ = {y.most, -per_unit, picture_top + 34};
    bottom_ = Y_(y.least) + 20;
  }

  /// A node on the page, its displacement magnified so many times.
  [[nodiscard]] spot displaced(int node, double times) const {
    const in_space u = reading_at(of_node_[node].along, at_);
    in_space p = places_.nodes[node].at;
    for (int axis = 0; axis < 3; ++axis) p[axis] += times * u[axis];
    return {X_(view_.x_of(p)), Y_(view_.y_of(p))};
  }

  [[nodiscard]] std::string edges(double times) const {
    std::string d;
    for (const int i : shown_.edges) {
      const spot a = displaced(places_.edges[i].from, times);
      const spot b = displaced(places_.edges[i].to, times);
      d += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x, a.y, b.x, b.y);
    }
    return d;
  }

  [[nodiscard]] std::string points() const {
    std::string text;
    for (const int node : shown_.nodes) {
      const spot s = displaced(node, magnified_);
      text += circle(s.x, s.y, 1.6, R"(class="node")");
    }
    return text;
  }

  /// A cross at each node that has no dof.
  [[nodiscard]] std::string crosses() const {
    std::string d;
    for (const int node : shown_.nodes) {
      if (of_node_[node] != dofs_of_node{}) continue;
      const spot s = displaced(node, 0.0);
      d += fmt::format("M{:.1f} {:.1f}l6 6m-6 0l6 -6", s.x - 3, s.y - 3);
    }
    return d;
  }

  /// A length of 1 along the axis of a dof, as the view shows it; {0, 0} for rotations.
  [[nodiscard]] spot seen(const placed_dof& d) const {
    if (!d.is_length()) return {0, 0};
    in_space unit{};
    unit[d.direction - 1] = 1.0;
    return {view_.x_of(unit), -view_.y_of(unit)};
  }

  /// An axis on the page, of length 1; {0, 0} where it points at the eye, and for rotations.
  [[nodiscard]] spot axis_on_page(const placed_dof& d) const {
    const spot on_page = seen(d);
    const double length = std::hypot(on_page.x, on_page.y);
    return length < 0.1 ? spot{0, 0} : spot{on_page.x / length, on_page.y / length};
  }

  /// A triangle behind the node in each direction in which it is held, a square where it cannot turn.
  [[nodiscard]] std::string supports() const {
    std::string text;
    for (const support& s : what_.supports) {
      const placed_dof& d = places_.dofs[s.node];
      if (d.node < 0 || !shown_.has_support_at(s.node)) continue;
      const spot p = displaced(d.node, magnified_);
      const spot t = axis_on_page(d);
      const std::string shape =
          t.x == 0 && t.y == 0
              ? fmt::format("M{:.1f} {:.1f}h9v9h-9z", p.x - 4.5, p.y - 4.5)
              : fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}z", p.x, p.y, p.x - 12 * t.x - 6 * t.y,
                            p.y - 12 * t.y + 6 * t.x, p.x - 12 * t.x + 6 * t.y, p.y - 12 * t.y - 6 * t.x);
      text += path(shape, "support");
    }
    return text;
  }

  /// Its face across its direction, hatched behind, and its mark at the node.
  [[nodiscard]] std::string pair(int i) const {
    constexpr double half = 13.0;  // of a face
    constexpr int hatches = 4;
    const contact_pair& p = what_.pairs[i];
    const placed_dof& d = places_.dofs[p.node];
    if (d.node < 0) return "";
    const spot node = displaced(d.node, magnified_);
    std::string marked = mark(i, node, 5.0);
    const spot t = axis_on_page(d);
    if (t.x == 0 && t.y == 0) return marked;
    // The face is drawn beside the node, along which it has no end; one that is too far away, at the edge.
    constexpr double far = 90.0;
    const double scale = magnified_ * X_.per_unit * std::hypot(seen(d).x, seen(d).y);
    const double away = std::clamp(scale * p.face, -far, far) - scale * w_of(p.node);
    const spot m{node.x + away * t.x, node.y + away * t.y};
    std::string text =
        line(m.x - half * t.y, m.y + half * t.x, m.x + half * t.y, m.y - half * t.x, "surface");
    for (int hatch = 0; hatch < hatches; ++hatch) {
      const double k = 2 - half + 6 * hatch;
      const spot from{m.x + k * t.y, m.y - k * t.x};
      text += line(from.x, from.y, from.x + p.surface * 6 * t.x - 3 * t.y,
                   from.y + p.surface * 6 * t.y + 3 * t.x, "hatch");
    }
    return text + marked;
  }

  const placed_nodes& places_;
  std::vector<dofs_of_node> of_node_;
  const structure_view& view_;
};

/// A label fit for a column, cut between characters.
std::string cut(std::string label) {
  constexpr std::size_t longest = 26;
  if (label.size() <= longest) return label;
  std::size_t end = longest - 3;
  while (end > 0 && (static_cast<unsigned char>(label[end]) & 0xC0U) == 0x80U) --end;
  return label.substr(0, end) + "...";
}

std::string table_row(double y, std::string_view kind, const std::vector<std::string>& cells) {
  constexpr double columns[] = {side, 130, 330, 500, 620, 740};
  std::string text;
  for (std::size_t i = 0; i < cells.size(); ++i) text += text_at(columns[i], y, kind, cells[i]);
  return text;
}

/// A structure whose places are not known: its pairs as a table, the dof that moves most first.
drawn draw_table(const problem& p, const frame& f, const shown_parts& shown) {
  constexpr std::size_t most_rows = 40;
  constexpr double row_height = 22.0;
  const auto number = [](double x) { return fmt::format("{:.6g}", x); };
  const auto label = [&p](int node) { return cut(place_name(p.geometry, node)); };
  double y = picture_top;
  std::string text = text_at(side, y, "strong", "Final state: no coordinates are known, so this is a table");
  text += table_row(y += 30, "quiet", {"pair", "dof", "state", "displacement", "gap", "force"});
  text += table_row(
      y += row_height, "plain",
      {"", label(shown.watched), "moves most on the path", number(deflection_of(p, f, shown.watched))});
  const std::size_t rows = std::min(most_rows, shown.pairs.size());
  for (std::size_t k = 0; k < rows; ++k) {
    const int i = shown.pairs[k];
    const pair_reading r = reading_of(p, f, i);
    text += table_row(y += row_height, "plain",
                      {std::to_string(i + 1), label(p.pairs[i].node), std::string(look_name(r.look)),
                       number(r.w), number(r.gap), number(r.force)});
  }
  if (rows < p.pairs.size())
    text += text_at(side, y += row_height, "quiet", fmt::format("and {} pairs more", p.pairs.size() - rows));
  return {text, y + 16};
}

drawn draw_structure(const problem& p, const frame& f, const shown_parts& shown) {
  const structure_picture s(p, f, shown);
  if (const auto* b = std::get_if<beam>(&p.geometry.kind)) return beam_picture(*b, s).whole();
  if (const auto* of = std::get_if<plate>(&p.geometry.kind)) return plate_picture(*of, s).whole();
  const placed_nodes& places = std::get<assembled>(p.geometry.kind).places;
  return places.known() ? mesh_picture(places, s).whole() : draw_table(p, f, shown);
}

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
    states.push_back({deflection_of(r.what, f, shown.watched),
                      resultant_of(r.what.geometry, loads.at(f.step, f.fraction)).force});
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

std::string mark_of_pair(const problem& p, const frame& f, int pair, const spot& at, double r) {
  const contact_pair& of = p.pairs[pair];
  const bool closed = f.closed(pair);
  const pair_reading now = reading_of(p, f, pair);
  const std::string words =
      title(fmt::format("pair {}, {}, face {} at {:.6g}, {}: {} {:.6g}", pair + 1,
                        place_words(p.geometry, of.node), surface_name(of.surface), of.face,
                        look_name(now.look), closed ? "force" : "gap", closed ? now.force : now.gap));
  if (now.look == pair_look::open) return circle(at.x, at.y, r, R"(class="open")", words);
  if (now.look == pair_look::closed)
    return rectangle(at.x - r, at.y - r, 2 * r, 2 * r, R"(class="closed")", words);
  return path(fmt::format("M{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}z", at.x, at.y - 1.3 * r,
                          1.3 * r, 1.3 * r, -1.3 * r, 1.3 * r, -1.3 * r, -1.3 * r),
              "face", words);
}

std::string run_svg(const finished_run& r) {
  const shown_parts shown = choose_parts(r);
  const drawn picture = draw_structure(r.what, r.kept.frames().back(), shown);
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
