// CHOLMOD's sparse factor, updated and downdated as springs go in and out. Built where the library is found.
#pragma once

#include <memory>

#include "contct/solve/engine.hpp"

namespace contct {

/// Keeps L D L^T of K in an order of little fill. A toggle changes the factor by one column (cholmod_updown);
/// a response is one solve with it. On a schedule that the drift sets, the residual is looked at, in long
/// double, and the factor made anew when a correction by it is not small.
/// Memory: the factor, and K once more without its zeros.
class cholmod_engine final : public stiffness_engine {
 public:
  explicit cholmod_engine(const linear_structure& s);
  ~cholmod_engine() override;
  cholmod_engine(const cholmod_engine&) = delete;
  cholmod_engine& operator=(const cholmod_engine&) = delete;
  cholmod_engine(cholmod_engine&&) = delete;
  cholmod_engine& operator=(cholmod_engine&&) = delete;

  [[nodiscard]] std::string_view name() const override { return "cholmod"; }
  void switch_spring(int pair, bool closed) override;
  void respond(const residual_load& residual, std::span<double> d_star) override;
  void recover(std::span<const double> load, std::span<const double> pair_forces,
               std::span<double> u) override;
  [[nodiscard]] double reciprocal_condition() override;
  [[nodiscard]] engine_counts counts() const override;

 private:
  class sparse;  // all that needs the library's header
  std::unique_ptr<sparse> sparse_;
};

}  // namespace contct
