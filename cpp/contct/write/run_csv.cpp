#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "contct/results/envelope.hpp"
#include "contct/results/path_states.hpp"
#include "contct/results/quantities.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/outputs.hpp"
#include "contct/write/words.hpp"

namespace contct {

std::string csv_field(std::string_view raw) {
  // Spreadsheets read a cell that begins with one of these as a formula.
  constexpr std::string_view beginnings[] = {"=",  "+",      "-",      "@",      "\t",
                                             "\r", "\uff1d", "\uff0b", "\uff0d", "\uff20"};
  const std::string_view behind_blanks = raw.substr(std::min(raw.find_first_not_of(" \n"), raw.size()));
  const bool formula =
      std::ranges::any_of(beginnings, [&](std::string_view b) { return behind_blanks.starts_with(b); });
  std::string text = (formula ? "'" : "") + terminal_text(raw);
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

namespace {

/// A row of fields, which must be quoted already if necessary.
template <class... Fields>
std::string row_of(const Fields&... fields) {
  return fmt::format("{}\r\n", fmt::join(std::forward_as_tuple(fields...), ","));
}

/// The row of a path_moment. The fields of an increment are empty if the moment has no increment.
std::string csv_row(const run_result& r, const load_path& loads, const path_moment& m,
                    const std::vector<pair_reading>& pairs, int watched, std::optional<double> w) {
  const increment_record* const i = m.increment;
  const std::string_view of_end[] = {"end", "exact", "reference"};  // in the order of `origin`
  const std::string_view kind = i == nullptr ? of_end[static_cast<std::size_t>(m.step->from)]
                                : i->snaps   ? "snap"
                                             : "load";
  const auto count = [&pairs](pair_state look) {
    return std::ranges::count(pairs, look, &pair_reading::look);
  };
  const auto number = [](const std::optional<double>& x) { return x ? fmt::format("{}", *x) : ""; };
  const int step = m.step->step;
  const double fraction = i == nullptr ? m.step->fraction : i->fraction;
  const bool is_compared = i != nullptr && i->smin && r.compared;
  const std::string_view kernels = !is_compared ? "" : i->equal ? "equal" : "differ";
  return row_of(step, i == nullptr ? 0 : i->number, kind, i == nullptr ? "" : number(i->s), fraction,
                loads.resultant_at(step, fraction).force,
                csv_field(i == nullptr ? "" : event_names(i->events)), count(pair_state::closed),
                count(pair_state::open), count(pair_state::at_face), i == nullptr ? "" : number(i->smin),
                kernels, csv_field(place_name(r.what.geometry, watched)), number(w),
                csv_field(r.what.steps[step - 1].name));
}

/// The readings of all pairs, from the displacements at the end of a step, or from the D of an increment.
std::vector<pair_reading> readings_at(const problem& p, const load& l, const path_moment& m) {
  const std::vector<pair_in<double>> now = pairs_under(p, l);
  std::vector<pair_reading> all;
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    const pair_in<double>& at = now[i];
    // The D of an increment is relative to moved faces.
    all.push_back(m.is_end ? reading_of(at, at.seen_in(m.step->displacement), m.step->closed(i))
                           : reading_of(at, m.increment->d[i] + (at.face - p.pairs[i].face),
                                        m.increment->isep[i] == in_contact));
    if (m.is_end && !m.step->numbers.pair_forces.empty()) all.back().force = m.step->numbers.pair_forces[i];
  }
  return all;
}

/// The node, from 0, with the largest deflection at the ends of steps.
int node_that_deflects_most(const run_result& r) {
  double most = 0.0;
  int at = 0;
  for (const solved_step& s : r.record.steps) {
    for (const int node : deflecting_nodes(r.what)) {
      const double size = std::abs(deflection_of(r.what, s.displacement, node));
      if (size > most) at = node;
      most = std::max(most, size);
    }
  }
  return at;
}

/// The beginning of each row: number and name of the step.
std::string step_of(const step_results& r) {
  return fmt::format("{},{}", r.state.step, csv_field(r.what.steps[r.state.step - 1].name));
}

std::string rows_of(const beam& b, const step_results& r) {
  const beam_lines lines = r.lines().value();
  const std::vector<double> pressure = bed_pressure(r);
  const std::span<const double> u = r.state.displacement;
  std::string rows;
  const auto add = [&](int e, const std::string& node, double x, double w, double slope, double moment,
                       double shear, const std::string& pressure_here) {
    const std::string stress = r.stresses().names.empty() ? "" : fmt::format(",{}", moment / b.sections[e].W);
    const std::string axis =
        b.GA.empty() ? "" : fmt::format(",{}", slope - shear_flexibility_of<double>(b, e) * shear);
    rows += row_of(step_of(r), e + 1, node, x, w, slope, moment, shear, pressure_here + axis + stress);
  };
  const auto add_end = [&](int e, std::size_t right, double slope) {
    const auto node = static_cast<std::size_t>(e) + right;
    add(e, std::to_string(node + 1), b.x[node], u[2 * node], slope, lines.ends().at(e, 1)[right],
        lines.ends().at(e, 0)[right], r.what.beds.empty() ? "" : fmt::format("{}", pressure[node]));
  };
  const auto add_inside = [&](int e, const element_line& at, double x, double t) {
    add(e, "", x, polynomial_at(at.w, t), polynomial_at(at.slope, t), polynomial_at(at.moment, t),
        polynomial_at(at.shear, t), "");
  };
  for (int e = 0; e < b.elements(); ++e) {
    const std::vector<element_line> pieces = lines.pieces(e);
    add_end(e, 0, u[2 * e + 1]);
    for (const element_line& at : pieces) {
      if (&at != &pieces.front()) add_inside(e, at, at.left, 0.0);
      for (const double t : extreme_places(at)) add_inside(e, at, at.left + t * at.h, t);
      if (&at != &pieces.back()) add_inside(e, at, at.right, 1.0);
    }
    // At a hinge, u has the slope on the right of the node; here the slope on the left is needed.
    add_end(e, 1, b.has_hinge(e + 1) ? polynomial_at(pieces.back().slope, 1.0) : u[2 * e + 3]);
  }
  return rows;
}

/// [nodes] of the values in the elements at a node, which differ there, the one with the largest magnitude.
std::vector<double> largest_at_nodes(const model& m, const std::vector<double>& in_elements) {
  std::vector<double> most(nodes(m));
  auto value = in_elements.begin();
  for (int e = 0; e < elements(m); ++e)
    for (const int node : nodes_of_element(m, e)) {
      if (std::abs(*value) > std::abs(most[node])) most[node] = *value;
      ++value;
    }
  return most;
}

std::string rows_of(const plate& p, const step_results& r) {
  std::vector<quantity_column> columns = columns_of(r, on::nodes);
  for (const auto& [row, values] : columns_of(r, on::element_ends))
    columns.push_back({row, largest_at_nodes(r.what.geometry, values)});
  std::string rows;
  for (int node = 0; node < p.nodes(); ++node) {
    const place at = place_of_node(r.what.geometry, node);
    std::string numbers = fmt::format("{}", at.y);
    for (const auto& [row, values] : columns) numbers += fmt::format(",{}", values[node]);
    rows += row_of(step_of(r), node + 1, at.x, numbers);
  }
  return rows;
}

std::string rows_of(const assembled& a, const step_results& r) {
  std::string rows;
  for (int dof = 0; dof < a.dofs(); ++dof)
    rows += row_of(step_of(r), csv_field(a.label_of(dof)), r.state.displacement[dof]);
  return rows;
}

/// The node of an entry, the dof of a support or the surface of a pair, and the coordinates; empty fields if
/// the entry is at no node.
std::string place_fields(const problem& p, on list, std::size_t i) {
  if (list_of(list).node == nullptr) return ",,,";
  const int node = list_of(list).node(p, i);
  const std::string_view what = list == on::pairs ? surface_name(p.pairs[i].surface)
                                : list == on::supports
                                    ? std::string_view(dof_names(p.geometry)[p.supports[i].dof])
                                    : "";
  const std::string name = csv_field(place_name(p.geometry, node));
  if (std::holds_alternative<assembled>(p.geometry.kind)) return fmt::format("{},{},,", name, what);
  const place at = place_of_node(p.geometry, node);
  return fmt::format("{},{},{:.6g},{:.6g}", name, what, at.x, at.y);
}

std::string columns_of(const problem& p) {
  if (std::holds_alternative<assembled>(p.geometry.kind)) return "dof,value";
  const bool of_beam = std::holds_alternative<beam>(p.geometry.kind);
  std::string columns = of_beam ? "element,node,x,w,slope,moment,shear,pressure" : "node,x,y";
  const auto add = [&](on list) {
    for (const quantity_row* row : quantities_of(p, list))
      if (!of_beam || row->in == unit::stress || (list == on::element_ends && row->in == unit::none))
        columns += "," + std::string(row->key);
  };
  add(on::nodes);
  add(on::element_ends);
  return columns;
}

}  // namespace

void write_csv(const run_result& r, int watched, output_file& increments, output_file* pairs) {
  const problem& p = r.what;
  const load_path loads(p);
  path_states states(r);
  if (watched < 0) watched = node_that_deflects_most(r);
  increments.write(
      "step,increment,kind,s,share,force,events,closed,open,at_face,smin,kernels,node,w,name\r\n");
  if (pairs != nullptr)
    pairs->write("step,increment,pair,node,surface,state,look,w,gap,force,face,x,y,label,name\r\n");
  for (const path_moment& m : moments_of(r)) {
    const structure_state s = states.at(m);
    const std::vector<pair_reading> readings = readings_at(p, load_at(p, s.step, s.fraction), m);
    std::optional<double> w;
    if (!s.displacement.empty()) w = deflection_of(p, s.displacement, watched);
    increments.write(csv_row(r, loads, m, readings, watched, w));
    for (std::size_t i = 0; i < readings.size() && pairs != nullptr; ++i) {
      const contact_pair& at = p.pairs[i];
      const pair_reading& now = readings[i];
      const bool of_matrix = std::holds_alternative<assembled>(p.geometry.kind);
      const place where = of_matrix ? place() : place_of_node(p.geometry, at.node);
      pairs->write(row_of(s.step, s.number, i + 1, csv_field(place_name(p.geometry, at.node)),
                          surface_name(at.surface), state_name(s.isep[i]), look_name(now.look), now.w,
                          now.gap, now.force, now.face,
                          of_matrix ? std::string(",") : fmt::format("{},{}", where.x, where.y),
                          csv_field(name_of_entry(p, on::pairs, i)), csv_field(p.steps[s.step - 1].name)));
    }
  }
  increments.finish();
  if (pairs != nullptr) pairs->finish();
}

void write_states_csv(const run_result& r, output_file& out) {
  std::visit(
      [&](const auto& kind) {
        out.write(row_of("step", "name", columns_of(r.what)));
        for (const solved_step& s : r.record.steps) out.write(rows_of(kind, step_results(r.what, s)));
      },
      r.what.geometry.kind);
  out.finish();
}

void write_supports_csv(const run_result& r, output_file& out) {
  const problem& p = r.what;
  std::vector<const quantity_row*> columns;
  std::string heading = "step,name,on,number,place,what,x,y,label";
  for (const on list : lists_of_entries)
    for (const quantity_row* row : quantities_of(p, list)) {
      columns.push_back(row);
      heading += "," + std::string(row->key);
    }
  out.write(row_of(heading));
  for (const solved_step& s : r.record.steps) {
    const step_results read(p, s);
    std::vector<std::vector<double>> numbers;
    numbers.reserve(columns.size());
    for (const quantity_row* row : columns) numbers.push_back(row->values(read));
    for (const on list : lists_of_entries) {
      if (quantities_of(p, list).empty()) continue;
      for (std::size_t i = 0; i < list_of(list).count(p); ++i) {
        std::string fields = place_fields(p, list, i) + ',' + csv_field(name_of_entry(p, list, i));
        for (std::size_t c = 0; c < columns.size(); ++c)
          fields += columns[c]->where == list && !std::isnan(numbers[c][i])
                        ? fmt::format(",{:.6g}", numbers[c][i])
                        : ",";
        out.write(row_of(step_of(read), list_of(list).name, i + 1, fields));
      }
    }
  }
  out.finish();
}

void write_envelope_csv(const run_result& r, output_file& out) {
  const envelope all = envelope_of(r, true);
  std::string row = "x";
  for (const envelope::listed& c : all.curves)
    row += fmt::format(",{0}_min,{0}_min_step,{0}_max,{0}_max_step", c.row->key);
  out.write(row_of(row));
  for (std::size_t i = 0; i < all.x.size(); ++i) {
    row = fmt::format("{}", all.x[i]);
    for (const envelope::listed& c : all.curves)
      for (const envelope::reached& at : {c.at[i].least, c.at[i].most})
        row += fmt::format(",{},{}", at.value, at.step);
    out.write(row_of(row));
  }
  out.finish();
}

}  // namespace contct
