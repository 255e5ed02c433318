#include "contct/results/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <stdexcept>

namespace contct {
namespace {

constexpr auto is_beam = [](const problem& p) { return std::holds_alternative<beam>(p.geometry.kind); };
constexpr auto is_plate = [](const problem& p) { return std::holds_alternative<plate>(p.geometry.kind); };
constexpr auto is_matrix = [](const problem& p) {
  return std::holds_alternative<assembled>(p.geometry.kind);
};
constexpr auto has_shear = [](const problem& p) {
  return is_beam(p) && !std::get<beam>(p.geometry.kind).GA.empty();
};
/// The nodes of the hinges, from 0.
std::span<const int> hinges_of(const problem& p) {
  const auto* const b = std::get_if<beam>(&p.geometry.kind);
  return b == nullptr ? std::span<const int>() : b->hinges;
}
constexpr auto has_hinges = [](const problem& p) { return !hinges_of(p).empty(); };
constexpr auto has_elements = [](const problem& p) { return !is_matrix(p); };
constexpr auto has_pairs = [](const problem& p) { return !p.pairs.empty(); };
constexpr auto has_beds = [](const problem& p) { return !p.beds.empty(); };

template <bool Turning>
bool has_supports(const problem& p) {
  return std::ranges::any_of(p.supports, [&p](const support& s) { return is_turning(p, s) == Turning; });
}
constexpr auto has_clamps = [](const problem& p) { return has_elements(p) && has_supports<true>(p); };
constexpr auto has_clamps_in_matrix = [](const problem& p) { return is_matrix(p) && has_supports<true>(p); };

constexpr auto has_stress = [](const problem& p) { return !stresses_of(p.geometry, {}).names.empty(); };
constexpr auto has_fibre_stress = [](const problem& p) { return is_beam(p) && has_stress(p); };
constexpr auto has_face_stress = [](const problem& p) { return is_plate(p) && has_stress(p); };

/// The values of one member of each entry of a list.
template <class List, class Member>
std::vector<double> each(const List& list, Member member) {
  std::vector<double> values;
  values.reserve(list.size());
  for (const auto& entry : list) values.push_back(std::invoke(member, entry));
  return values;
}

template <std::size_t Dof>
std::vector<double> at_dof(const step_results& r) {
  std::vector<double> values;
  const auto stride = static_cast<std::size_t>(dofs_per_node(r.what.geometry));
  for (std::size_t dof = Dof; dof < r.state.displacement.size(); dof += stride)
    values.push_back(r.state.displacement[dof]);
  return values;
}

template <auto Member>
std::vector<double> of_pairs(const step_results& r) {
  return each(r.pairs, Member);
}

template <bool Turning>
std::vector<double> of_supports(const step_results& r) {
  std::vector<double> values = r.reactions;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (is_turning(r.what, r.what.supports[i]) != Turning)
      values[i] = std::numeric_limits<double>::quiet_NaN();
  return values;
}

template <auto Member>
std::vector<double> of_beds(const step_results& r) {
  return each(beds_in(r), Member);
}

std::vector<double> of_bed_pressures(const step_results& r) {
  return each(beds_in(r), [](const bed_reading& b) { return b.pressure.most.value; });
}

std::vector<double> in_elements(const element_results& all, std::size_t number) {
  std::vector<double> values;
  for (std::size_t e = 0; e < all.elements(); ++e) {
    const auto here = all.at(e, number);
    values.insert(values.end(), here.begin(), here.end());
  }
  return values;
}

template <std::size_t Number>
std::vector<double> forces(const step_results& r) {
  return in_elements(r.elements, Number);
}

template <std::size_t Number>
std::vector<double> stresses(const step_results& r) {
  return in_elements(r.stresses(), Number);
}

/// dw/dx at the ends of the elements of a beam.
std::vector<double> axis_slopes(const step_results& r) {
  const auto& b = std::get<beam>(r.what.geometry.kind);
  std::vector<double> values;
  for (int e = 0; e < b.elements(); ++e) {
    const auto flexibility = shear_flexibility_of<double>(b, e);
    const double* const theta = &r.state.displacement[2 * e + 1];
    const double right =
        b.has_hinge(e + 1) ? polynomial_at(r.lines()->pieces(e).back().slope, 1.0) : theta[2];
    values.push_back(theta[0] - flexibility * r.elements.at(e, 0)[0]);
    values.push_back(right - flexibility * r.elements.at(e, 0)[1]);
  }
  return values;
}

std::vector<double> hinge_moments(const step_results& r) {
  return each(hinges_of(r.what), [&r](int node) { return r.elements.at(node - 1, 1)[1]; });
}

/// theta on the right of each hinge minus that on its left. If the hinge is stiffer than the element on its
/// left, both are nearly equal, and the moment divided by the stiffness has more digits.
std::vector<double> hinge_rotations(const step_results& r) {
  std::vector<double> values = hinge_moments(r);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& b = std::get<beam>(r.what.geometry.kind);
    const int node = b.hinges[i];
    const double stiffness = b.stiffness_of_hinge(node);
    const bool is_stiff = stiffness > b.EI[node - 1] / b.length_of(node - 1);
    const double left = polynomial_at(r.lines()->pieces(node - 1).back().slope, 1.0);
    values[i] = is_stiff ? values[i] / stiffness : r.state.displacement[2 * node + 1] - left;
  }
  return values;
}

template <auto Sum>
std::vector<double> of_structure(const step_results& r) {
  return {(*balance_of(r)).*Sum};
}

std::span<const quantity_row> all_quantities() {
  using enum on;
  constexpr std::optional<quantity> no_kind = std::nullopt;
  static constexpr quantity_row rows[] = {
      {"w", "deflection", unit::length, nodes, quantity::w, has_elements, at_dof<0>},
      {"w", "displacement", unit::length, nodes, quantity::w, is_matrix, at_dof<0>},
      {"theta", "slope", unit::none, nodes, quantity::slope, is_beam, at_dof<1>},
      {"wx", "slope along x", unit::none, nodes, quantity::slope, is_plate, at_dof<1>},
      {"wy", "slope along y", unit::none, nodes, quantity::slope, is_plate, at_dof<2>},
      {"pressure", "pressure of the beds", unit::pressure, nodes, no_kind, has_beds, bed_pressure},
      {"gap", "gap", unit::length, pairs, quantity::gap, has_pairs, of_pairs<&pair_reading::gap>},
      {"force", "contact force", unit::force, pairs, quantity::force, has_pairs,
       of_pairs<&pair_reading::force>},
      {"face", "face", unit::length, pairs, no_kind, has_pairs, of_pairs<&pair_reading::face>},
      {"reaction", "reaction", unit::force, supports, quantity::reaction, has_supports<false>,
       of_supports<false>},
      {"reaction_moment", "reaction moment", unit::moment, supports, quantity::moment, has_clamps,
       of_supports<true>},
      {"reaction_moment", "reaction moment", unit::moment, supports, quantity::reaction, has_clamps_in_matrix,
       of_supports<true>},
      {"bed_force", "force of the bed", unit::force, beds, no_kind, has_beds, of_beds<&bed_reading::force>},
      {"bed_contact", "part of the bed in contact", unit::extent, beds, no_kind, has_beds,
       of_beds<&bed_reading::contact>},
      {"bed_pressure", "largest pressure of the bed", unit::pressure, beds, no_kind, has_beds,
       of_bed_pressures},
      {"hinge_rotation", "rotation in the hinge", unit::none, hinges, no_kind, has_hinges, hinge_rotations},
      {"hinge_moment", "moment in the hinge", unit::moment, hinges, quantity::moment, has_hinges,
       hinge_moments},
      {"shear", "shear force", unit::force, element_ends, quantity::shear, is_beam, forces<0>},
      {"moment", "moment", unit::moment, element_ends, quantity::moment, is_beam, forces<1>},
      {"axis_slope", "slope of the axis", unit::none, element_ends, no_kind, has_shear, axis_slopes},
      {"mx", "moment mx", unit::plate_moment, element_ends, quantity::moment, is_plate, forces<0>},
      {"my", "moment my", unit::plate_moment, element_ends, quantity::moment, is_plate, forces<1>},
      {"mxy", "twisting moment mxy", unit::plate_moment, element_ends, quantity::moment, is_plate, forces<2>},
      {"stress", "stress, lower fibre (upper: other sign)", unit::stress, element_ends, no_kind,
       has_fibre_stress, stresses<0>},
      {"sx", "stress sx, lower face (upper: other sign)", unit::stress, element_ends, no_kind,
       has_face_stress, stresses<0>},
      {"sy", "stress sy, lower face (upper: other sign)", unit::stress, element_ends, no_kind,
       has_face_stress, stresses<1>},
      {"txy", "stress txy, lower face (upper: other sign)", unit::stress, element_ends, no_kind,
       has_face_stress, stresses<2>},
      {"s1", "principal stress s1, lower face (upper: -s2)", unit::stress, element_ends, no_kind,
       has_face_stress, stresses<3>},
      {"s2", "principal stress s2, lower face (upper: -s1)", unit::stress, element_ends, no_kind,
       has_face_stress, stresses<4>},
      {"von_mises", "von Mises stress, both faces", unit::stress, element_ends, no_kind, has_face_stress,
       stresses<5>},
      {"sum_of_loads", "sum of the loads", unit::force, structure, no_kind, has_elements,
       of_structure<&force_balance::loads>},
      {"sum_of_reactions", "sum of the reactions", unit::force, structure, no_kind, has_elements,
       of_structure<&force_balance::reactions>},
      {"sum_of_contact", "sum of the contact forces", unit::force, structure, no_kind, has_elements,
       of_structure<&force_balance::contact>},
  };
  return rows;
}

}  // namespace

