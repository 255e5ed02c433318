#include "contct/solve/engine.hpp"

#include <algorithm>

#include "contct/solve/mpi_job.hpp"
#include "contct/solve/spring_engine.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

mpi_job* job_of_this_process = nullptr;  // MPI allows one job per process

/// As in 1989: every response copies the band, adds the springs of the pairs in contact and factors the sum
/// (dpbtrf). Memory: the band and its factor.
class refactor_engine final : public spring_engine {
 public:
  explicit refactor_engine(const linear_structure& s) : spring_engine(s), w_star_(s.dofs()) {}

  void respond(const residual_load& residual, std::span<double> d_star) override {
    factor();
    for (std::size_t i = 0; i < w_star_.size(); ++i) w_star_[i] = residual.share * residual.increment[i];
    stiffness_.solve(w_star_);
    gather_at_pairs(structure_, w_star_, d_star);
  }

  void recover(std::span<const double> load, std::span<const double> pair_forces,
               std::span<double> u) override {
    factor();
    solve_for_all(load, pair_forces, u);
  }

 private:
  /// Factors K with the wanted springs. Counts the factorisation and the solve that follows.
  void factor() {
    stiffness_.factor(apply_all());
    ++counts_.factors;
    ++counts_.solves;
  }

  std::vector<double> w_star_;  // [dofs]
};

}  // namespace

mpi_job* joined_job() {
  return job_of_this_process;
}

void set_joined_job(mpi_job* job) {
  job_of_this_process = job;
}

std::vector<std::string> engine_names() {
  std::vector<std::string> names = {"refactor", "updated", "condensed"};
  if (joined_job() != nullptr) names.emplace_back("petsc");
  return names;
}

std::string_view quickest_engine(const linear_structure& s) {
  return can_be_condensed(s) ? "condensed" : "updated";
}

void refuse_unknown_engine(std::string_view name) {
  const std::vector<std::string> names = engine_names();
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  throw std::invalid_argument("no engine is named \"" + std::string(name) + "\"" + did_you_mean(name, names) +
                              "; allowed: " + joined(names, ", "));
}

std::unique_ptr<stiffness_engine> make_engine(std::string_view name, const linear_structure& s) {
  refuse_unknown_engine(name);
  if (name == "condensed") return make_condensed_engine(s);
  if (name == "updated") return make_updated_engine(s, quickest_factor(s));
  if (name == "petsc" && has_pairs_of_two(s))
    throw std::invalid_argument(
        "engine \"petsc\": found a pair between two dofs; allowed: pairs with a fixed face. "
        "--engine updated allows all pairs");
  if (name == "petsc") return make_updated_engine(s, factored_by::ranks);
  return std::make_unique<refactor_engine>(s);
}

}  // namespace contct
