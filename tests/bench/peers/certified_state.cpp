#include "bench/peers/certified_state.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <stdexcept>

namespace bench::peers {

void write_state(const std::string& folder, const certified_state& s) {
  std::ofstream out(folder + "/state.txt");
  out << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const double b : s.bounds) out << b << ' ';
  out << s.u.size() << ' ' << s.forces.size() << '\n';
  for (std::size_t i = 0; i < s.u.size(); ++i)
    out << s.u[i] << ' ' << int{s.deflects[i]} << ' ' << s.places[i].node << ' ' << s.places[i].direction
        << '\n';
  for (const double f : s.forces) out << f << '\n';
  if (!out.flush()) throw std::runtime_error(folder + "/state.txt cannot be written");
}

certified_state read_state(const std::string& folder) {
  std::ifstream in(folder + "/state.txt");
  certified_state s;
  for (double& b : s.bounds) in >> b;
  std::size_t rows = 0, springs = 0;
  in >> rows >> springs;
  for (std::size_t i = 0; i < rows && in; ++i) {
    double u = 0.0;
    int deflects = 0;
    place at;
    in >> u >> deflects >> at.node >> at.direction;
    s.u.push_back(u);
    s.deflects.push_back(deflects != 0 ? 1 : 0);
    s.places.push_back(at);
  }
  for (std::size_t i = 0; i < springs && in; ++i) {
    double f = 0.0;
    in >> f;
    s.forces.push_back(f);
  }
  if (!in || rows == 0) throw std::runtime_error(folder + "/state.txt cannot be read");
  return s;
}

namespace {

/// Pairs that press here and not there. Solvers of complementarity problems leave a force of rounding where
/// there is none: what is below a share of the largest is no force.
int wrong_statuses(const certified_state& s, const answer& a, double largest) {
  constexpr double rounding = 1e-9;
  int wrong = 0;
  for (std::size_t i = 0; i < s.forces.size(); ++i) {
    const bool should = s.forces[i] > rounding * largest;
    const bool does = a.forces[i] > rounding * largest;
    if (should != does) ++wrong;
  }
  return wrong;
}

}  // namespace

verdict judge(const certified_state& s, const answer& a) {
  if (a.u.size() != s.u.size() || a.forces.size() != s.forces.size())
    throw std::runtime_error("an answer has other numbers of displacements or forces than the problem");
  std::array<double, kinds> size{};
  std::array<double, kinds> off{};
  verdict v;
  const auto compare = [&](kind k, double right, double theirs) {
    size[k] = std::max(size[k], std::abs(right));
    if (k != force && std::isnan(theirs)) return;  // CalculiX does not print slopes
    const double distance = std::abs(right - theirs);
    off[k] = std::max(off[k], std::isnan(distance) ? std::numeric_limits<double>::infinity() : distance);
    ++v.values;
  };
  for (std::size_t i = 0; i < s.u.size(); ++i)
    compare(s.deflects[i] != 0 ? deflection : other_displacement, s.u[i], a.u[i]);
  for (std::size_t i = 0; i < s.forces.size(); ++i) {
    compare(force, s.forces[i], a.forces[i]);
  }
  v.statuses = wrong_statuses(s, a, size[force]);
  double worst = 1e-15;
  for (int k = 0; k < kinds; ++k) {
    if (size[k] == 0.0) continue;
    worst = std::max(worst, (off[k] + s.bounds[k]) / size[k]);
  }
  v.digits = worst < 1.0 ? -std::log10(worst) : 0.0;
  return v;
}

}  // namespace bench::peers
