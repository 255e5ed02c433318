// The 1989 way: assemble, factor and solve in every increment.
#pragma once

#include "contct/solve/factored_stiffness.hpp"
#include "contct/solve/spring_engine.hpp"

namespace contct::solve {

/// Copies the band, adds the springs now in contact, and factors (dpbtrf) at every response.
/// Memory: two bands, the structure's own and the factor.
class refactor_engine final : public spring_engine {
 public:
  explicit refactor_engine(const linear_structure& s);
  [[nodiscard]] std::string_view name() const override { return "refactor"; }
  void respond(const residual_load& residual, std::span<double> d_star) override;
  void recover(std::span<const double> load, std::span<const double> pair_forces,
               std::span<double> u) override;
  [[nodiscard]] double reciprocal_condition() override;

 private:
  void factor();

  factored_stiffness stiffness_;
  std::vector<double> w_star_;  // [dofs]
};

}  // namespace contct::solve
