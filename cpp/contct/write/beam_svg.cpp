// A beam from the side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/write/frame_numbers.hpp"
#include "contct/write/structure_svg.hpp"

namespace contct::svg {
namespace {

constexpr double side = 60.0;  // left and right of the beam

class beam_picture {
 public:
  beam_picture(const problem& p, const beam& b, const frame& f, const shown_parts& shown)
      : problem_(p),
        beam_(b),
        frame_(f),
        shown_(shown),
        X_{b.x.front(), (page_width - 2 * side) / (b.x.back() - b.x.front()), side} {
    const span_of w = reach();
    constexpr double room = 170.0;
    magnified_ = w.most > w.least ? round_down(room / (w.range() * X_.per_unit)) : 1.0;
    Y_ = {w.most, -magnified_ * X_.per_unit, picture_top + 34};
    bottom_ = Y_(w.least) + 44;
    half_ =
        std::clamp((page_width - 2 * side) / static_cast<double>(shown.pairs.size() + 1) * 0.36, 1.0, 14.0);
  }

  [[nodiscard]] drawn whole() const {
    return {
        text_at(side, picture_top, "strong", fmt::format("Final state, deflection × {:.6g}", magnified_)) +
            line(X_(beam_.x.front()), Y_(0), X_(beam_.x.back()), Y_(0), "undeformed") + faces() +
            fmt::format("<path d=\"{}\" class=\"beam\"/>\n", curve()) + supports() + pairs() +
            axis_below(X_, beam_.x.front(), beam_.x.back(), bottom_),
        bottom_ + 30};
  }

 private:
  [[nodiscard]] double x_of(int node) const { return X_(beam_.x[static_cast<std::size_t>(node)]); }
  [[nodiscard]] double w_of(int node) const {
    return deflection_of(problem_, frame_, static_cast<std::size_t>(node));
  }

  /// What has to fit in: the beam, where it was, and the faces that are not too far away.
  [[nodiscard]] span_of reach() const {
    span_of w;
    w.take(0.0);
    for (const int node : shown_.nodes) w.take(w_of(node));
    const double largest = std::max(std::abs(w.least), std::abs(w.most));
    for (const std::size_t i : shown_.pairs) {
      const double face = problem_.pairs[i].face;
      if (std::abs(face) <= 2.5 * largest || largest == 0.0) w.take(face);
    }
    return w;
  }

  /// Hatched on the side away from the beam; one that is too far away stands at the edge.
  [[nodiscard]] std::string faces() const {
    std::string text;
    for (const std::size_t i : shown_.pairs) {
      const contact_pair& p = problem_.pairs[i];
      const double x = x_of(p.node);
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
    std::string path;
    double x0 = 0.0;
    double w0 = 0.0;
    double slope0 = 0.0;
    for (const int node : shown_.nodes) {
      const double x = beam_.x[static_cast<std::size_t>(node)];
      const double w = w_of(node);
      const double slope = frame_.displacement[static_cast<std::size_t>(node) * 2 + 1];
      const double third = (x - x0) / 3;
      path += path.empty()
                  ? fmt::format("M{:.2f} {:.2f}", X_(x), Y_(w))
                  : fmt::format("C{:.2f} {:.2f} {:.2f} {:.2f} {:.2f} {:.2f}", X_(x0 + third),
                                Y_(w0 + third * slope0), X_(x - third), Y_(w - third * slope), X_(x), Y_(w));
      x0 = x;
      w0 = w;
      slope0 = slope;
    }
    return path;
  }

  [[nodiscard]] std::string supports() const {
    std::string text;
    for (const support& s : problem_.supports) {
      if (!std::binary_search(shown_.supports.begin(), shown_.supports.end(), s.node)) continue;
      const double x = x_of(s.node);
      const double y = Y_(w_of(s.node));
      text += s.dof == 0 ? fmt::format("<path d=\"M{:.1f} {:.1f}l8 13h-16z\" class=\"support\"/>\n", x, y + 2)
                         : line(x, y - 13, x, y + 13, "clamp");
    }
    return text;
  }

  [[nodiscard]] std::string pairs() const {
    const double r = std::clamp(half_ * 0.5, 1.6, 5.0);
    std::string text;
    for (const std::size_t i : shown_.pairs) {
      const int node = problem_.pairs[i].node;
      text += mark_of_pair(problem_, frame_, i, x_of(node), Y_(w_of(node)), r);
    }
    return text;
  }

  const problem& problem_;
  const beam& beam_;
  const frame& frame_;
  const shown_parts& shown_;
  scale X_;
  scale Y_{};
  double magnified_ = 1.0;
  double bottom_ = 0.0;
  double half_ = 0.0;  // of a face
};

}  // namespace

drawn draw_beam(const problem& p, const beam& b, const frame& f, const shown_parts& shown) {
  return beam_picture(p, b, f, shown).whole();
}

}  // namespace contct::svg
