#include "bench/peers/compliance.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace bench::peers {
namespace {

/// As a band: these rows come in the order of a narrow one.
contct::matrix::band_matrix band_of(const contct::matrix::sparse_columns& k) {
  int width = 0;
  for (int column = 0; column < k.order(); ++column)
    width = std::max(width, k.rows[k.starts[column + 1] - 1] - column);
  contct::matrix::band_matrix band(k.order(), width);
  for (int column = 0; column < k.order(); ++column)
    for (int i = k.starts[column]; i < k.starts[column + 1]; ++i) band.at(k.rows[i], column) = k.values[i];
  return band;
}

}  // namespace

compliance::compliance(const contact_problem& p)
    : problem_(p), stiffness_(band_of(p.stiffness)), factor_(stiffness_) {
  if (!factor_.factor({})) throw std::runtime_error("the supports alone do not hold the structure");
}

complementarity compliance::complementarity_problem() {
  const auto& springs = problem_.springs;
  const std::size_t n = springs.size();
  complementarity lcp{std::vector<double>(n * n), std::vector<double>(n)};
  constexpr std::size_t at_once = 8;
  const auto order = static_cast<std::size_t>(problem_.stiffness.order());
  for (std::size_t first = 0; first < n; first += at_once) {
    const std::size_t end = std::min(n, first + at_once);
    std::vector<double> columns((end - first) * order);
    for (std::size_t j = first; j < end; ++j)
      columns[(j - first) * order + static_cast<std::size_t>(springs[j].row)] = 1.0;
    factor_.solve(columns);
    for (std::size_t j = first; j < end; ++j)
      for (std::size_t i = 0; i < n; ++i)
        lcp.m[j * n + i] = springs[i].side * springs[j].side *
                           columns[(j - first) * order + static_cast<std::size_t>(springs[i].row)];
  }
  const std::vector<double> unloaded = displacement_under(std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    lcp.m[i * n + i] += 1.0 / springs[i].stiffness;
    lcp.q[i] = -springs[i].side * (unloaded[springs[i].row] - springs[i].face);
    scale_.push_back(1.0 / std::sqrt(lcp.m[i * n + i]));
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(lcp.q[i] *= scale_[i]));
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) lcp.m[j * n + i] *= scale_[i] * scale_[j];
    lcp.q[j] /= largest;
  }
  for (double& s : scale_) s *= largest;
  return lcp;
}

std::vector<double> compliance::forces_of(const std::vector<double>& z) const {
  std::vector<double> forces(z.size());
  for (std::size_t i = 0; i < z.size(); ++i) forces[i] = scale_[i] * z[i];
  return forces;
}

std::vector<double> compliance::displacement_under(const std::vector<double>& forces) {
  std::vector<double> u = problem_.load;
  for (std::size_t i = 0; i < forces.size(); ++i)
    u[problem_.springs[i].row] -= problem_.springs[i].side * forces[i];
  factor_.solve(u);
  return u;
}

}  // namespace bench::peers