const list_row& list_of(on where) {
  static constexpr list_row rows[] = {
      {"nodes", "", "", nullptr, nullptr},
      {"pairs", "pair", "", contacts_of, [](const problem& p, std::size_t i) { return p.pairs[i].node; },
       &entry_names::pairs},
      {"supports", "", "", [](const problem& p) { return p.supports.size(); },
       [](const problem& p, std::size_t i) { return p.supports[i].node; }, &entry_names::supports},
      {"beds", "bed", "bed_", [](const problem& p) { return p.beds.size(); }, nullptr, &entry_names::beds},
      {"hinges", "hinge", "hinge_", [](const problem& p) { return hinges_of(p).size(); },
       [](const problem& p, std::size_t i) { return hinges_of(p)[i]; }},
      {"element_ends", "", "", nullptr, nullptr},
      {"structure", "", "sum_of_", [](const problem& /*p*/) { return std::size_t{1}; }, nullptr}};
  return rows[static_cast<std::size_t>(where)];
}

std::string_view name_of_entry(const problem& p, on where, std::size_t i) {
  if (where == on::pairs && i >= contacts_of(p)) {
    const auto after = std::ranges::upper_bound(p.beds, i, {}, &bed::first_pair);
    return name_of_entry(p, on::beds, static_cast<std::size_t>(after - p.beds.begin()) - 1);
  }
  const auto names = list_of(where).names;
  return names != nullptr && i < (p.names.*names).size() ? std::string_view((p.names.*names)[i])
                                                         : std::string_view();
}

