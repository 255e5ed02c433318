// A structure from elsewhere, in the view that shows most.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/text/markup.hpp"
#include "contct/write/frame_numbers.hpp"
#include "contct/write/mesh_numbers.hpp"
#include "contct/write/structure_svg.hpp"

namespace contct::svg {
namespace {

constexpr double side = 60.0;
constexpr double most_height = 430.0;
constexpr double share_of_displacements = 0.12;  // of the picture's size, for the largest of them
constexpr double face_half = 13.0;
constexpr int hatches = 4;

struct spot {
  double x, y;
};

class mesh_picture {
 public:
  mesh_picture(const problem& p, const placed_nodes& places, const frame& f, const shown_parts& shown)
      : problem_(p),
        places_(places),
        frame_(f),
        shown_(shown),
        of_node_(dofs_of_nodes(places)),
        view_(view_at(fitting_view(places))) {
    fit();
  }

  [[nodiscard]] drawn whole() const {
    std::string text =
        text_at(side, picture_top, "strong",
                fmt::format("Final state ({}), displacement × {:.6g}", view_.words, magnified_));
    text += edges("was", 0.0) + edges("member", magnified_);
    if (shown_.edges.empty()) text += points();
    text += still_nodes() + supports();
    for (const std::size_t i : shown_.pairs) text += pair(i);
    return {text, bottom_ + 24};
  }

 private:
  /// Room for the structure as it was, and for all displacements around it.
  void fit() {
    span_of x;
    span_of y;
    for (const int node : shown_.nodes) {
      x.take(view_.x_of(at(node)));
      y.take(view_.y_of(at(node)));
    }
    const double size = std::max({x.most - x.least, y.most - y.least, 0.0});
    // By the whole path: a structure that came back is drawn where it was.
    magnified_ =
        shown_.reach > 0.0 && size > 0.0 ? round_down(share_of_displacements * size / shown_.reach) : 1.0;
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

  [[nodiscard]] in_space at(int node) const { return places_.nodes[static_cast<std::size_t>(node)].at; }
  [[nodiscard]] in_space displacement(int node) const {
    return reading_at(of_node_[static_cast<std::size_t>(node)].along, frame_);
  }
  [[nodiscard]] spot on_page(const in_space& p) const { return {X_(view_.x_of(p)), Y_(view_.y_of(p))}; }
  [[nodiscard]] spot displaced(int node, double times) const {
    const in_space u = displacement(node);
    in_space p = at(node);
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += times * u[axis];
    return on_page(p);
  }

  [[nodiscard]] std::string edges(std::string_view kind, double times) const {
    std::string path;
    for (const int i : shown_.edges) {
      const mesh_edge& e = places_.edges[static_cast<std::size_t>(i)];
      const spot a = displaced(e.from, times);
      const spot b = displaced(e.to, times);
      path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x, a.y, b.x, b.y);
    }
    return path.empty() ? "" : fmt::format("<path d=\"{}\" class=\"{}\"/>\n", path, kind);
  }

  [[nodiscard]] std::string points() const {
    std::string text;
    for (const int node : shown_.nodes) {
      const spot s = displaced(node, magnified_);
      text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.6\" class=\"node\"/>\n", s.x, s.y);
    }
    return text;
  }

  /// A cross at each node that has no dof.
  [[nodiscard]] std::string still_nodes() const {
    std::string path;
    for (const int node : shown_.nodes) {
      if (of_node_[static_cast<std::size_t>(node)] != dofs_of_node{}) continue;
      const spot s = displaced(node, 0.0);
      path += fmt::format("M{:.1f} {:.1f}l6 6m-6 0l6 -6", s.x - 3, s.y - 3);
    }
    return path.empty() ? "" : fmt::format("<path d=\"{}\" class=\"thin\"/>\n", path);
  }

  /// An axis on the page, of length 1 where it does not point at the eye.
  [[nodiscard]] spot axis_on_page(int direction) const {
    in_space unit{};
    unit.at(static_cast<std::size_t>(direction - 1)) = 1.0;
    const spot d{view_.x_of(unit), -view_.y_of(unit)};
    const double length = std::hypot(d.x, d.y);
    return length < 0.1 ? spot{0, 0} : spot{d.x / length, d.y / length};
  }

