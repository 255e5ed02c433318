// The 1989 way: assemble, factor and solve in every increment.
#pragma once

#include "contct/solve/engine.hpp"
#include "contct/solve/factored_stiffness.hpp"

namespace contct {

/// Copies the band, adds the springs now in contact, and factors (dpbtrf) whenever asked.
/// Memory: two bands, the structure's own and the factor.
class refactor_engine final : public stiffness_engine {
 public:
  explicit refactor_engine(const linear_structure& s);
  [[nodiscard]] std::string_view name() const override { return "refactor"; }
  void switch_spring(int pair, bool closed) override;
  void respond(const residual_load& residual, std::span<double> d_star) override;
  void recover(std::span<const double> load, std::span<const double> pair_forces,
               std::span<double> u) override;
  [[nodiscard]] double reciprocal_condition() override;
  [[nodiscard]] engine_counts counts() const override { return counts_; }

 private:
  const linear_structure& structure_;
  std::vector<char> closed_;  // [pairs]
  factored_stiffness stiffness_;
  std::vector<double> w_star_;  // [dofs]
  engine_counts counts_;
};

}  // namespace contct
