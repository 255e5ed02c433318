#include "contct/session/envelope_curves.hpp"

#include <limits>
#include <string_view>
#include <vector>

namespace contct {
namespace {

/// Into how many parts an element is divided.
int parts_of(const beam& b) {
  constexpr int enough = 480;
  return (enough + b.elements() - 1) / b.elements();
}

/// The places, with values that those of any state replace.
envelope_curves begun(const beam& b) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  envelope_curves all;
  const int parts = parts_of(b);
  for (int e = 0; e < b.elements(); ++e)
    for (int k = 0; k <= parts; ++k)
      all.x.push_back(k == parts ? b.x[e + 1] : b.x[e] + b.length_of(e) * k / parts);
  for (const std::string_view name : {"w", "moment", "shear"})
    all.curves.push_back({name, {all.x.size(), {{infinite}, {-infinite}}}});
  return all;
}

/// Takes the values of one state. Those at the ends of elements are not computed from the polynomials.
void take(envelope_curves& all, const beam& b, const beam_lines& lines, const structure_state& s) {
  const int parts = parts_of(b);
  std::size_t place = 0;
  for (int e = 0; e < b.elements(); ++e) {
    const std::vector<element_line> pieces = lines.pieces(e);
    auto piece = pieces.begin();
    const double* const u = &s.displacement[std::size_t{beam::dofs_per_node} * e];
    for (int k = 0; k <= parts; ++k, ++place) {
      while (piece + 1 != pieces.end() && all.x[place] > piece->right) ++piece;
      const double t = (all.x[place] - piece->left) / piece->h;
      const auto take_one = [&](std::size_t quantity, const auto& polynomial, double left, double right) {
        const double inside = polynomial_at(polynomial, t);
        const double value = k == 0 ? left : k == parts ? right : inside;
        envelope::range<double>& known = all.curves[quantity].at[place];
        if (value < known.least.value) known.least = {value, s.step, s.number};
        if (value > known.most.value) known.most = {value, s.step, s.number};
      };
      take_one(0, piece->w, u[0], u[2]);
      take_one(1, piece->moment, lines.ends().at(e, 1)[0], lines.ends().at(e, 1)[1]);
      take_one(2, piece->shear, lines.ends().at(e, 0)[0], lines.ends().at(e, 0)[1]);
    }
  }
}

}  // namespace

envelope_curves curves_of(const run_result& r) {
  const auto* const b = std::get_if<beam>(&r.what.geometry.kind);
  if (b == nullptr) return {};
  envelope_curves all;
  for_each_state_of_envelope(r, [&](const structure_state& s, const load& l) {
    if (all.x.empty()) all = begun(*b);
    const auto known = s.numbers ? s.numbers->element_values : std::vector<double>{};
    take(all, *b, beam_lines(*b, l, s.displacement, known), s);
  });
  return all;
}

}  // namespace contct
