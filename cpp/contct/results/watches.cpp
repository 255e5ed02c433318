#include "contct/results/watches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace contct {
namespace {

/// Finds the extremes of one quantity in one part.
class watcher {
 public:
  watcher(std::vector<watched_range>& all, std::size_t part, const quantity_row& row)
      : all_(all), part_(part), row_(row) {}

  void take(const placed_value& v) {
    if (std::isnan(v.value)) return;  // a support with the other kind of reaction
    if (!std::exchange(begun_, true)) all_.push_back({part_, &row_, v, v});
    watched_range& range = all_.back();
    if (v.value < range.least.value - tie_of(std::abs(v.value), 0.0)) range.least = v;
    if (v.value > range.most.value + tie_of(std::abs(v.value), 0.0)) range.most = v;
  }

 private:
  std::vector<watched_range>& all_;
  std::size_t part_;
  const quantity_row& row_;
  bool begun_ = false;
};

void add_range(const step_results& r, std::size_t part, std::vector<watched_range>& all) {
  const problem& p = r.what;
  const watched_part& within = p.watches[part];
  for (const value_range& v :
       ranges_of(p.geometry, r.acting, r.state.displacement, {}, r.elements.values, &within))
    all.push_back({part, &row_named(p, v.name), v.least, v.most});
  for (const quantity_row* row : quantities_of(p, on::nodes)) {
    if (row->kind) continue;
    watcher w(all, part, *row);
    const std::vector<double> values = row->values(r);
    for (int node = 0; node < nodes(p.geometry); ++node)
      if (const placed_value v = at_node(p, values[node], node); within.has(v.x, v.y)) w.take(v);
  }
}

void add_named(const step_results& r, std::size_t part, std::vector<watched_range>& all) {
  const problem& p = r.what;
  const auto is_named = [&](on list, std::size_t i) {
    return std::ranges::count(p.watches[part].names, name_of_entry(p, list, i)) > 0;
  };
  for (const on list : {on::supports, on::pairs})
    for (const quantity_row* row : quantities_of(p, list)) {
      if (!row->kind) continue;  // faces are input
      watcher w(all, part, *row);
      const std::vector<double> values = row->values(r);
      for (std::size_t i = 0; i < std::min(values.size(), list_of(list).count(p)); ++i)
        if (is_named(list, i))
          w.take(at_node(p, values[i], list_of(list).node(p, i), name_of_entry(p, list, i)));
    }
  const std::vector<bed_reading> beds = beds_in(r);
  for (const quantity_row* row : quantities_of(p, on::nodes)) {
    if (row->kind) continue;
    watcher w(all, part, *row);
    for (std::size_t i = 0; i < beds.size(); ++i)
      if (is_named(on::beds, i))
        for (placed_value v : {beds[i].pressure.least, beds[i].pressure.most}) {
          v.name = name_of_entry(p, on::beds, i);
          w.take(v);
        }
  }
}

}  // namespace

placed_value at_node(const problem& p, double value, int node, std::string_view name) {
  if (std::holds_alternative<assembled>(p.geometry.kind)) return {value, 0.0, 0.0, node, name};
  const place at = place_of_node(p.geometry, node);
  return {value, at.x, at.y, node, name};
}

std::vector<watched_range> watched_in(const step_results& r) {
  std::vector<watched_range> all;
  for (std::size_t part = 0; part < r.what.watches.size(); ++part)
    (r.what.watches[part].names.empty() ? add_range : add_named)(r, part, all);
  return all;
}

}  // namespace contct
