// Siconos: the linear complementarity problem of the springs' forces.
//     u = K^-1 (load - sum of side force e),  depth = side (u - face):  0 <= force, depth <= force / k, and
//     one of the two holds with equality.
// M is dense: the compliance at the pairs, which takes a solve for every spring.
#include <LCP_Solvers.h>
#include <LinearComplementarityProblem.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <lcp_cst.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "bench/peers/compliance.hpp"

namespace {

using bench::peers::answer;

int solver_of(const std::string& method) {
  static const std::map<std::string, int> solvers = {{"lemke", SICONOS_LCP_LEMKE},
                                                     {"newton-min-fb", SICONOS_LCP_NEWTON_MIN_FBLSA},
                                                     {"pgs", SICONOS_LCP_PGS}};
  const auto found = solvers.find(method);
  if (found == solvers.end())
    throw std::invalid_argument("found method " + method + "; allowed: lemke, newton-min-fb, pgs");
  return found->second;
}

/// False where Siconos says that it failed.
bool run_solver(int id, bench::peers::complementarity& lcp, std::vector<double>& z, int& steps) {
  const int size = static_cast<int>(lcp.q.size());
  NumericsMatrix* m = NM_create_from_data(NM_DENSE, size, size, lcp.m.data());
  LinearComplementarityProblem problem{size, m, lcp.q.data()};
  SolverOptions* options = solver_options_create(id);
  options->dparam[SICONOS_DPARAM_TOL] = 1e-13;  // of q, which is scaled to 1
  options->iparam[SICONOS_IPARAM_MAX_ITER] = 100'000;
  std::vector<double> w(z.size());
  const int info = linearComplementarity_driver(&problem, z.data(), w.data(), options);
  steps = options->iparam[SICONOS_IPARAM_ITER_DONE];
  solver_options_delete(options);
  NM_clear_not_dense(m);
  return info == 0;
}

answer solve(const std::string& method, const std::string& folder) {
  const bench::peers::contact_problem p = bench::peers::read_problem(folder);
  const int solver = solver_of(method);
  answer a;
  const double start = bench::peers::process_seconds();
  bench::peers::compliance at_springs(p);
  bench::peers::complementarity lcp = at_springs.complementarity_problem();
  const double built = bench::peers::process_seconds();
  std::vector<double> z(p.springs.size());
  a.found = run_solver(solver, lcp, z, a.steps);
  a.seconds = bench::peers::process_seconds() - built;
  a.build_seconds = built - start;
  a.forces = at_springs.forces_of(z);
  a.u = at_springs.displacement_under(a.forces);
  return a;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::peers::solve_as_asked(argc, argv, solve);
}
