#include "contct/lab/atlas.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "contct/lab/epsmul_variants.hpp"
#include "contct/outside/registry.hpp"

namespace contct::lab {
namespace {

std::unique_ptr<kernel> kernel_of(const atlas_cell& c) {
  if (!has_other_epsmul(c)) return make_kernel(c.kernel);
  const std::vector<double> known = epsmul_of_variants();
  const auto at = std::find(known.begin(), known.end(), c.epsmul);
  if (at == known.end()) throw std::invalid_argument("no copy of the listing has that EPSMUL");
  return make_epsmul_variant(at - known.begin());
}

template <class Wanted>
std::vector<atlas_cell> cells_that(const atlas& a, Wanted wanted) {
  std::vector<atlas_cell> cells;
  std::copy_if(a.cells.begin(), a.cells.end(), std::back_inserter(cells), wanted);
  return cells;
}

}  // namespace

void atlas_cell::add(const problem_result& t) {
  const bool mechanism = t.came_to == verdict::false_mechanism;
  const bool endless = t.came_to == verdict::no_end;
  ++problems;
  false_equilibrium += t.unfounded > 0 ? 1 : 0;
  false_mechanism += mechanism ? 1 : 0;
  never_held += mechanism && t.increments == 0 ? 1 : 0;
  no_end += endless ? 1 : 0;
  uncertified += mechanism || endless || t.uncertified > 0 ? 1 : 0;
  if (t.length_error <= wrong_beyond && t.unfounded == 0) return;
  ++wrong;
  errors.insert(std::upper_bound(errors.begin(), errors.end(), t.displacement_error), t.displacement_error);
}

double median_error(const atlas_cell& c) {
  return c.errors.empty() ? 0.0 : c.errors[c.errors.size() / 2];
}

double worst_error(const atlas_cell& c) {
  return c.errors.empty() ? 0.0 : c.errors.back();
}

bool has_other_epsmul(const atlas_cell& c) {
  return c.epsmul != 0.0 && c.epsmul != printed_epsmul;
}

confidence wilson(int hits, int tried) {
  constexpr double z = 1.959963984540054;  // the normal distribution has 95 % between -z and z
  const double n = tried;
  const double middle = (hits + z * z / 2) / (n + z * z);
  const double half = z / (n + z * z) * std::sqrt(hits * (n - hits) / n + z * z / 4);
  return {hits == 0 ? 0.0 : middle - half, hits == tried ? 1.0 : middle + half};
}

std::vector<atlas_cell> atlas_cells() {
  std::vector<atlas_cell> cells;
  for (const bool held : {true, false}) {
    for (int decade = -12; decade <= 12; decade += 2) {
      const double unit = std::pow(10.0, decade);
      cells.push_back({"fortran", printed_epsmul, unit, held});
      cells.push_back({"fortran-r4", printed_epsmul, unit, held});
      cells.push_back({"corrected", 0.0, unit, held});
    }
    for (const double unit : epsmul_units) {
      for (const double epsmul : epsmul_of_variants()) cells.push_back({"fortran", epsmul, unit, held});
    }
  }
  return cells;
}

std::vector<atlas_cell> over_unit(const atlas& a, bool held) {
  return cells_that(a, [held](const atlas_cell& c) { return c.held == held && !has_other_epsmul(c); });
}

std::vector<atlas_cell> over_epsmul(const atlas& a, bool held, double unit) {
  return cells_that(a, [held, unit](const atlas_cell& c) {
    return c.held == held && c.kernel == "fortran" && c.unit == unit;
  });
}

void fill(atlas_cell& c, const atlas_request& r, const std::function<void()>& tried) {
  random_problem_kind kind;
  kind.least_unit = kind.most_unit = c.unit;
  kind.free_share = c.held ? 0.0 : 1.0;
  for (int number = 0; number < r.problems; ++number) {
    const std::unique_ptr<kernel> fresh = kernel_of(c);  // a kernel may keep state between calls
    c.add(try_problem(make_random_problem(r.seed, number, kind), *fresh));
    if (tried) tried();
  }
}

}  // namespace contct::lab
