#include "contct/structure/load.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace contct::structure {
namespace {

/// Sums loads that act at the same place.
class mixture {
 public:
  void add(const load& part, double share) {
    for (const point_load& p : part.points) points_[{p.node, p.dof}] += share * p.value;
    for (const distributed_load& d : part.distributed) {
      std::vector<double>& sum = distributed_[d.elements];
      sum.resize(std::max(sum.size(), d.polynomial.size()), 0.0);
      for (std::size_t i = 0; i < d.polynomial.size(); ++i) sum[i] += share * d.polynomial[i];
    }
  }

  [[nodiscard]] load total() const {
    load sum;
    for (const auto& [place, value] : points_) sum.points.push_back({place.first, place.second, value});
    for (const auto& [elements, polynomial] : distributed_) sum.distributed.push_back({polynomial, elements});
    return sum;
  }

 private:
  std::map<std::pair<int, int>, double> points_;
  std::map<std::vector<int>, std::vector<double>> distributed_;
};

}  // namespace

load mix(const load& before, const load& after, double fraction) {
  if (fraction == 1.0) return after;
  mixture sum;
  sum.add(before, 1.0 - fraction);
  sum.add(after, fraction);
  return sum.total();
}

void add_point_loads(const load& l, int dofs_per_node, std::span<double> f) {
  for (const point_load& p : l.points) f[p.node * dofs_per_node + p.dof] += p.value;
}

double polynomial_at(std::span<const double> coefficients, double x) {
  double sum = 0.0;
  for (std::size_t i = coefficients.size(); i-- > 0;) sum = sum * x + coefficients[i];
  return sum;
}

std::vector<double> tributary_lengths(std::span<const double> x) {
  std::vector<double> lengths(x.size(), 0.0);
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double half = (x[i + 1] - x[i]) / 2;
    lengths[i] += half;
    lengths[i + 1] += half;
  }
  return lengths;
}

}  // namespace contct::structure
