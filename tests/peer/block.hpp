// A block of bricks for CalculiX: its matrix, its own nonlinear run, and the problem for contct.
#pragma once

#include <string>
#include <vector>

namespace contct::app::peer {

/// A block of C3D8I bricks, clamped at x = 0, over springs with gaps.
struct gap_support {
  int node;
  double face, stiffness;
};
struct block {
  std::string name;
  int nx, ny, nz;
  double length, width, height;
  std::vector<gap_support> supports;
  int loaded;
  std::vector<double> loads;  ///< a step each

  [[nodiscard]] int nodes() const { return (nx + 1) * (ny + 1) * (nz + 1); }
  [[nodiscard]] int at(int i, int j, int k) const { return (i * (ny + 1) + j) * (nz + 1) + k + 1; }
};

/// Displacements in a deck of peer_deck_of are this many times the problem's: its NLGEOM must not notice the
/// turns (see calculix_deck.cpp). Forces likewise: they must not be small.
inline constexpr double block_scale = 1e-8;
inline constexpr double block_force_scale = 1e6;

/// CalculiX writes the stiffness matrix under the name of the job.
[[nodiscard]] std::string matrix_deck_of(const block& b);

/// CalculiX's own nonlinear run under one step's load. The springs' grounds are the nodes after the block's.
[[nodiscard]] std::string peer_deck_of(const block& b, double load);

/// The problem file that reads that matrix.
[[nodiscard]] std::string problem_of(const block& b);

}  // namespace contct::app::peer
