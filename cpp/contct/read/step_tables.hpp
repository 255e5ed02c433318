// The [[step]]s of a problem file: loads and settlements.
#pragma once

#include <vector>

#include "contct/read/named_files.hpp"
#include "contct/read/node_reader.hpp"

namespace contct {

/// As many coefficients as a polynomial may have.
inline constexpr std::size_t most_coefficients = 21;

/// The coefficients under the key "polynomial", the constant first: a beam's load, or a face along it, in x
/// as the nodes have it. Of other structures it is refused; allowed is what is said in `elsewhere`.
[[nodiscard]] std::vector<double> read_polynomial(const toml_value& t, const model& m,
                                                  std::string_view elsewhere);

/// Reads one step after the other.
class step_reader {
 public:
  /// `files` finds those that a step names; `warnings` gets those about their numbers. `nodes` and it must
  /// outlive this object.
  step_reader(const node_reader& nodes, const std::vector<support>& supports, named_files files,
              std::vector<std::string>& warnings);

  [[nodiscard]] load read(const toml_value& t) const;

 private:
  enum class hold : char { none, spring, fixed };

  void read_vector(const toml_value& t, load& l) const;
  void read_uniform(const toml_value& t, load& l) const;
  [[nodiscard]] distributed_load read_distributed(const toml_value& t) const;
  void read_points(const toml_value& t, load& l) const;
  void read_settlements(const toml_value& t, load& l) const;
  void refuse_unfixed(const toml_value& t, int node, int dof) const;

  const node_reader& nodes_;
  named_files files_;
  std::vector<std::string>& warnings_;
  std::vector<hold> held_;  // [dofs] by supports
};

}  // namespace contct
