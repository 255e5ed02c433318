// Fuzzes the reader of meshes in CalculiX's input files.
#include <cmath>
#include <set>

#include "contct/read/matrix_files.hpp"
#include "fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace contct::fuzz;
  using namespace contct;
  assembled a;
  a.labels = {"1.x", "2.x", "12.3"};
  a.stiffness.order = 3;
  placed_nodes mesh;
  if (!is_read([&] { mesh = places_by_mesh(text_of(data, size), "job.inp", a); })) return 0;
  std::set<std::string> names;
  for (const placed_node& n : mesh.nodes) {
    require(names.insert(n.name).second, "a node is there once", n.name);
    for (const double x : n.at) require(std::isfinite(x), "a coordinate is a number", n.name);
  }
  std::set<std::pair<int, int>> edges;
  for (const mesh_edge& e : mesh.edges) {
    require(e.from >= 0 && e.from < e.to && e.to < std::ssize(mesh.nodes), "an edge joins two nodes");
    require(e.elements > 0 && edges.emplace(e.from, e.to).second, "an edge is there once");
  }
  return 0;
}
