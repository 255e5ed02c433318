// A structure from elsewhere, in the view that shows most.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/write/run_svg.hpp"
#include "contct/write/words.hpp"

namespace contct::write::svg {
namespace {

constexpr double most_height = 430.0;
constexpr double share_of_displacements = 0.12;  // of the picture's size, for the largest of them
constexpr double face_half = 13.0;
constexpr int hatches = 4;

class mesh_picture {
 public:
  mesh_picture(const placed_nodes& places, const shown_state& s)
      : places_(places), state_(s), of_node_(dofs_of_nodes(places)), view_(view_at(fitting_view(places))) {
    fit();
  }

  [[nodiscard]] drawn whole() const {
    std::string text =
        text_at(side, picture_top, "strong",
                fmt::format("Final state ({}), displacement × {:.6g}", view_.words, magnified_));
    text += path(edges(0.0), "was") + path(edges(magnified_), "member");
    if (state_.shown.edges.empty()) text += points();
    text += path(crosses(), "thin") + supports();
    for (const int i : state_.shown.pairs) text += pair(i);
    return {text, bottom_ + 24};
  }

 private:
  /// Room for the structure as it was, and for all displacements around it.
  void fit() {
    span_of x;
    span_of y;
    for (const int node : state_.shown.nodes) {
      x.take(view_.x_of(places_.nodes[node].at));
      y.take(view_.y_of(places_.nodes[node].at));
    }
    const double size = std::max({x.most - x.least, y.most - y.least, 0.0});
    // By the whole path: a structure that came back is drawn where it was.
    const double reach = state_.shown.reach;
    magnified_ = reach > 0.0 && size > 0.0 ? round_down(share_of_displacements * size / reach) : 1.0;
    const double room = std::max(magnified_ * reach, 0.02 * size);
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
    const in_space u = reading_at(of_node_[node].along, state_.at);
    in_space p = places_.nodes[node].at;
    for (int axis = 0; axis < 3; ++axis) p[axis] += times * u[axis];
    return {X_(view_.x_of(p)), Y_(view_.y_of(p))};
  }

  [[nodiscard]] std::string edges(double times) const {
    std::string d;
    for (const int i : state_.shown.edges) {
      const spot a = displaced(places_.edges[i].from, times);
      const spot b = displaced(places_.edges[i].to, times);
      d += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x, a.y, b.x, b.y);
    }
    return d;
  }

  [[nodiscard]] std::string points() const {
    std::string text;
    for (const int node : state_.shown.nodes) {
      const spot s = displaced(node, magnified_);
      text += circle(s.x, s.y, 1.6, R"(class="node")");
    }
    return text;
  }

  /// A cross at each node that has no dof.
  [[nodiscard]] std::string crosses() const {
    std::string d;
    for (const int node : state_.shown.nodes) {
      if (of_node_[node] != dofs_of_node{}) continue;
      const spot s = displaced(node, 0.0);
      d += fmt::format("M{:.1f} {:.1f}l6 6m-6 0l6 -6", s.x - 3, s.y - 3);
    }
    return d;
  }

  /// An axis on the page, of length 1; {0, 0} where it points at the eye, and for rotations.
  [[nodiscard]] spot axis_on_page(const placed_dof& d) const {
    if (!d.is_length()) return {0, 0};
    in_space unit{};
    unit[d.direction - 1] = 1.0;
    const spot on_page{view_.x_of(unit), -view_.y_of(unit)};
    const double length = std::hypot(on_page.x, on_page.y);
    return length < 0.1 ? spot{0, 0} : spot{on_page.x / length, on_page.y / length};
  }

  /// How long a displacement of 1 along an axis, from 1, is on the page.
  [[nodiscard]] double pixels(int direction) const {
    in_space unit{};
    unit[direction - 1] = 1.0;
    return magnified_ * X_.per_unit * std::hypot(view_.x_of(unit), view_.y_of(unit));
  }

