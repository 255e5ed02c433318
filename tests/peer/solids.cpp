// Solids: the matrix is CalculiX's own, so nothing but the contact is left to differ.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "peer/block.hpp"
#include "peer/programs.hpp"

namespace contct::app::peer {
namespace {

using nlohmann::json;

/// The labels of a matrix's dofs, in its order.
std::vector<std::pair<int, int>> labels_in(const std::string& path) {
  std::vector<std::pair<int, int>> labels;
  std::istringstream lines(read_text(path));
  char dot = 0;
  for (int node = 0, direction = 0; lines >> node >> dot >> direction;) labels.emplace_back(node, direction);
  return labels;
}

difference compare_answers(const places& p, const block& b, const json& step,
                           const std::vector<calculix_table>& tables) {
  difference d;
  const auto ours = step["displacement"].get<std::vector<double>>();
  const auto labels = labels_in(p.work + "/" + b.name + ".dof");
  if (labels.size() != ours.size())
    throw std::runtime_error(b.name + ": as many displacements as labels are needed");
  const auto theirs = values_at_end(tables, "displacements", "ALL", 1, b.nodes(), b.name);
  double largest = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const auto [node, direction] = labels[i];
    if (node > b.nodes()) continue;  // C3D8I's own modes, which CalculiX numbers as nodes
    const double u =
        theirs[static_cast<std::size_t>(node - 1)][static_cast<std::size_t>(direction - 1)] / block_scale;
    d.displacement = std::max(d.displacement, std::abs(u - ours[i]));
    largest = std::max(largest, std::abs(ours[i]));
    ++d.values;
  }
  d.displacement /= largest;
  const auto held =
      values_at_end(tables, "forces", "GROUND", b.nodes() + 1, static_cast<int>(b.supports.size()), b.name);
  double pressing = 0.0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    const double force = step["pairs"][i]["force"];
    const double their_force = held[i][2] / block_force_scale;
    d.force = std::max(d.force, std::abs(their_force - force));
    pressing = std::max(pressing, std::abs(force));
    d.same_pairs = d.same_pairs && (their_force > 0.0) == (step["pairs"][i]["state"] == "contact");
    ++d.values;
  }
  if (pressing > 0.0) d.force /= pressing;
  return d;
}

/// The matrix that the example in reference/ keeps, against what CalculiX makes of its input now.
void check_example(const places& p, verdicts& v) {
  const std::string kept = p.reference + "/structures/calculix/console";
  run_deck(p, "console", read_text(kept + ".inp"));
  v.check(read_text(kept + ".dof") == read_text(p.work + "/console.dof"),
          "console: the kept labels are CalculiX's");
  std::istringstream ours(read_text(kept + ".sti"));
  std::istringstream theirs(read_text(p.work + "/console.sti"));
  int row[2];
  int column[2];
  double value[2];
  double largest = 0.0;
  double off = 0.0;
  int entries = 0;
  bool same_places = true;
  while (ours >> row[0] >> column[0] >> value[0]) {
    theirs >> row[1] >> column[1] >> value[1];
    same_places = same_places && theirs && row[0] == row[1] && column[0] == column[1];
    largest = std::max(largest, std::abs(value[0]));
    off = std::max(off, std::abs(value[0] - value[1]));
    ++entries;
  }
  v.check(same_places && !(theirs >> row[1]) && entries > 5000 && off <= 1e-12 * largest,
          fmt::format("console: the kept matrix is CalculiX's, {} entries within {:.1e}", entries,
                      off / largest));
  const json steps = run_contct(p, kept + ".toml")["steps"];
  std::size_t increments = 0;
  for (const json& step : steps) increments += step["increments"].size();
  v.check(increments == 10,
          fmt::format("console: both kernels equal and certified in {} increments", increments));
}

/// One block: its matrix, the path by both kernels, and CalculiX's own end of every step.
void check_block(const places& p, verdicts& v, const block& b, int events) {
  write_text(p.work + "/" + b.name + ".toml", problem_of(b));
  run_deck(p, b.name, matrix_deck_of(b));
  const json result = run_contct(p, p.work + "/" + b.name + ".toml");
  int found = 0;
  int closed = 0;
  for (const json& step : result["steps"]) {
    for (const json& i : step["increments"]) found += static_cast<int>(i["events"].size());
  }
  v.check(found >= events,
          fmt::format("{}: both kernels equal and certified on {} events, {} calls, {} values compared",
                      b.name, found, result["lockstep"]["calls"].get<int>(),
                      result["lockstep"]["values_compared"].get<int>()));
  for (std::size_t i = 0; i < b.loads.size(); ++i) {
    const json& step = result["steps"][i];
    const auto tables = run_calculix(p, b.name + "-peer", peer_deck_of(b, b.loads[i]));
    const difference d = compare_answers(p, b, step, tables);
    int here = 0;
    for (const json& pair : step["pairs"]) here += pair["state"] == "contact" ? 1 : 0;
    closed += here;
    v.check(d.same_pairs && d.displacement <= 1e-6 && d.force <= 1e-6 && d.values >= 100,
            fmt::format("{} step {}: {} closed; u within {:.1e}, forces within {:.1e}, {} values", b.name,
                        i + 1, here, d.displacement, d.force, d.values));
  }
  v.check(closed >= 3, fmt::format("{}: {} closed pairs were compared", b.name, closed));
}

}  // namespace

void check_solids(const places& p, verdicts& v) {
  check_example(p, v);
  block beam{"cantilever", 10, 2, 2, 10, 1, 1, {}, 0, {-2, -10, -1, 3}};
  beam.supports = {
      {beam.at(4, 1, 0), -0.02, 100}, {beam.at(7, 1, 0), -0.1, 100}, {beam.at(10, 1, 0), -0.2, 50}};
  beam.loaded = beam.at(10, 1, 2);
  check_block(p, v, beam, 4);
  block plate{"slab", 8, 6, 1, 8, 6, 0.5, {}, 0, {-5, -20, -4}};
  plate.supports = {{plate.at(8, 0, 0), -0.2, 40},
                    {plate.at(8, 6, 0), -0.3, 40},
                    {plate.at(4, 3, 0), -0.15, 40},
                    {plate.at(8, 3, 0), -0.4, 40}};
  plate.loaded = plate.at(8, 2, 1);
  check_block(p, v, plate, 4);
}

}  // namespace contct::app::peer
