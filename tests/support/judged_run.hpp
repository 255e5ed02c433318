// A path with proved and judged final states, and everything that was reported about them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "contct/proof/certificate.hpp"
#include "contct/proof/exact_means.hpp"
#include "support/beams.hpp"

namespace contct {

struct judged_run : solved_path {
  /// Follows the path of `kernel`, or finds final states only if `kernel` is empty. An empty `engine` is the
  /// default engine. `also` observes the same path.
  judged_run(problem given, const std::string& kernel, bool with_exact_path = true,
             const std::string& engine = "refactor", observer* also = nullptr)
      : what(std::move(given)), structure(structure_of(what)) {
    certifier proof(what, structure, with_exact_path ? exact_means_of(what) : nullptr);
    std::vector<observer*> watching = {&seen};
    if (also != nullptr) watching.push_back(also);
    solved_path& self = *this;
    self = kernel.empty()
               ? proof.find_final_states()
               : follow(what, structure, engine.empty() ? std::string(quickest_engine(structure)) : engine,
                        *make_kernel(kernel), watching, &proof);
  }

  // Steps count from 1.
  [[nodiscard]] const certificate& of_step(std::size_t step) const {
    return steps.at(step - 1).judged.value();
  }
  [[nodiscard]] const std::vector<double>& u(std::size_t step) const {
    return steps.at(step - 1).displacement;
  }
  [[nodiscard]] const std::vector<int>& isep(std::size_t step) const { return steps.at(step - 1).isep; }
  [[nodiscard]] end_numbers numbers(std::size_t step) const {
    return with_numbers(what, steps.at(step - 1)).numbers;
  }
  [[nodiscard]] double share(std::size_t increment) const { return seen.increments.at(increment).fraction; }
  /// Returns the reactions of supports, computed from displacements.
  [[nodiscard]] std::vector<double> held(std::size_t step) const {
    return statics_of(what, what.steps.at(step - 1), u(step), isep(step)).reactions;
  }
  /// Returns the contact force of a pair, from 0, computed from displacements.
  [[nodiscard]] double force(std::size_t step, std::size_t pair) const {
    return statics_of(what, what.steps.at(step - 1), u(step), isep(step)).pair_forces.at(pair);
  }
  /// Returns true if a state of step 1 with these displacements and statuses is certified.
  [[nodiscard]] bool certifies(const std::vector<double>& displacement,
                               const std::vector<int>& statuses) const {
    return certificate_of(displacement, statuses).certified;
  }
  [[nodiscard]] certificate certificate_of(const std::vector<double>& displacement,
                                           const std::vector<int>& statuses) const {
    return certifier(what, structure)
        .certificate_of({.step = 1, .fraction = 1.0, .displacement = displacement, .isep = statuses});
  }

  problem what;
  linear_structure structure;
  recorder seen;  // the increments
};

/// Calls `check` for the path of each engine, and of the 1989 and the corrected rule, of which every final
/// state must be certified.
template <class Check>
void with_every_engine(const problem& p, const Check& check,
                       const std::vector<std::string>& kernels = {"fortran", "corrected"}) {
  for (const std::string& engine : engine_names()) {
    if (engine == "condensed" && (p.pairs.empty() || !std::holds_alternative<beam>(p.geometry.kind)))
      continue;
    for (const std::string& kernel : kernels) {
      CAPTURE(engine, kernel);
      const judged_run path(p, kernel, true, engine);
      CHECK(path.all_certified());
      REQUIRE(path.end.status == path_status::solved);
      check(path);
    }
  }
}

/// Returns a problem on a matrix.
inline problem on_matrix(sparse_matrix k, std::vector<contact_pair> pairs, std::vector<load> steps) {
  assembled a;
  a.name = "k.mtx";
  a.stiffness = std::move(k);
  problem p;
  p.geometry.kind = std::move(a);
  p.pairs = std::move(pairs);
  p.steps = std::move(steps);
  return p;
}

inline load force_at(int dof, double value) {
  return {{{dof, 0, value}}, {}};
}

/// Returns two cantilevers with 3 EI / l^3 of 3750 and 60000 and tips at a distance of 0.002. The dofs are
/// the deflection and the slope of each tip.
inline problem two_cantilevers() {
  return on_matrix({4,
                    {{0, 0, 15000},
                     {1, 0, -15000},
                     {1, 1, 20000},
                     {2, 0, 0},
                     {2, 2, 240000},
                     {3, 2, -120000},
                     {3, 3, 80000}}},
                   {{0, face_below, -0.002, 1e5, false, 2}}, {force_at(0, -15), {}, force_at(0, -15)});
}

}  // namespace contct
