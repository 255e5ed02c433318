// Fuzzes the reader of problem files. The inputs may name the files of reference/structures.
#include <algorithm>
#include <cmath>

#include "contct/read/problem_file.hpp"
#include "fuzz/fuzz.hpp"

namespace {

#ifndef CONTCT_REFERENCE  // for clang-tidy, which has no build of the fuzzers
#define CONTCT_REFERENCE "reference"
#endif

using namespace contct::fuzz;
using namespace contct;

void check_pairs(const problem& p) {
  for (const contact_pair& c : p.pairs) {
    require(c.node >= 0 && c.node < nodes(p.geometry), "a pair is at a node");
    require(std::isfinite(c.face) && std::isfinite(c.stiffness) && c.stiffness > 0.0, "a pair's numbers");
    require(c.surface == 1 || c.surface == -1, "a pair's side");
  }
  for (const bed& b : p.beds)
    require(b.first_pair + b.share.size() <= p.pairs.size(), "a bed's pairs are there");
}

/// Checks the invariants of a problem on which its users rely.
void check(const problem& p) {
  require(nodes(p.geometry) > 0 && !p.steps.empty(), "a problem has nodes and steps");
  const auto is_dof = [&p](int node, int dof) {
    return node >= 0 && node < nodes(p.geometry) && dof >= 0 && dof < dofs_per_node(p.geometry);
  };
  check_pairs(p);
  for (const support& s : p.supports) {
    require(is_dof(s.node, s.dof), "a support is at a dof");
    require(s.fixed || (std::isfinite(s.spring) && s.spring > 0.0), "a support is fixed or a spring");
  }
  for (const load& l : p.steps) {
    for (const point_load& f : l.points)
      require(is_dof(f.node, f.dof) && std::isfinite(f.value), "a load is a number at a dof");
    for (const face_move& m : l.moves) {
      require(is_dof(m.node, m.dof) && std::isfinite(m.factor * m.value), "a move is a number at a dof");
      require(std::ranges::any_of(p.pairs, [&m](const contact_pair& c) { return c.node == m.node; }),
              "a face that moves is that of a pair");
    }
    for (const prescribed_displacement& g : l.settlements) {
      require(is_dof(g.node, g.dof) && std::isfinite(g.value), "a settlement is a number at a dof");
      require(
          std::ranges::any_of(
              p.supports, [&g](const support& s) { return s.fixed && s.node == g.node && s.dof == g.dof; }),
          "what settles is fixed");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr const char* file = CONTCT_REFERENCE "/structures/problem.toml";
  const std::string_view text = text_of(data, size);
  (void)is_read([&] { check(parse_problem(text, file)); });
  return 0;
}
