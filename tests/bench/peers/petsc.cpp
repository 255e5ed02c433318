// PETSc's nonlinear solvers.
//     newton   K u + sum of k side max(0, side (u - face)) = load, by semismooth Newton with CHOLMOD
//     rsls     the complementarity problem of the springs' forces, SNESVINEWTONRSLS with a dense factor
//     ssls     the same, SNESVINEWTONSSLS
#include <petscsnes.h>

#include <stdexcept>

#include "bench/peers/compliance.hpp"

namespace {

using bench::peers::answer;
using bench::peers::contact_problem;

constexpr double relative_tolerance = 1e-13;  // of the residual; Newton ends earlier where it stagnates
constexpr int most_iterations = 500;

struct newton_data {
  const contact_problem& problem;
  Mat stiffness;
  Vec load;
};

/// K u and the springs' forces, less the load.
PetscErrorCode residual(SNES /*solver*/, Vec u, Vec r, void* data) {
  const auto& d = *static_cast<const newton_data*>(data);
  PetscCall(MatMult(d.stiffness, u, r));
  PetscCall(VecAXPY(r, -1.0, d.load));
  const PetscScalar* at = nullptr;
  PetscScalar* left = nullptr;
  PetscCall(VecGetArrayRead(u, &at));
  PetscCall(VecGetArray(r, &left));
  for (const bench::peers::one_sided_spring& s : d.problem.springs)
    if (s.side * (at[s.row] - s.face) > 0.0) left[s.row] += s.stiffness * (at[s.row] - s.face);
  PetscCall(VecRestoreArrayRead(u, &at));
  PetscCall(VecRestoreArray(r, &left));
  return 0;
}

/// K and the stiffness of the springs that press.
PetscErrorCode tangent(SNES /*solver*/, Vec u, Mat a, Mat /*same*/, void* data) {
  const auto& d = *static_cast<const newton_data*>(data);
  PetscCall(MatCopy(d.stiffness, a, SAME_NONZERO_PATTERN));
  const PetscScalar* at = nullptr;
  PetscCall(VecGetArrayRead(u, &at));
  for (const bench::peers::one_sided_spring& s : d.problem.springs)
    if (s.side * (at[s.row] - s.face) > 0.0) PetscCall(MatSetValue(a, s.row, s.row, s.stiffness, ADD_VALUES));
  PetscCall(VecRestoreArrayRead(u, &at));
  PetscCall(MatAssemblyBegin(a, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(a, MAT_FINAL_ASSEMBLY));
  return 0;
}

/// Both triangles of K by rows.
PetscErrorCode make_stiffness(const contact_problem& p, Mat* k) {
  const auto& a = p.stiffness;
  std::vector<PetscInt> count(static_cast<std::size_t>(p.rows()));
  for (int column = 0; column < p.rows(); ++column) {
    for (int i = a.starts[column]; i < a.starts[column + 1]; ++i) {
      ++count[a.rows[i]];
      if (a.rows[i] != column) ++count[column];
    }
  }
  PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, p.rows(), p.rows(), 0, count.data(), k));
  PetscCall(MatSetOption(*k, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(MatSetOption(*k, MAT_SPD, PETSC_TRUE));
  for (int column = 0; column < p.rows(); ++column) {
    for (int i = a.starts[column]; i < a.starts[column + 1]; ++i) {
      PetscCall(MatSetValue(*k, a.rows[i], column, a.values[i], INSERT_VALUES));
      if (a.rows[i] != column) PetscCall(MatSetValue(*k, column, a.rows[i], a.values[i], INSERT_VALUES));
    }
  }
  PetscCall(MatAssemblyBegin(*k, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*k, MAT_FINAL_ASSEMBLY));
  return 0;
}

PetscErrorCode use_direct_solver(SNES solver, PCType factor, MatSolverType package) {
  KSP linear = nullptr;
  PC direct = nullptr;
  PetscCall(SNESGetKSP(solver, &linear));
  PetscCall(KSPSetType(linear, KSPPREONLY));
  PetscCall(KSPGetPC(linear, &direct));
  PetscCall(PCSetType(direct, factor));
  if (package != nullptr) PetscCall(PCFactorSetMatSolverType(direct, package));
  return 0;
}

/// Solve, and take over what was found.
PetscErrorCode run(SNES solver, Vec x, answer& a, std::vector<double>& found) {
  SNESConvergedReason reason{};
  PetscInt steps = 0;
  PetscInt size = 0;
  const PetscScalar* values = nullptr;
  PetscCall(SNESSetTolerances(solver, 0.0, relative_tolerance, 0.0, most_iterations, 100 * most_iterations));
  PetscCall(SNESSolve(solver, nullptr, x));
  PetscCall(SNESGetConvergedReason(solver, &reason));
  PetscCall(SNESGetIterationNumber(solver, &steps));
  PetscCall(VecGetLocalSize(x, &size));
  PetscCall(VecGetArrayRead(x, &values));
  found.assign(values, values + size);
  PetscCall(VecRestoreArrayRead(x, &values));
  // Rounding leaves a residual above any tolerance that is chosen beforehand: the certificate judges what is
  // there then.
  a.found = reason > 0 || reason == SNES_DIVERGED_LINE_SEARCH || reason == SNES_DIVERGED_MAX_IT;
  a.steps = static_cast<int>(steps);
  return 0;
}

PetscErrorCode solve_by_newton(const contact_problem& p, answer& a) {
  Mat k = nullptr;
  Mat jacobian = nullptr;
  Vec u = nullptr;
  Vec load = nullptr;
  SNES solver = nullptr;
  PetscCall(make_stiffness(p, &k));
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, p.rows(), p.load.data(), &load));
  const double start = bench::peers::process_seconds();
  PetscCall(MatDuplicate(k, MAT_COPY_VALUES, &jacobian));
  PetscCall(VecDuplicate(load, &u));
  newton_data data{p, k, load};
  PetscCall(SNESCreate(PETSC_COMM_SELF, &solver));
  PetscCall(SNESSetType(solver, SNESNEWTONLS));
  PetscCall(SNESSetFunction(solver, nullptr, residual, &data));
  PetscCall(SNESSetJacobian(solver, jacobian, jacobian, tangent, &data));
  PetscCall(use_direct_solver(solver, PCCHOLESKY, MATSOLVERCHOLMOD));
  PetscCall(run(solver, u, a, a.u));
  a.seconds = bench::peers::process_seconds() - start;
  a.forces = bench::peers::forces_under(p, a.u);
  PetscCall(SNESDestroy(&solver));
  PetscCall(VecDestroy(&u));
  PetscCall(VecDestroy(&load));
  PetscCall(MatDestroy(&jacobian));
  PetscCall(MatDestroy(&k));
  return 0;
}

