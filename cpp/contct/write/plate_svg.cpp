// A plate from above.
#include <fmt/format.h>

#include <algorithm>

#include "contct/write/run_svg.hpp"

namespace contct::write::svg {
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
  plate_picture(const plate& p, const shown_state& s)
      : plate_(p),
        state_(s),
        per_unit_(
            std::min((page_width - 330) / (p.x.back() - p.x.front()), 430 / (p.y.back() - p.y.front()))),
        X_{p.x.front(), per_unit_, side},
        Y_{p.y.back(), -per_unit_, picture_top + 14} {
    for (const int j : s.shown.rows) {
      for (const int i : s.shown.columns) range_.take(w_at(i, j));
    }
  }

  [[nodiscard]] drawn whole() const {
    const std::vector<int>& columns = state_.shown.columns;
    const std::vector<int>& rows = state_.shown.rows;
    const double bottom = Y_(plate_.y.front());
    std::string text =
        text_at(side, picture_top, "strong", "Final state from above: deflection w, and the pairs");
    for (std::size_t b = 0; b + 1 < rows.size(); ++b) {
      for (std::size_t a = 0; a + 1 < columns.size(); ++a)
        text += cell(columns[a], columns[a + 1], rows[b], rows[b + 1]);
    }
    text += pairs() + legend() + axis_below(X_, plate_.x.front(), plate_.x.back(), bottom);
    return {text, std::max(bottom, picture_top + 260) + 30};
  }

 private:
  [[nodiscard]] double w_at(int i, int j) const { return state_.w_of(plate_.node_at(i, j)); }
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
    const double spacing = per_unit_ * (plate_.x.back() - plate_.x.front()) / plate_.columns();
    const double r = std::clamp(spacing * 0.25, 1.5, 6.0);
    std::string text = "\n";
    for (const int i : state_.shown.pairs) {
      const place at = place_of_node(state_.what.geometry, state_.what.pairs[i].node);
      text += mark_of_pair(state_, i, {X_(at.x), Y_(at.y)}, r);
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
  const shown_state& state_;
  double per_unit_;
  scale X_, Y_;
  span_of range_;
};

}  // namespace

drawn draw_plate(const plate& p, const shown_state& s) {
  return plate_picture(p, s).whole();
}

}  // namespace contct::write::svg