std::string name_before(const problem& p, on where, std::size_t i) {
  const std::string name = on_one_line(name_of_entry(p, where, i));
  return name + (name.empty() ? "" : ", ");
}

std::string entry_words(const problem& p, on where, std::size_t i) {
  return name_before(p, where, i) + place_words(p.geometry, list_of(where).node(p, i));
}

std::string numbered_words(const problem& p, on where, std::size_t i) {
  const std::string name = on_one_line(name_of_entry(p, where, i));
  return fmt::format("{} {}{}{}", list_of(where).entry, i + 1, name.empty() ? "" : ", ", name);
}

std::string_view key_in_list(const quantity_row& row) {
  return row.key.substr(list_of(row.where).prefix.size());
}

std::vector<const quantity_row*> quantities_of(const problem& p, std::optional<on> list) {
  std::vector<const quantity_row*> all;
  for (const quantity_row& row : all_quantities())
    if (row.where == list.value_or(row.where) && row.exists(p)) all.push_back(&row);
  return all;
}

std::vector<quantity_column> columns_of(const step_results& r, on list) {
  std::vector<quantity_column> all;
  for (const quantity_row* row : quantities_of(r.what, list)) all.push_back({row, row->values(r)});
  return all;
}

const quantity_row& row_named(const problem& p, std::string_view key) {
  for (const quantity_row& row : all_quantities())
    if (row.key == key && row.exists(p)) return row;
  throw std::logic_error("no quantity " + std::string(key));
}

