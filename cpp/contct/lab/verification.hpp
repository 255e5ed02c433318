// The numbers that the problems in reference/ are checked against.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contct/path/observer.hpp"
#include "contct/structure/problem.hpp"

namespace contct {

/// One number of reference/verification.toml, whose head explains the fields. Nodes, elements and
/// pairs count from 1, as in the file; 0 where a quantity does not need them.
struct expected_number {
  int step = 0;
  std::string quantity;
  int node = 0, pair = 0, element = 0;
  int place = 0;  ///< in the element: its end, 1 the left one, or its corner
  std::string dof, change, along;
  double from = 0.0;
  double value = 0.0;  ///< of a state: -1 in contact, +1 separated
  std::string kind, because, source;
  double tolerance = 0.0;          ///< relative; absolute for a value of 0
  std::optional<double> faithful;  ///< what the 1989 rule gives instead
  std::string reason;              ///< why it does
};

/// One problem file and its numbers.
struct verification_case {
  std::string file;  ///< as written, relative to reference/problems
  std::vector<expected_number> checks;
};

/// Read the table. Throws input_error.
[[nodiscard]] std::vector<verification_case> read_verification(const std::string& path);

/// Observes a run and measures, afterwards, what the table asks for.
class measurement final : public observer {
 public:
  /// `p` must outlive this object.
  explicit measurement(const problem& p) : problem_(p) {}

  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

  /// The quantity as this run has it; NaN when the run did not get there.
  [[nodiscard]] double of(const expected_number& e) const;

 private:
  struct step_record {
    std::vector<double> u;
    std::vector<int> isep;
    element_results elements;
    std::vector<double> reactions;
  };
  struct event_record {
    int step;
    double fraction;
    event what;
  };
  [[nodiscard]] static double of_element(const expected_number& e, std::size_t quantity,
                                         const step_record& s);
  [[nodiscard]] double of_support(const expected_number& e, const step_record& s) const;
  [[nodiscard]] double of_pair(const expected_number& e, const step_record& s) const;
  [[nodiscard]] double of_events(const expected_number& e) const;
  [[nodiscard]] double zero_right_of(const expected_number& e, const step_record& s) const;

  const problem& problem_;
  std::vector<step_record> steps_;
  std::vector<event_record> events_;
};

/// Is `measured` within the tolerance of `value`?
[[nodiscard]] bool agrees(double measured, double value, double tolerance);

}  // namespace contct
