#include "contct/write/structure_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "contct/path/solve_problem.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/step_results.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
using namespace svg;

namespace {

/// What has to fit in: the beam, where it was, and the faces that are not too far away.
span_of reach_of_beam(const structure_picture& s) {
  span_of w;
  w.take(0.0);
  for (const int node : s.shown.nodes) w.take(s.w_of(node));
  const double largest = std::max(std::abs(w.least), std::abs(w.most));
  for (const int i : s.shown.pairs) {
    const double face = s.what.pairs[i].face;
    if (std::abs(face) <= 2.5 * largest || largest == 0.0) w.take(face);
  }
  return w;
}

/// Faces, `half` of which is so long, hatched on the side away from the beam; one that is too far away stands
/// at the edge.
std::string faces_of_beam(const beam& b, const structure_picture& s, double half) {
  std::string text;
  for (const int i : s.shown.pairs) {
    const contact_pair& p = s.what.pairs[i];
    const double x = s.X(b.x[p.node]);
    const double y = std::clamp(s.Y(p.face), picture_top + 16, s.bottom - 10);
    text += line(x - half, y, x + half, y, "surface");
    for (int k = 0; 6 * k < 2 * half - 1; ++k) {
      const double at = x - half + 6 * k + 3;
      text += line(at, y, at - 3 * p.surface, y - 6 * p.surface, "hatch");
    }
  }
  return text;
}

/// Cubics between the stations shown, as Bezier curves: the same curves, and exact ones where no load is
/// distributed between them.
std::string curve_of_beam(const beam& b, const structure_picture& s) {
  const load now = load_path(s.what).at(s.at.step, s.at.fraction);
  const station_reader read(b, now, s.at.displacement, elements_in(s.what, now, s.at).values);
  station from = s.shown.stations.front();
  std::string d = fmt::format("M{:.2f} {:.2f}", s.X(read.x(from)), s.Y(read.w(from)));
  for (const station& to : std::span(s.shown.stations).subspan(1)) {
    const double third = (read.x(to) - read.x(from)) / 3;
    d += fmt::format("C{:.2f} {:.2f} {:.2f} {:.2f} {:.2f} {:.2f}", s.X(read.x(from) + third),
                     s.Y(read.w(from) + third * read.slope(from)), s.X(read.x(to) - third),
                     s.Y(read.w(to) - third * read.slope(to)), s.X(read.x(to)), s.Y(read.w(to)));
    from = to;
  }
  return d;
}

/// A beam from the side; deflections and faces magnified alike, as the heading says.
drawn draw_beam(const beam& b, structure_picture s) {
  constexpr double width = page_width - 2 * side;
  const double left = b.x.front();
  const double right = b.x.back();
  s.X = {left, width / (right - left), side};
  const span_of w = reach_of_beam(s);
  constexpr double room = 170.0;
  if (w.most > w.least) s.magnified = round_down(room / (w.range() * s.X.per_unit));
  s.Y = {w.most, -s.magnified * s.X.per_unit, picture_top + 34};
  s.bottom = s.Y(w.least) + 44;
  const double half = std::clamp(width / static_cast<double>(s.shown.pairs.size() + 1) * 0.36, 1.0, 14.0);
  const auto spot_of = [&](int node) { return spot{s.X(b.x[node]), s.Y(s.w_of(node))}; };
  std::string supports;
  for (const support& held : s.what.supports) {
    if (!s.shown.has_support_at(held.node)) continue;
    const auto [x, y] = spot_of(held.node);
    supports += held.dof == 0 ? path(fmt::format("M{:.1f} {:.1f}l8 13h-16z", x, y + 2), "support")
                              : line(x, y - 13, x, y + 13, "clamp");
  }
  return {text_at(side, picture_top, "strong", fmt::format("{}, deflection × {:.6g}", s.state, s.magnified)) +
              line(s.X(left), s.Y(0), s.X(right), s.Y(0), "undeformed") + faces_of_beam(b, s, half) +
              path(curve_of_beam(b, s), "beam") + supports +
              s.marks(std::clamp(half * 0.5, 1.6, 5.0), spot_of) + axis_below(s.X, left, right, s.bottom),
          s.bottom + 30};
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

/// What the colours mean.
template <class Colour>
std::string legend(double left, double from, const span_of& range, Colour colour) {
  std::string text;
  for (int i = 0; i <= 10; ++i) {
    const double w = range.most - (range.most - range.least) * i / 10;
    const double top = from + 20.0 * i;
    text += rectangle(left, top, 20, 20, fmt::format(R"(fill="{}")", colour(w)));
    if (i % 5 == 0) text += text_at(left + 28, top + 15, "quiet", fmt::format("{:.4g}", w));
  }
  return text;
}

/// Between each two columns and rows that are drawn, rectangles in the colour of the bilinear interpolation
/// of `values` [nodes]: on a coarse mesh so many that there are `enough` along a side. With a colour for
/// `edges`, the mesh itself.
template <class Colour>
std::string cells_of_plate(const plate& p, const structure_picture& s, const std::vector<double>& values,
                           std::size_t enough, Colour colour, const std::string& edges) {
  const std::size_t most = std::max(s.shown.columns.size(), s.shown.rows.size()) - 1;
  const auto parts = edges.empty() ? static_cast<int>((enough + most - 1) / most) : 1;
  const auto cell = [&](int from, int to, int low, int high, int i, int j) {
    const double x = (i + 0.5) / parts;
    const double y = (j + 0.5) / parts;
    const auto w_at = [&](int column, int row) { return values[p.node_at(column, row)]; };
    const double w = std::lerp(std::lerp(w_at(from, low), w_at(to, low), x),
                               std::lerp(w_at(from, high), w_at(to, high), x), y);
    const double width = (s.X(p.x[to]) - s.X(p.x[from])) / parts;
    const double height = (s.Y(p.y[low]) - s.Y(p.y[high])) / parts;
    return element(
        "rect", fmt::format(R"(x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}" fill="{}" stroke="{}")",
                            s.X(p.x[from]) + i * width, s.Y(p.y[low]) - (j + 1) * height, width, height,
                            colour(w), edges.empty() ? colour(w) : edges));
  };
  std::string text;
  for (std::size_t b = 0; b + 1 < s.shown.rows.size(); ++b) {
    for (std::size_t a = 0; a + 1 < s.shown.columns.size(); ++a)
      for (int k = 0; k < parts * parts; ++k)
        text += cell(s.shown.columns[a], s.shown.columns[a + 1], s.shown.rows[b], s.shown.rows[b + 1],
                     k % parts, k / parts);
  }
  return text;
}

/// A quantity of a plate, small: what it is called, in what unit, and its values [nodes].
struct plate_map {
  std::string name;
  std::vector<double> values;
};

/// Moments at nodes, the means of the elements there, and the pressure of beds.
std::vector<plate_map> maps_of(const plate& p, const structure_picture& s) {
  const problem& what = s.what;
  std::vector<plate_map> maps;
  const element_results r = elements_in(what, {}, s.at);
  for (std::size_t i = 0; i < r.names.size(); ++i)
    maps.push_back({std::string(r.names[i]) + unit_words(what, r.names[i]), means_at_nodes(p, r, i)});
  if (!what.beds.empty())
    maps.push_back({"pressure of the bed " + unit_words(what.units, 1, -2), bed_pressure(what, s.at)});
  return maps;
}

/// From the least to the most of them; none where one of them, or the range, is beyond doubles.
std::optional<span_of> finite_range(const std::vector<double>& values) {
  span_of range;
  for (const double value : values) {
    if (!std::isfinite(value)) return {};
    range.take(value);
  }
  return std::isfinite(range.range()) ? std::optional(range) : std::nullopt;
}

/// Two beside each other, below the picture.
drawn draw_maps(const plate& p, const structure_picture& s, double top) {
  constexpr double room = (page_width - 2 * side) / 2 - 130;
  constexpr std::size_t enough = 24;
  const double wide = p.x.back() - p.x.front();
  const double high = p.y.back() - p.y.front();
  const double per_unit = std::min(room / wide, 240 / high);
  const double height = std::max(per_unit * high, 230.0) + 56;
  std::string text;
  double bottom = top;
  int number = 0;
  for (const plate_map& map : maps_of(p, s)) {
    const std::optional<span_of> held = finite_range(map.values);
    if (!held) continue;
    const span_of range = *held;
    structure_picture small = s;
    const double left = number % 2 == 0 ? side : page_width / 2;
    const int row = number / 2;
    const double from = top + height * row + 24;
    small.X = {p.x.front(), per_unit, left};
    small.Y = {p.y.back(), -per_unit, from};
    const auto colour = [&](double v) {
      return colour_of(range.most == range.least ? 1.0 : (v - range.least) / range.range());
    };
    text += text_at(left, from - 10, "strong", map.name) +
            cells_of_plate(p, small, map.values, enough, colour, "") +
            legend(small.X(p.x.back()) + 20, from, range, colour);
    bottom = from + height - 24;
    ++number;
  }
  return {text, bottom};
}

/// A ring at each support of w, whose area is its reaction: dashed where it pulls down. With what the largest
/// is.
template <class Spot>
drawn rings_of_reactions(const structure_picture& s, Spot spot_of) {
  constexpr double largest_ring = 11.0;
  std::map<int, double> at;
  const load now = load_path(s.what).at(s.at.step, s.at.fraction);
  const std::vector<double> all = reactions(s.what, now, s.at.displacement, s.at.isep);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const support& held = s.what.supports[i]; held.dof == 0 && s.shown.has_support_at(held.node))
      at[held.node] += all[i];
  double most = 0.0;
  for (const auto& [node, force] : at) most = std::max(most, std::abs(force));
  if (most == 0.0) return {};
  drawn rings{"", most};
  for (const auto& [node, force] : at) {
    const double r = largest_ring * std::sqrt(std::abs(force) / most);
    const auto [x, y] = spot_of(node);
    rings.text += element("circle",
                          fmt::format(R"(cx="{:.1f}" cy="{:.1f}" r="{:.1f}" class="reaction"{})", x, y, r,
                                      force < 0 ? R"( stroke-dasharray="2 2")" : ""),
                          title(fmt::format("reaction {:.6g}{}", force, unit_words(s.what, "force"))));
  }
  return rings;
}