bool has_kind(const problem& p, quantity kind) {
  if (kind == quantity::reaction) return !p.supports.empty();  // also if all reactions are moments
  return std::ranges::any_of(quantities_of(p), [kind](const auto* row) { return row->kind == kind; });
}

namespace {

/// Widens the range of a quantity in a part, the last of `all`, or begins this range.
void take(std::vector<watched_range>& all, std::size_t part, const quantity_row& row, const placed_value& v) {
  if (std::isnan(v.value)) return;  // a support with the other kind of reaction
  if (all.empty() || all.back().part != part || all.back().row != &row) all.push_back({part, &row, v, v});
  watched_range& range = all.back();
  if (v.value < range.least.value - tie_of(std::abs(v.value), 0.0)) range.least = v;
  if (v.value > range.most.value + tie_of(std::abs(v.value), 0.0)) range.most = v;
}

void add_range(const step_results& r, std::size_t part, std::vector<watched_range>& all) {
  const problem& p = r.what;
  const watched_part& within = p.watches[part];
  for (const value_range& v :
       ranges_of(p.geometry, r.acting, r.state.displacement, {}, r.elements.values, &within))
    all.push_back({part, &row_named(p, v.name), v.least, v.most});
  for (const auto& [row, values] : columns_of(r, on::nodes)) {
    if (row->kind) continue;
    for (int node = 0; node < nodes(p.geometry); ++node)
      if (const placed_value v = at_node(p, values[node], node); within.has(v.x, v.y))
        take(all, part, *row, v);
  }
}

void add_named(const step_results& r, std::size_t part, std::vector<watched_range>& all) {
  const problem& p = r.what;
  const auto is_named = [&](on list, std::size_t i) {
    return std::ranges::count(p.watches[part].names, name_of_entry(p, list, i)) > 0;
  };
  for (const on list : {on::supports, on::pairs})
    for (const auto& [row, values] : columns_of(r, list)) {
      if (!row->kind) continue;  // faces are input
      for (std::size_t i = 0; i < std::min(values.size(), list_of(list).count(p)); ++i)
        if (is_named(list, i))
          take(all, part, *row, at_node(p, values[i], list_of(list).node(p, i), name_of_entry(p, list, i)));
    }
  const std::vector<bed_reading> beds = beds_in(r);
  for (const quantity_row* row : quantities_of(p, on::nodes)) {
    if (row->kind) continue;
    for (std::size_t i = 0; i < beds.size(); ++i)
      if (is_named(on::beds, i))
        for (placed_value v : {beds[i].pressure.least, beds[i].pressure.most}) {
          v.name = name_of_entry(p, on::beds, i);
          take(all, part, *row, v);
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
