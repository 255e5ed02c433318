#include "contct/structure/load.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace contct {
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

}  // namespace contct
