// Random beams on beds, the same beam for every mesh, and the differences between two meshes.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "contct/number/random.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/results/run.hpp"
#include "contct/results/step_results.hpp"

namespace contct {

/// Returns the text of random beam `number` on beds with a mesh of `elements`, a multiple of 8. Its unit of
/// length is `L`, its unit of force `F`.
inline std::string bedded(std::uint64_t number, int elements, double L = 1.0, double F = 1.0) {
  random_numbers chance(number * 977 + 5);
  const auto place = [&] { return L * (0.25 * chance.whole(1, 15) + 0.01 * chance.whole(0, 9)); };
  const auto pick = [&chance](const std::vector<std::string>& all) {
    return all[chance.whole(0, static_cast<int>(all.size()) - 1)];
  };
  const auto one_of = [&chance](const std::vector<double>& all, double unit) {
    return unit * all[chance.whole(0, static_cast<int>(all.size()) - 1)];
  };
  const double k = F / L / L;
  std::string text = fmt::format(
      "[beam]\nlength = {:.12g}\nelements = {}\nEI = {:.12g}\n[[bed]]\nfrom = {:.12g}\nmodulus = {}\nface = "
      "{}\n",
      4 * L, elements, one_of({3, 12, 0.8}, F * L * L), std::min(place(), 3 * L),
      pick({fmt::format("{:.12g}", 40 * k),
            fmt::format("[ {{ to = {:.12g}, value = {:.12g} }}, {{ to = {:.12g}, value = {:.12g} }} ]",
                        3.5 * L, 15 * k, 4 * L, 60 * k)}),
      pick({"0", fmt::format("{:.12g}", -0.01 * L),
            fmt::format("{{ polynomial = [ 0, -0.02, {:.12g} ] }}", 0.003 / L)}));
  if (chance.chance(0.7))
    text += fmt::format("[[bed]]\nto = {:.12g}\nmodulus = {:.12g}\nface = {:.12g}\n",
                        std::max(place(), 0.8 * L), 25 * k, one_of({0, -0.005}, L));
  if (chance.chance(0.3))
    text += fmt::format("[[bed]]\nsurface = 'above'\nto = {:.12g}\nmodulus = {:.12g}\nface = {:.12g}\n",
                        2 * L, 30 * k, 0.02 * L);
  if (chance.chance(0.4))
    text += fmt::format("[[hinge]]\nx = {:.12g}\n", 1.5 * L) +
            pick({"", fmt::format("stiffness = {:.12g}\n", 3 * F * L)});
  if (chance.chance(0.5))
    text += fmt::format("[[contact]]\nx = {:.12g}\nsurface = 'below'\nface = {:.12g}\nstiffness = {:.12g}\n",
                        2.5 * L, -0.02 * L, 300 * F / L);
  text += pick({"[[support]]\nx = 0\nfix = 'w'\n",
                fmt::format("[[support]]\nx = {:.12g}\nfix = ['w', 'theta']\n", 4 * L),
                fmt::format("[[support]]\nx = [0, {:.12g}]\nspring = {{ w = {:.12g}, theta = {:.12g} }}\n",
                            4 * L, 2 * F / L, F * L),
                ""});
  return text + fmt::format(
                    "[[step]]\nuniform = {:.12g}\npoint = [ {{ x = {:.12g}, w = {:.12g} }}, {{ x = {:.12g}, "
                    "theta = {:.12g} }} ]\n",
                    one_of({-0.3, -1, -0.05}, F / L), place(), one_of({-2, -0.5}, F), 2 * L,
                    one_of({0, 0.6}, F * L));
}

/// A run of a problem with what is proved about its mesh.
struct proved_run {
  explicit proved_run(problem p)
      : what(std::move(p)), structure(structure_of(what)), ends(what, structure, {}) {
    ends.go({});
    ends.find_mesh_errors();
  }

  [[nodiscard]] bool certified() const { return !ends.result.mesh.empty() && ends.result.all_certified(); }
  [[nodiscard]] const mesh_error& error() const { return ends.result.mesh.back(); }
  [[nodiscard]] step_results results() const { return {what, ends.result.record.steps.back()}; }
  [[nodiscard]] double bound(std::string_view key) const {
    return std::ranges::find(error().numbers, key, &mesh_number::key)->error;
  }
  [[nodiscard]] const true_extremes& without(std::string_view key) const {
    return *std::ranges::find(error().extremes, key, &true_extremes::key);
  }

  problem what;
  linear_structure structure;
  run ends;
};

/// The largest differences between two meshes of the numbers that both have, by the keys of mesh_number; the
/// second mesh has `ratio` times as many elements.
inline std::map<std::string_view, double> differences(const step_results& coarse, const step_results& fine,
                                                      std::size_t ratio) {
  std::map<std::string_view, double> most;
  const auto take = [&most](std::string_view key, double a, double b) {
    most[key] = std::max(most[key], std::abs(a - b));
  };
  const std::vector<double>& u = coarse.state.displacement;
  for (std::size_t dof = 0; dof < u.size(); ++dof)
    take(dof % 2 == 0 ? "w" : "slope", u[dof], fine.state.displacement[dof / 2 * 2 * ratio + dof % 2]);
  for (std::size_t e = 0; e < coarse.elements.elements(); ++e)
    for (const std::size_t name : {0, 1}) {
      const std::string_view key = coarse.elements.names[name];
      take(key, coarse.elements.at(e, name)[0], fine.elements.at(e * ratio, name)[0]);
      take(key, coarse.elements.at(e, name)[1], fine.elements.at((e + 1) * ratio - 1, name)[1]);
    }
  for (std::size_t i = 0; i < coarse.reactions.size(); ++i)
    take(coarse.what.supports[i].dof == 0 ? "reaction" : "moment", coarse.reactions[i], fine.reactions[i]);
  for (std::size_t i = 0; i < contacts_of(coarse.what); ++i) {
    take("force", coarse.pairs[i].force, fine.pairs[i].force);
    take("gap", coarse.pairs[i].gap, fine.pairs[i].gap);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    take(coarse.ranges()[i].name, coarse.ranges()[i].least.value, fine.ranges()[i].least.value);
    take(coarse.ranges()[i].name, coarse.ranges()[i].most.value, fine.ranges()[i].most.value);
  }
  for (std::size_t bed = 0; bed < coarse.what.beds.size(); ++bed) {
    const bed_reading a = beds_in(coarse)[bed];
    const bed_reading b = beds_in(fine)[bed];
    take("pressure", a.pressure.most.value, b.pressure.most.value);
    take("bed_force", a.force, b.force);
    take("bed_contact", a.contact, b.contact);
  }
  return most;
}

}  // namespace contct
