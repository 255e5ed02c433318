#include "contct/session/envelope_curves.hpp"

#include <limits>
#include <span>

namespace contct {
namespace {

/// Into how many parts an element is divided.
int parts_of(const beam& b) {
  constexpr int enough = 480;
  return (enough + b.elements() - 1) / b.elements();
}

/// Takes the values of one state, place by place and quantity by quantity.
class curves_of_state {
 public:
  curves_of_state(envelope_curves& all, const structure_state& s) : all_(all), state_(s) {}

  void add(const beam_lines& lines, const beam& b, int e) {
    const element_line line = lines.at(e);
    const auto shears = lines.ends().at(e, 0);
    const auto moments = lines.ends().at(e, 1);
    const std::vector<double>& u = state_.displacement;
    take(0, line.w, u[2 * e], u[2 * e + 2], parts_of(b));
    take(1, line.moment, moments[0], moments[1], parts_of(b));
    take(2, line.shear, shears[0], shears[1], parts_of(b));
    place_ += parts_of(b) + 1;
  }

 private:
  /// The ends of an element are not computed from its polynomial.
  void take(std::size_t quantity, std::span<const double> polynomial, double left, double right, int parts) {
    for (int k = 0; k <= parts; ++k) {
      const double inside = polynomial_at(polynomial, static_cast<double>(k) / parts);
      const double value = k == 0 ? left : k == parts ? right : inside;
      envelope::range<double>& known = all_.curves[quantity].at[place_ + k];
      if (value < known.least.value) known.least = {value, state_.step, state_.number};
      if (value > known.most.value) known.most = {value, state_.step, state_.number};
    }
  }

  envelope_curves& all_;
  const structure_state& state_;
  std::size_t place_ = 0;
};

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

}  // namespace

envelope_curves curves_of(const run_result& r) {
  const auto* const b = std::get_if<beam>(&r.what.geometry.kind);
  if (b == nullptr) return {};
  envelope_curves all;
  for_each_state_of_envelope(r, [&](const structure_state& s, const load& l) {
    if (all.x.empty()) all = begun(*b);
    const beam_lines lines(*b, l, s.displacement,
                           s.numbers ? s.numbers->element_values : std::vector<double>{});
    curves_of_state now(all, s);
    for (int e = 0; e < b->elements(); ++e) now.add(lines, *b, e);
  });
  return all;
}

}  // namespace contct
