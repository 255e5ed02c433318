// Reorders the rows of a matrix from a file for a small bandwidth, by Boost.Graph.
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>
#include <boost/graph/properties.hpp>
#include <cstdint>
#include <deque>

#include "contct/linear/stiffness_matrix.hpp"

namespace contct {
namespace {

// Each entry off the diagonal is an edge in both directions.
using neighbours =
    boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                       boost::no_property, std::uint32_t, std::uint64_t>;

neighbours graph_of(const sparse_matrix& a) {
  std::vector<std::uint32_t> from;
  std::vector<std::uint32_t> to;
  from.reserve(2 * a.entries.size());
  to.reserve(2 * a.entries.size());
  for (const matrix_entry& e : a.entries) {
    if (e.row == e.column) continue;
    const auto row = static_cast<std::uint32_t>(e.row);
    const auto column = static_cast<std::uint32_t>(e.column);
    from.insert(from.end(), {row, column});
    to.insert(to.end(), {column, row});
  }
  return {boost::construct_inplace_from_sources_and_targets, from, to, static_cast<std::uint32_t>(a.order)};
}

/// For each connected component, a vertex with the fewest neighbours.
std::deque<std::uint32_t> first_of_components(const neighbours& g) {
  std::vector<char> seen(num_vertices(g), 0);
  std::deque<std::uint32_t> firsts;
  std::vector<std::uint32_t> to_visit;
  for (std::uint32_t v = 0; v < num_vertices(g); ++v) {
    if (seen[v] != 0) continue;
    seen[v] = 1;
    firsts.push_back(v);
    to_visit.assign(1, v);
    while (!to_visit.empty()) {
      const std::uint32_t at = to_visit.back();
      to_visit.pop_back();
      if (out_degree(at, g) < out_degree(firsts.back(), g)) firsts.back() = at;
      for (const auto [next, end] = adjacent_vertices(at, g);
           const std::uint32_t other : boost::make_iterator_range(next, end)) {
        if (seen[other] != 0) continue;
        seen[other] = 1;
        to_visit.push_back(other);
      }
    }
  }
  return firsts;
}

}  // namespace

std::vector<int> rows_for_small_band(const sparse_matrix& a) {
  const neighbours g = graph_of(a);
  std::vector<boost::default_color_type> colours(num_vertices(g));
  const auto colour = boost::make_iterator_property_map(colours.begin(), get(boost::vertex_index, g));
  const auto degree = boost::make_out_degree_map(g);
  std::deque<std::uint32_t> firsts = first_of_components(g);
  // Each search for a better first vertex visits the whole graph, which is too slow for many components.
  constexpr std::size_t few = 32;
  if (firsts.size() <= few)
    for (std::uint32_t& v : firsts) v = static_cast<std::uint32_t>(find_starting_node(g, v, colour, degree));
  std::vector<std::uint32_t> order;
  order.reserve(num_vertices(g));
  cuthill_mckee_ordering(g, firsts, std::back_inserter(order), colour, degree);
  std::vector<int> rows(order.size());
  const auto last = static_cast<int>(order.size()) - 1;
  for (int i = 0; i <= last; ++i) rows[order[i]] = last - i;
  if (subdiagonals_of(a, rows) >= subdiagonals_of(a, {})) rows.clear();
  return rows;
}

}  // namespace contct