struct dense_data {
  Mat m;
  Vec q;
};

PetscErrorCode slack(SNES /*solver*/, Vec z, Vec w, void* data) {
  const auto& d = *static_cast<const dense_data*>(data);
  PetscCall(MatMultAdd(d.m, z, d.q, w));
  return 0;
}

PetscErrorCode slack_tangent(SNES /*solver*/, Vec /*z*/, Mat a, Mat /*same*/, void* data) {
  // SSLS scales the rows of what it is given.
  PetscCall(MatCopy(static_cast<const dense_data*>(data)->m, a, SAME_NONZERO_PATTERN));
  return 0;
}

PetscErrorCode solve_complementarity(const contact_problem& p, SNESType type, answer& a) {
  const double start = bench::peers::process_seconds();
  bench::peers::compliance at_springs(p);
  bench::peers::complementarity lcp = at_springs.complementarity_problem();
  const double built = bench::peers::process_seconds();
  const auto size = static_cast<PetscInt>(lcp.q.size());
  dense_data data{};
  Mat jacobian = nullptr;
  Vec z = nullptr;
  Vec w = nullptr;
  Vec none = nullptr;
  Vec endless = nullptr;
  SNES solver = nullptr;
  PetscCall(MatCreateSeqDense(PETSC_COMM_SELF, size, size, lcp.m.data(), &data.m));
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, size, lcp.q.data(), &data.q));
  PetscCall(MatDuplicate(data.m, MAT_COPY_VALUES, &jacobian));
  PetscCall(VecDuplicate(data.q, &z));
  PetscCall(VecDuplicate(data.q, &w));
  PetscCall(VecDuplicate(data.q, &none));
  PetscCall(VecDuplicate(data.q, &endless));
  PetscCall(VecSet(endless, PETSC_INFINITY));
  PetscCall(SNESCreate(PETSC_COMM_SELF, &solver));
  PetscCall(SNESSetType(solver, type));
  PetscCall(SNESSetFunction(solver, w, slack, &data));  // bounds cannot be set without a vector for it
  PetscCall(SNESSetJacobian(solver, jacobian, jacobian, slack_tangent, &data));
  PetscCall(SNESVISetVariableBounds(solver, none, endless));
  PetscCall(use_direct_solver(solver, PCLU, nullptr));
  std::vector<double> found;
  PetscCall(run(solver, z, a, found));
  a.seconds = bench::peers::process_seconds() - built;
  a.build_seconds = built - start;
  a.forces = at_springs.forces_of(found);
  a.u = at_springs.displacement_under(a.forces);
  PetscCall(SNESDestroy(&solver));
  for (Vec* v : {&z, &w, &none, &endless, &data.q}) PetscCall(VecDestroy(v));
  PetscCall(MatDestroy(&jacobian));
  PetscCall(MatDestroy(&data.m));
  return 0;
}

answer solve(const std::string& method, const std::string& folder) {
  const contact_problem p = bench::peers::read_problem(folder);
  answer a;
  PetscErrorCode failed = 0;
  if (method == "newton") {
    failed = solve_by_newton(p, a);
  } else if (method == "rsls" || method == "ssls") {
    failed = solve_complementarity(p, method == "rsls" ? SNESVINEWTONRSLS : SNESVINEWTONSSLS, a);
  } else {
    throw std::invalid_argument("found method " + method + "; allowed: newton, rsls, ssls");
  }
  if (failed != 0) throw std::runtime_error("PETSc failed");
  return a;
}

}  // namespace

int main(int argc, char** argv) {
  int none = 1;  // its options are its own: METHOD is none of them
  if (PetscInitialize(&none, &argv, nullptr, nullptr) != 0) return 1;
  const int status = bench::peers::solve_as_asked(argc, argv, solve);
  return PetscFinalize() == 0 ? status : 1;
}
