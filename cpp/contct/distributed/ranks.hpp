// The ranks of an MPI job, which factor and solve one stiffness together. The program itself links neither
// MPI nor PETSc: a module that is loaded on demand (contct/distributed/module.hpp) implements this.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contct/matrix/remote_matrix.hpp"
#include "contct/matrix/sparse_factor.hpp"
#include "contct/matrix/stiffness_matrix.hpp"
#include "contct/rooms.hpp"

namespace contct::structure {
struct plate;
}

namespace contct::distributed {

/// All ranks of the job, as one of them sees them. Rank 0 runs the program; the others serve it: each keeps
/// its rows of every matrix that rank 0 distributes, and its part of the factor. Any function may end the
/// job, with a message, where a rank fails alone and the others could not know.
class ranks {
 public:
  ranks() = default;
  virtual ~ranks() = default;
  ranks(const ranks&) = delete;
  ranks& operator=(const ranks&) = delete;

  [[nodiscard]] virtual int own() const = 0;  ///< from 0
  [[nodiscard]] virtual int count() const = 0;

  /// Other ranks than 0: do what rank 0 says, until it leaves.
  virtual void serve() = 0;

  /// Rank 0: distribute `a` by rows and find the order in which it is factored. What comes back must be
  /// destroyed before `leave`. Throws std::bad_alloc, and std::runtime_error for any other failure that all
  /// ranks know of.
  [[nodiscard]] virtual std::unique_ptr<matrix::sparse_factor> distribute(
      const matrix::sparse_columns& a) = 0;

  /// Rank 0: a plate's stiffness, of which each rank assembles its own rows. Throws std::invalid_argument
  /// where a number of it is not finite. What comes back must be destroyed before `leave`.
  [[nodiscard]] virtual std::unique_ptr<matrix::remote_matrix> stiffness_of(const structure::plate& p) = 0;

  /// Rank 0: the stiffness in a file, of which each rank reads a part: a Matrix Market file, or where `rows`
  /// is not 0 one of CalculiX of so many rows. Throws input_error, with `name` for the file, as one process
  /// would.
  [[nodiscard]] virtual std::unique_ptr<matrix::remote_matrix> read_stiffness(const std::string& path,
                                                                              const std::string& name,
                                                                              int rows) = 0;

  /// Rank 0: the largest resident memory that each rank has had, in KiB.
  [[nodiscard]] virtual std::vector<long> peak_kib() = 0;

  /// Rank 0: let the others go, and end MPI. Nothing else may be called after it.
  virtual void leave() noexcept = 0;
};

/// The ranks that this process has joined; null where it has joined none.
[[nodiscard]] ranks* joined_ranks();

/// `all` must live until the process ends, or until null takes its place.
void set_joined_ranks(ranks* all);

}  // namespace contct::distributed