  /// How long a displacement of 1 along an axis is on the page.
  [[nodiscard]] double pixels(int direction) const {
    in_space unit{};
    unit.at(static_cast<std::size_t>(direction - 1)) = 1.0;
    return magnified_ * X_.per_unit * std::hypot(view_.x_of(unit), view_.y_of(unit));
  }

  /// A triangle behind the node in each direction in which it is held, a square where it cannot turn.
  [[nodiscard]] std::string supports() const {
    std::string text;
    for (const support& s : problem_.supports) {
      const placed_dof& d = places_.dofs[static_cast<std::size_t>(s.node)];
      if (d.node < 0 || !std::binary_search(shown_.supports.begin(), shown_.supports.end(), s.node)) continue;
      const spot p = displaced(d.node, magnified_);
      const spot t = d.is_length() ? axis_on_page(d.direction) : spot{0, 0};
      if (t.x == 0 && t.y == 0) {
        text += fmt::format("<path d=\"M{:.1f} {:.1f}h9v9h-9z\" class=\"support\"/>\n", p.x - 4.5, p.y - 4.5);
      } else {
        text += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}z\" class=\"support\"/>\n",
                            p.x, p.y, p.x - 12 * t.x - 6 * t.y, p.y - 12 * t.y + 6 * t.x,
                            p.x - 12 * t.x + 6 * t.y, p.y - 12 * t.y - 6 * t.x);
      }
    }
    return text;
  }

  /// Its face across its direction, hatched behind, and its mark at the node.
  [[nodiscard]] std::string pair(std::size_t i) const {
    const contact_pair& p = problem_.pairs[i];
    const placed_dof& d = places_.dofs[static_cast<std::size_t>(p.node)];
    if (d.node < 0) return "";
    const spot node = displaced(d.node, magnified_);
    std::string mark = mark_of_pair(problem_, frame_, i, node.x, node.y, 5.0);
    const spot t = d.is_length() ? axis_on_page(d.direction) : spot{0, 0};
    if (t.x == 0 && t.y == 0) return mark;
    // The face is drawn beside the node, along which it has no end; one that is too far away, at the edge.
    constexpr double far = 90.0;
    const double w = deflection_of(problem_, frame_, static_cast<std::size_t>(p.node));
    const double away = std::clamp(pixels(d.direction) * p.face, -far, far) - pixels(d.direction) * w;
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

  const problem& problem_;
  const placed_nodes& places_;
  const frame& frame_;
  const shown_parts& shown_;
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

constexpr double columns[] = {60, 130, 330, 500, 620, 740};
constexpr double row_height = 22.0;

std::string table_row(double y, std::string_view kind, const std::vector<std::string>& cells) {
  std::string text;
  for (std::size_t i = 0; i < cells.size(); ++i) text += text_at(columns[i], y, kind, cells[i]);
  return text;
}

}  // namespace

drawn draw_mesh(const problem& p, const placed_nodes& places, const frame& f, const shown_parts& shown) {
  return mesh_picture(p, places, f, shown).whole();
}

drawn draw_table(const problem& p, const frame& f, const shown_parts& shown) {
  constexpr std::size_t most_rows = 40;
  const auto number = [](double x) { return fmt::format("{:.6g}", x); };
  double y = picture_top;
  std::string text = text_at(60, y, "strong", "Final state: no coordinates are known, so this is a table");
  text += table_row(y += 30, "quiet", {"pair", "dof", "state", "displacement", "gap", "force"});
  text += table_row(y += row_height, "plain",
                    {"", cut(place_name(p.geometry, static_cast<int>(shown.watched))),
                     "moves most on the path", number(deflection_of(p, f, shown.watched))});
  const std::size_t rows = std::min(most_rows, shown.pairs.size());
  for (std::size_t k = 0; k < rows; ++k) {
    const std::size_t i = shown.pairs[k];
    const pair_reading r = reading_of(p, f, i);
    text += table_row(y += row_height, "plain",
                      {std::to_string(i + 1), cut(place_name(p.geometry, p.pairs[i].node)), words_of(r.look),
                       number(r.w), number(r.gap), number(r.force)});
  }
  if (rows < p.pairs.size())
    text += text_at(60, y += row_height, "quiet", fmt::format("and {} pairs more", p.pairs.size() - rows));
  return {text, y + 16};
}

}  // namespace contct::svg
