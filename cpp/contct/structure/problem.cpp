#include "contct/structure/problem.hpp"

#include <utility>

#include "contct/numeric/rational.hpp"

namespace contct::structure {
namespace {

element_results table_of(const beam& b, const load& l, std::span<const double> u) {
  element_results r{{"shear", "moment"}, 2, {}};
  for (const element_forces& e : forces_in_elements(b, l, u))
    r.values.insert(r.values.end(), {e.shear[0], e.shear[1], e.moment[0], e.moment[1]});
  return r;
}

element_results table_of(const plate& p, const load& /*l*/, std::span<const double> u) {
  element_results r{{"mx", "my", "mxy"}, 4, {}};
  for (const corner_moments& e : moments_in_elements(p, u))
    for (const auto& quantity : {e.mx, e.my, e.mxy})
      r.values.insert(r.values.end(), quantity.begin(), quantity.end());
  return r;
}

element_results table_of(const assembled& /*a*/, const load& /*l*/, std::span<const double> /*u*/) {
  return {};  // a matrix has no elements
}

resultant sum_of(const beam& b, const load& l) {
  return rigid_truth(b).resultant_of(l);
}

resultant sum_of(const plate& p, const load& l) {
  return rigid_truth(p).resultant_of(l);
}

resultant sum_of(const assembled& /*a*/, const load& l) {
  numeric::rational sum;
  for (const point_load& p : l.points) sum += numeric::decimal_of(p.value);
  return {numeric::rounded(sum), {}};
}

}  // namespace

linear_structure build(const model& m, std::span<const support> supports, std::vector<contact_pair> pairs) {
  return std::visit([&](const auto& kind) { return build(kind, supports, std::move(pairs)); }, m.kind);
}

void add_consistent_loads(const model& m, const load& l, std::span<double> f) {
  std::visit([&](const auto& kind) { add_consistent_loads(kind, l, f); }, m.kind);
}

std::vector<double> tributary_shares(const model& m) {
  return std::visit([](const auto& kind) { return tributary_shares(kind); }, m.kind);
}

std::vector<double> reactions(const model& m, const load& l, std::span<const support> supports,
                              std::span<const double> u) {
  return std::visit([&](const auto& kind) { return reactions(kind, l, supports, u); }, m.kind);
}

element_results results_in_elements(const model& m, const load& l, std::span<const double> u) {
  return std::visit([&](const auto& kind) { return table_of(kind, l, u); }, m.kind);
}

resultant resultant_of(const model& m, const load& l) {
  return std::visit([&](const auto& kind) { return sum_of(kind, l); }, m.kind);
}

}  // namespace contct::structure