/// A plate from above.
drawn draw_plate(const plate& p, structure_picture s) {
  const double wide = p.x.back() - p.x.front();
  const double per_unit = std::min((page_width - 330) / wide, 430 / (p.y.back() - p.y.front()));
  s.X = {p.x.front(), per_unit, side};
  s.Y = {p.y.back(), -per_unit, picture_top + 14};
  s.bottom = s.Y(p.y.front());
  std::vector<double> shown;
  for (const int j : s.shown.rows) {
    for (const int i : s.shown.columns) shown.push_back(s.w_of(p.node_at(i, j)));
  }
  const span_of range = finite_range(shown).value_or(span_of{0.0, 0.0});
  const bool flat = range.most == range.least;  // without load there is the mesh to see
  const auto colour = [&](double w) { return colour_of(flat ? 1.0 : (w - range.least) / range.range()); };
  const auto spot_of = [&](int node) {
    const place at = place_of_node(s.what.geometry, node);
    return spot{s.X(at.x), s.Y(at.y)};
  };
  const double r = std::clamp(per_unit * wide / p.columns() * 0.25, 1.5, 6.0);
  std::string supports;  // of w
  for (const support& held : s.what.supports) {
    if (held.dof != 0 || !s.shown.has_support_at(held.node)) continue;
    const auto [x, y] = spot_of(held.node);
    supports += path(fmt::format("M{:.1f} {:.1f}l5 9h-10z", x, y), "support");
  }
  std::vector<double> w;
  w.reserve(p.nodes());
  for (int node = 0; node < p.nodes(); ++node) w.push_back(s.w_of(node));
  const double below = std::max(s.bottom, picture_top + 260) + 30;
  const auto [rings, largest] = rings_of_reactions(s, spot_of);
  const std::string said = rings.empty() ? ""
                                         : fmt::format("; rings: reactions, the largest {:.4g}{}", largest,
                                                       unit_words(s.what, "force"));
  const drawn maps = flat ? drawn{"", below} : draw_maps(p, s, below + 10);
  return {
      text_at(side, picture_top, "strong",
              fmt::format("{} from above: {}the pairs{}", s.state, flat ? "" : "deflection w, and ", said)) +
          cells_of_plate(p, s, w, 32, colour, flat ? "#c4c0b5" : "") + supports + rings +
          element("g", R"(class="map")", "\n" + s.marks(r, spot_of)) +
          (flat ? "" : legend(s.X(p.x.back()) + 40, picture_top + 14, range, colour)) +
          axis_below(s.X, p.x.front(), p.x.back(), s.bottom) + maps.text,
      maps.bottom};
}

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
    std::string text = text_at(side, picture_top, "strong",
                               fmt::format("{} ({}), displacement × {:.6g}", state, view_.words, magnified));
    text += path(edges(0.0), "was") + path(edges(magnified), "member");
    if (shown.edges.empty()) text += points();
    text += path(crosses(), "thin") + supports();
    for (const int i : shown.pairs) text += pair(i);
    return {text, bottom + 24};
  }

 private:
  /// Room for the structure as it was, and for all displacements around it.
  void fit() {
    constexpr double most_height = 430.0;
    constexpr double share_of_displacements = 0.12;  // of the picture's size, for the largest of them
    span_of x;
    span_of y;
    for (const int node : shown.nodes) {
      x.take(view_.x_of(places_.nodes[node].at));
      y.take(view_.y_of(places_.nodes[node].at));
    }
    const double size = std::max({x.most - x.least, y.most - y.least, 0.0});
    // By the whole path: a structure that came back is drawn where it was.
    if (shown.reach > 0.0 && size > 0.0) magnified = round_down(share_of_displacements * size / shown.reach);
    const double room = std::max(magnified * shown.reach, 0.02 * size);
    for (span_of* s : {&x, &y}) {
      s->take(s->least - room);
      s->take(s->most + room);
    }
    const double per_unit = std::min((page_width - 2 * side) / x.range(), most_height / y.range());
    X = {(x.least + x.most) / 2, per_unit, page_width / 2};
    Y = {y.most, -per_unit, picture_top + 34};
    bottom = Y(y.least) + 20;
  }

  /// A node on the page, its displacement magnified so many times.
  [[nodiscard]] spot displaced(int node, double times) const {
    const in_space u = reading_at(of_node_[node].along, at);
    in_space p = places_.nodes[node].at;
    for (int axis = 0; axis < 3; ++axis) p[axis] += times * u[axis];
    return {X(view_.x_of(p)), Y(view_.y_of(p))};
  }

  [[nodiscard]] std::string edges(double times) const {
    std::string d;
    for (const int i : shown.edges) {
      const spot a = displaced(places_.edges[i].from, times);
      const spot b = displaced(places_.edges[i].to, times);
      d += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x, a.y, b.x, b.y);
    }
    return d;
  }

  [[nodiscard]] std::string points() const {
    std::string text;
    for (const int node : shown.nodes) {
      const spot s = displaced(node, magnified);
      text += circle(s.x, s.y, 1.6, R"(class="node")");
    }
    return text;
  }

  /// A cross at each node that has no dof.
  [[nodiscard]] std::string crosses() const {
    std::string d;
    for (const int node : shown.nodes) {
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
    for (const support& s : what.supports) {
      const placed_dof& d = places_.dofs[s.node];
      if (d.node < 0 || !shown.has_support_at(s.node)) continue;
      const spot p = displaced(d.node, magnified);
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
    const contact_pair& p = what.pairs[i];
    const placed_dof& d = places_.dofs[p.node];
    if (d.node < 0) return "";
    const spot node = displaced(d.node, magnified);
    std::string marked = mark_of_pair(what, at, i, node, 5.0);
    const spot t = axis_on_page(d);
    if (t.x == 0 && t.y == 0) return marked;
    // The face is drawn beside the node, along which it has no end; one that is too far away, at the edge.
    constexpr double far = 90.0;
    const double scale = magnified * X.per_unit * std::hypot(seen(d).x, seen(d).y);
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
drawn draw_table(const structure_picture& s) {
  constexpr std::size_t most_rows = 40;
  constexpr double row_height = 22.0;
  const auto number = [](double x) { return fmt::format("{:.6g}", x); };
  const auto label = [&s](int node) { return cut(place_name(s.what.geometry, node)); };
  double y = picture_top;
  std::string text =
      text_at(side, y, "strong", fmt::format("{}: no coordinates are known, so this is a table", s.state));
  text += table_row(y += 30, "quiet", {"pair", "dof", "state", "displacement", "gap", "force"});
  text += table_row(y += row_height, "plain",
                    {"", label(s.shown.watched), "moves most on the path", number(s.w_of(s.shown.watched))});
  const std::size_t rows = std::min(most_rows, s.shown.pairs.size());
  for (std::size_t k = 0; k < rows; ++k) {
    const int i = s.shown.pairs[k];
    const pair_reading r = reading_of(s.what, s.at, i);
    text += table_row(y += row_height, "plain",
                      {std::to_string(i + 1), label(s.what.pairs[i].node), std::string(look_words(r.look)),
                       number(r.w), number(r.gap), number(r.force)});
  }
  if (rows < s.what.pairs.size())
    text +=
        text_at(side, y += row_height, "quiet", fmt::format("and {} pairs more", s.what.pairs.size() - rows));
  return {text, y + 16};
}

}  // namespace

std::string mark_of_pair(const problem& p, const frame& f, int pair, const spot& at, double r) {
  const contact_pair& of = p.pairs[pair];
  const bool closed = f.closed(pair);
  const pair_reading now = reading_of(p, f, pair);
  const std::string words =
      title(fmt::format("pair {}, {}, face {} at {:.6g}, {}: {} {:.6g}", pair + 1,
                        place_words(p.geometry, of.node), surface_name(of.surface), of.face,
                        look_words(now.look), closed ? "force" : "gap", closed ? now.force : now.gap));
  if (now.look == pair_look::open) return circle(at.x, at.y, r, R"(class="open")", words);
  if (now.look == pair_look::closed)
    return rectangle(at.x - r, at.y - r, 2 * r, 2 * r, R"(class="closed")", words);
  return path(fmt::format("M{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}z", at.x, at.y - 1.3 * r,
                          1.3 * r, 1.3 * r, -1.3 * r, 1.3 * r, -1.3 * r, -1.3 * r),
              "face", words);
}

drawn draw_structure(const structure_picture& s) {
  const model& m = s.what.geometry;
  if (const auto* b = std::get_if<beam>(&m.kind)) return draw_beam(*b, s);
  if (const auto* p = std::get_if<plate>(&m.kind)) return draw_plate(*p, s);
  const placed_nodes& places = std::get<assembled>(m.kind).places;
  return places.known() ? mesh_picture(places, s).whole() : draw_table(s);
}

}  // namespace contct::write
