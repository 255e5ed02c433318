// A beam from the side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/write/run_svg.hpp"

namespace contct::write::svg {
namespace {

/// What has to fit in: the beam, where it was, and the faces that are not too far away.
span_of reach_of(const shown_state& s) {
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

class beam_picture {
 public:
  beam_picture(const beam& b, const shown_state& s)
      : beam_(b), state_(s), X_{b.x.front(), (page_width - 2 * side) / (b.x.back() - b.x.front()), side} {
    const span_of w = reach_of(s);
    constexpr double room = 170.0;
    magnified_ = w.most > w.least ? round_down(room / (w.range() * X_.per_unit)) : 1.0;
    Y_ = {w.most, -magnified_ * X_.per_unit, picture_top + 34};
    bottom_ = Y_(w.least) + 44;
    half_ =
        std::clamp((page_width - 2 * side) / static_cast<double>(s.shown.pairs.size() + 1) * 0.36, 1.0, 14.0);
  }

  [[nodiscard]] drawn whole() const {
    return {
        text_at(side, picture_top, "strong", fmt::format("Final state, deflection × {:.6g}", magnified_)) +
            line(X_(beam_.x.front()), Y_(0), X_(beam_.x.back()), Y_(0), "undeformed") + faces() +
            path(curve(), "beam") + supports() + pairs() +
            axis_below(X_, beam_.x.front(), beam_.x.back(), bottom_),
        bottom_ + 30};
  }

 private:
  [[nodiscard]] spot spot_of(int node) const { return {X_(beam_.x[node]), Y_(state_.w_of(node))}; }

  /// Hatched on the side away from the beam; one that is too far away stands at the edge.
  [[nodiscard]] std::string faces() const {
    std::string text;
    for (const int i : state_.shown.pairs) {
      const contact_pair& p = state_.what.pairs[i];
      const double x = X_(beam_.x[p.node]);
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
    for (const int node : state_.shown.nodes) {
      const double x = beam_.x[node];
      const double w = state_.w_of(node);
      const double slope = state_.at.displacement[2 * node + 1];
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
    const std::vector<int>& shown = state_.shown.supports;
    std::string text;
    for (const support& s : state_.what.supports) {
      if (!std::binary_search(shown.begin(), shown.end(), s.node)) continue;
      const auto [x, y] = spot_of(s.node);
      text += s.dof == 0 ? path(fmt::format("M{:.1f} {:.1f}l8 13h-16z", x, y + 2), "support")
                         : line(x, y - 13, x, y + 13, "clamp");
    }
    return text;
  }

  [[nodiscard]] std::string pairs() const {
    const double r = std::clamp(half_ * 0.5, 1.6, 5.0);
    std::string text;
    for (const int i : state_.shown.pairs)
      text += mark_of_pair(state_, i, spot_of(state_.what.pairs[i].node), r);
    return text;
  }

  const beam& beam_;
  const shown_state& state_;
  scale X_;
  scale Y_{};
  double magnified_ = 1.0;
  double bottom_ = 0.0;
  double half_ = 0.0;  // of a face
};

}  // namespace

drawn draw_beam(const beam& b, const shown_state& s) {
  return beam_picture(b, s).whole();
}

}  // namespace contct::write::svg
