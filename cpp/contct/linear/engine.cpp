#include "contct/linear/engine.hpp"

#include "contct/linear/mpi_job.hpp"
#include "contct/linear/spring_engine.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

/// As in 1989: every response adds the springs of the pairs in contact to a copy of K and factors the sum as
/// a band (dpbtrf). Memory: K, its copy and the factor.
class refactor_engine final : public spring_engine {
 public:
  explicit refactor_engine(const linear_system& s)
      : spring_engine(s, usual_factor(s.stiffness)), w_star_(s.dofs()) {}

  void respond(const residual_load& residual, std::span<double> d_star) override {
    factor_wanted();
    for (std::size_t i = 0; i < w_star_.size(); ++i) w_star_[i] = residual.share * residual.increment[i];
    stiffness_.solve(w_star_);
    gather_at_pairs(structure_, w_star_, d_star);
  }

 private:
  /// Counts the factorisation and the solve that follows.
  void factor_wanted() override {
    stiffness_.factor(apply_all());
    ++counts_.factors;
    ++counts_.solves;
  }

  std::vector<double> w_star_;  // [dofs]
};

}  // namespace

mpi_job*& joined_job() {
  static mpi_job* job = nullptr;  // MPI allows one job per process
  return job;
}

std::vector<std::string> engine_names() {
  std::vector<std::string> names = {"refactor", "updated", "condensed"};
  if (joined_job() != nullptr) names.emplace_back("petsc");
  return names;
}

std::string_view quickest_engine(const linear_system& s) {
  return can_be_condensed(s) ? "condensed" : "updated";
}

std::unique_ptr<stiffness_engine> make_engine(std::string_view name, const linear_system& s) {
  if (name == "refactor") return std::make_unique<refactor_engine>(s);
  if (name == "updated") return make_updated_engine(s, quickest_factor(s));
  if (name == "condensed") return make_condensed_engine(s);
  if (name != "petsc" || joined_job() == nullptr) {
    const std::vector<std::string> names = engine_names();
    throw std::invalid_argument("no engine is named " + in_quotes(name) + did_you_mean(name, names) +
                                "; allowed: " + joined(names, ", "));
  }
  if (s.has_pairs_of_two())
    throw std::invalid_argument(
        "engine \"petsc\": found a pair between two dofs; allowed: pairs with a fixed face. "
        "--engine updated allows all pairs");
  return make_updated_engine(s, joined_job()->share(s.stiffness));
}

}  // namespace contct