  /// A triangle behind the node in each direction in which it is held, a square where it cannot turn.
  [[nodiscard]] std::string supports() const {
    const std::vector<int>& shown = state_.shown.supports;
    std::string text;
    for (const support& s : state_.what.supports) {
      const placed_dof& d = places_.dofs[s.node];
      if (d.node < 0 || !std::binary_search(shown.begin(), shown.end(), s.node)) continue;
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
    const contact_pair& p = state_.what.pairs[i];
    const placed_dof& d = places_.dofs[p.node];
    if (d.node < 0) return "";
    const spot node = displaced(d.node, magnified_);
    std::string mark = mark_of_pair(state_, i, node, 5.0);
    const spot t = axis_on_page(d);
    if (t.x == 0 && t.y == 0) return mark;
    // The face is drawn beside the node, along which it has no end; one that is too far away, at the edge.
    constexpr double far = 90.0;
    const double scale = pixels(d.direction);
    const double away = std::clamp(scale * p.face, -far, far) - scale * state_.w_of(p.node);
    const spot m{node.x + away * t.x, node.y + away * t.y};
    std::string text = line(m.x - face_half * t.y, m.y + face_half * t.x, m.x + face_half * t.y,
                            m.y - face_half * t.x, "surface");
    for (int hatch = 0; hatch < hatches; ++hatch) {
      const double k = 2 - face_half + 6 * hatch;
      const spot from{m.x + k * t.y, m.y - k * t.x};
      text += line(from.x, from.y, from.x + p.surface * 6 * t.x - 3 * t.y,
                   from.y + p.surface * 6 * t.y + 3 * t.x, "hatch");
    }
    return text + mark;
  }

  const placed_nodes& places_;
  const shown_state& state_;
  std::vector<dofs_of_node> of_node_;
  const structure_view& view_;
  scale X_{};
  scale Y_{};
  double magnified_ = 1.0;
  double bottom_ = 0.0;
};

/// A label fit for a column, cut between characters.
std::string cut(std::string label) {
  constexpr std::size_t longest = 26;
  if (label.size() <= longest) return label;
  std::size_t end = longest - 3;
  while (end > 0 && (static_cast<unsigned char>(label[end]) & 0xC0U) == 0x80U) --end;
  return label.substr(0, end) + "...";
}

constexpr double columns[] = {side, 130, 330, 500, 620, 740};
constexpr double row_height = 22.0;

std::string table_row(double y, std::string_view kind, const std::vector<std::string>& cells) {
  std::string text;
  for (std::size_t i = 0; i < cells.size(); ++i) text += text_at(columns[i], y, kind, cells[i]);
  return text;
}

}  // namespace

drawn draw_mesh(const placed_nodes& places, const shown_state& s) {
  return mesh_picture(places, s).whole();
}

drawn draw_table(const shown_state& s) {
  constexpr std::size_t most_rows = 40;
  const auto number = [](double x) { return fmt::format("{:.6g}", x); };
  const auto label = [&s](int node) { return cut(place_name(s.what.geometry, node)); };
  double y = picture_top;
  std::string text = text_at(side, y, "strong", "Final state: no coordinates are known, so this is a table");
  text += table_row(y += 30, "quiet", {"pair", "dof", "state", "displacement", "gap", "force"});
  text += table_row(y += row_height, "plain",
                    {"", label(s.shown.watched), "moves most on the path", number(s.w_of(s.shown.watched))});
  const std::size_t rows = std::min(most_rows, s.shown.pairs.size());
  for (std::size_t k = 0; k < rows; ++k) {
    const int i = s.shown.pairs[k];
    const pair_reading r = reading_of(s.what, s.at, i);
    text += table_row(y += row_height, "plain",
                      {std::to_string(i + 1), label(s.what.pairs[i].node), std::string(look_name(r.look)),
                       number(r.w), number(r.gap), number(r.force)});
  }
  if (rows < s.what.pairs.size())
    text +=
        text_at(side, y += row_height, "quiet", fmt::format("and {} pairs more", s.what.pairs.size() - rows));
  return {text, y + 16};
}

}  // namespace contct::write::svg
