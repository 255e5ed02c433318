// Fuzzes the reader of coordinates, which places the dofs of a matrix. An input is coordinates, a line =====,
// and labels.
#include <cmath>
#include <set>

#include "contct/read/matrix_files.hpp"
#include "fuzz/fuzz.hpp"

namespace {

using namespace contct::fuzz;
using namespace contct;

/// Returns a matrix that couples each dof with the next dof.
assembled chain_of(std::vector<std::string> labels) {
  assembled a;
  a.stiffness.order = static_cast<int>(labels.size());
  a.labels = std::move(labels);
  for (int i = 0; i < a.stiffness.order; ++i) {
    if (i > 0) a.stiffness.entries.push_back({i, i - 1, -1.0});
    a.stiffness.entries.push_back({i, i, 2.0});
  }
  return a;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parts = parts_of(text_of(data, size), 2);
  std::set<std::string> names;
  if (!is_read([&] {
        for (const placed_node& n : parse_coordinates(parts[0], "k.xyz")) {
          require(names.insert(n.name).second, "a node is there once", n.name);
          for (const double x : n.at) require(std::isfinite(x), "a coordinate is a number", n.name);
        }
      }))
    return 0;
  std::vector<std::string> labels;
  if (parts.size() < 2 || !is_read([&] { labels = parse_labels(parts[1], "k.dof"); })) return 0;
  const placed_nodes places = places_by_coordinates(parts[0], "k.xyz", chain_of(labels));
  require(!places.known() || places.dofs.size() == labels.size(), "a place for each dof");
  for (const placed_dof& d : places.dofs)
    require(d.node >= -1 && d.node < std::ssize(places.nodes) && d.direction >= 0 && d.direction <= 6,
            "a dof's place");
  for (const mesh_edge& e : places.edges)
    require(e.from >= 0 && e.from < e.to && e.to < std::ssize(places.nodes), "an edge joins two nodes");
  return 0;
}
