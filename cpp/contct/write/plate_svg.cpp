// A plate from above.
#include <fmt/format.h>

#include <algorithm>

#include "contct/write/frame_numbers.hpp"
#include "contct/write/structure_svg.hpp"

namespace contct::svg {
namespace {

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

class plate_picture {
 public:
  plate_picture(const problem& p, const plate& of, const frame& f, const shown_parts& shown)
      : problem_(p),
        plate_(of),
        frame_(f),
        shown_(shown),
        per_unit_(
            std::min((page_width - 330) / (of.x.back() - of.x.front()), 430 / (of.y.back() - of.y.front()))),
        X_{of.x.front(), per_unit_, 60.0},
        Y_{of.y.back(), -per_unit_, picture_top + 14} {
    for (const int j : shown.rows) {
      for (const int i : shown.columns) range_.take(w_at(i, j));
    }
  }

  [[nodiscard]] drawn whole() const {
    const double bottom = Y_(plate_.y.front());
    std::string text =
        text_at(60, picture_top, "strong", "Final state from above: deflection w, and the pairs");
    for (std::size_t b = 0; b + 1 < shown_.rows.size(); ++b) {
      for (std::size_t a = 0; a + 1 < shown_.columns.size(); ++a)
        text += rectangle(shown_.columns[a], shown_.columns[a + 1], shown_.rows[b], shown_.rows[b + 1]);
    }
    text += pairs() + colours();
    text += axis_below(X_, plate_.x.front(), plate_.x.back(), bottom);
    return {text, std::max(bottom, picture_top + 260) + 30};
  }

 private:
  [[nodiscard]] double w_at(int i, int j) const {
    return deflection_of(problem_, frame_, static_cast<std::size_t>(plate_.node_at(i, j)));
  }
  [[nodiscard]] std::string colour(double w) const { return colour_of((w - range_.least) / range_.range()); }

  /// Between two columns and two rows, in the colour of its mean.
  [[nodiscard]] std::string rectangle(int from, int to, int low, int high) const {
    const double mean = (w_at(from, low) + w_at(to, low) + w_at(to, high) + w_at(from, high)) / 4;
    const double left = X_(plate_.x[static_cast<std::size_t>(from)]);
    const double top = Y_(plate_.y[static_cast<std::size_t>(high)]);
    return fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" stroke=\"{}\"/>\n",
        left, top, X_(plate_.x[static_cast<std::size_t>(to)]) - left,
        Y_(plate_.y[static_cast<std::size_t>(low)]) - top, colour(mean), colour(mean));
  }

  [[nodiscard]] std::string pairs() const {
    const double spacing = per_unit_ * (plate_.x.back() - plate_.x.front()) / plate_.columns();
    const double r = std::clamp(spacing * 0.25, 1.5, 6.0);
    std::string text = "<g class=\"map\">\n";
    for (const std::size_t i : shown_.pairs) {
      const place at = place_of_node(problem_.geometry, problem_.pairs[i].node);
      text += mark_of_pair(problem_, frame_, i, X_(at.x), Y_(at.y), r);
    }
    return text + "</g>\n";
  }

  /// What the colours mean.
  [[nodiscard]] std::string colours() const {
    const double left = X_(plate_.x.back()) + 40;
    std::string text;
    for (int i = 0; i <= 10; ++i) {
      const double w = range_.most - (range_.most - range_.least) * i / 10;
      const double top = picture_top + 14 + 20.0 * i;
      text += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"20\" height=\"20\" fill=\"{}\"/>\n", left,
                          top, colour(w));
      if (i % 5 == 0) text += text_at(left + 28, top + 15, "quiet", fmt::format("{:.4g}", w));
    }
    return text;
  }

  const problem& problem_;
  const plate& plate_;
  const frame& frame_;
  const shown_parts& shown_;
  double per_unit_;
  scale X_, Y_;
  span_of range_;
};

}  // namespace

drawn draw_plate(const problem& p, const plate& of, const frame& f, const shown_parts& shown) {
  return plate_picture(p, of, f, shown).whole();
}

}  // namespace contct::svg
