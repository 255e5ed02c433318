// The result of a run, from which all outputs are made: what was recorded, and how the run ended.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contct/results/free_run.hpp"
#include "contct/results/mesh_error.hpp"
#include "contct/results/path_observers.hpp"
#include "contct/structure/problem.hpp"
#include "contct/structure/structure.hpp"
#include "contct/text/strings.hpp"

namespace contct {

struct rule_1989;  // contct/results/rule_1989.hpp

/// The comparison of the path of another kernel with that of the leader.
struct compared_path {
  std::string kernel;
  free_run_difference difference;
  bool certified;
  std::string distances;  ///< the differences in words
};

/// The largest change of a quantity, by its key, if the element size is halved: see changes_between.
struct mesh_change {
  std::string_view kind;
  double change = 0.0;
  double of = 0.0;                   ///< the largest number of this quantity on the finer mesh
  std::optional<double> order = {};  ///< of a plate: by what power of the element size two halvings change it
  std::optional<double> error =
      {};        ///< an estimate of the mesh's error, if the order shows that it converges
  int step = 0;  ///< that with this change
};

struct run_result : recorded_path {
  /// `p` and its structure `s` must outlive this object.
  run_result(const problem& p, const linear_structure& s) : what(p), structure(s) {}

  const problem& what;
  const linear_structure& structure;
  early_toggles early;
  std::string file;                  ///< the path of the problem file as given
  std::vector<std::string> kernels;  ///< the leader first; for both rules, the 1989 kernels last
  std::string engine;
  std::optional<lockstep_on_path> compared;  ///< empty: no kernel was compared call by call
  std::shared_ptr<const rule_1989> beside;   ///< null: not a run of both rules, or the answer is not_factored
  std::vector<compared_path> free_runs;
  bool equal = true;
  /// [steps of the record] what is proved about the mesh of a beam with beds; empty otherwise
  std::vector<mesh_error> mesh;
  std::vector<mesh_change> refined;  ///< empty: not requested, or not solved on both meshes
  std::string comparison;            ///< how far the kernels agree, in words; empty for a single kernel
  std::vector<std::string> facts;    ///< version, listing, floating point
  std::string date;                  ///< date of the run in UTC; may be empty
  bool envelope = false;             ///< an envelope is requested

  /// The status as written in results: "solved", "kernels-disagree", ..
  [[nodiscard]] std::string_view status() const;
  /// The call-by-call comparison of kernels; in a run of both rules, on the 1989 path. Null if there is no
  /// comparison.
  [[nodiscard]] const lockstep_on_path* compared_calls() const;
  /// The record of the path whose calls are kept: the leader's path; in a run of both rules, the 1989 path.
  [[nodiscard]] const run_recorder& record_of_calls() const;
};

/// Formats the counts of a comparison: "8 calls, 64 values compared, 0 mismatches".
template <class Comparing>
[[nodiscard]] std::string counts_of(const Comparing& c) {
  return fmt::format("{}, {} compared, {}", counted(c.calls(), "call"), counted(c.compared().values, "value"),
                     counted(c.compared().mismatches, "mismatch"));
}

/// The problem's title, or the name of its file.
[[nodiscard]] std::string title_of(const problem& p, const std::string& file);

/// Returns the problem with every element of a beam divided in two, or of a plate in four. Loads, supports
/// and [[contact]] keep their places, and beds the places where they end. On a plate, a dof of a new node is
/// fixed if it is fixed at all neighbours, and settles by their mean. Throws std::invalid_argument for a
/// matrix.
[[nodiscard]] problem refined(const problem& p);

/// Returns the largest difference, in any step, of each quantity of two solved meshes: the extremes, the
/// forces of [[contact]], the numbers of beds, and the reactions of a beam.
[[nodiscard]] std::vector<mesh_change> changes_between(const run_result& coarse, const run_result& fine);
/// Estimates the mesh's errors from the changes by two halvings of the element size; see
/// reference/mesh-error.md.
void estimate_errors(std::vector<mesh_change>& by_first, const std::vector<mesh_change>& by_second);

}  // namespace contct
