#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "contct/session/path_states.hpp"
#include "contct/session/step_results.hpp"
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
  const std::string_view kind = i == nullptr ? m.step->from_fallback ? "rescue" : "end"
                                : i->snaps   ? "snap"
                                             : "load";
  const auto count = [&pairs](pair_state look) {
    return std::ranges::count(pairs, look, &pair_reading::look);
  };
  const auto number = [](const std::optional<double>& x) { return x ? fmt::format("{}", *x) : ""; };
  const int step = m.step->end.step;
  const double fraction = i == nullptr ? m.step->end.fraction : i->fraction;
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
  const std::vector<contact_pair> now = pairs_under(p, l);
  std::vector<pair_reading> all;
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    const contact_pair& at = now[i];
    // The D of an increment is relative to moved faces.
    all.push_back(m.is_end ? reading_of(at, at.seen_in(m.step->end.displacement, dofs_per_node(p.geometry)),
                                        m.step->end.closed(i))
                           : reading_of(at, m.increment->d[i] + (at.face - p.pairs[i].face),
                                        m.increment->isep[i] == in_contact));
    if (m.is_end && m.step->end.numbers) all.back().force = m.step->end.numbers->pair_forces[i];
  }
  return all;
}

/// The node, from 0, with the largest deflection at the ends of steps.
int node_that_deflects_most(const run_result& r) {
  double most = 0.0;
  int at = 0;
  for (const step_record& s : r.record.steps) {
    for (const int node : deflecting_nodes(r.what)) {
      const double size = std::abs(deflection_of(r.what, s.end.displacement, node));
      if (size > most) at = node;
      most = std::max(most, size);
    }
  }
  return at;
}

struct end_of_step {
  const problem& what;
  const structure_state& state;
  load acting = load_path(what).at(state.step, state.fraction);
  step_results read = results_of(what, acting, state);
  std::string step = fmt::format("{},{}", state.step, csv_field(what.steps[state.step - 1].name));
  std::vector<double> pressure = bed_pressure(what, read.pairs);

  [[nodiscard]] double u(int dof) const { return state.displacement[dof]; }
  [[nodiscard]] std::string pressure_at(int node) const {
    return what.beds.empty() ? "" : fmt::format("{}", pressure[node]);
  }
};

std::string rows_of(const beam& b, const end_of_step& s) {
  const beam_lines lines(b, s.acting, s.state.displacement, s.read.elements.values);
  std::string rows;
  const auto add = [&](int e, const std::string& node, double x, double w, double slope, double moment,
                       double shear, const std::string& pressure) {
    const std::string stress =
        s.read.stresses.names.empty() ? "" : fmt::format(",{}", moment / b.sections[e].W);
    rows += row_of(s.step, e + 1, node, x, w, slope, moment, shear, pressure + stress);
  };
  const auto add_end = [&](int e, int right, double slope) {
    const int node = e + right;
    add(e, std::to_string(node + 1), b.x[node], s.u(2 * node), slope, lines.ends().at(e, 1)[right],
        lines.ends().at(e, 0)[right], s.pressure_at(node));
  };
  const auto add_inside = [&](int e, const element_line& at, double x, double t) {
    add(e, "", x, polynomial_at(at.w, t), polynomial_at(at.slope, t), polynomial_at(at.moment, t),
        polynomial_at(at.shear, t), "");
  };
  for (int e = 0; e < b.elements(); ++e) {
    const std::vector<element_line> pieces = lines.pieces(e);
    add_end(e, 0, s.u(2 * e + 1));
    for (const element_line& at : pieces) {
      if (&at != &pieces.front()) add_inside(e, at, at.left, 0.0);
      for (const double t : extreme_places(at)) add_inside(e, at, at.left + t * at.h, t);
      if (&at != &pieces.back()) add_inside(e, at, at.right, 1.0);
    }
    // At a hinge, s.u has the slope on the right of the node; here the slope on the left is needed.
    add_end(e, 1, b.has_hinge(e + 1) ? polynomial_at(pieces.back().slope, 1.0) : s.u(2 * e + 3));
  }
  return rows;
}

/// The largest von Mises stress at each node, because the elements at a node have different stresses there.
std::vector<double> von_mises_at_nodes(const model& m, const element_results& stresses) {
  std::vector<double> most(nodes(m));
  for (std::size_t e = 0; e < stresses.elements(); ++e)
    for (std::size_t corner = 0; const int node : nodes_of_element(m, static_cast<int>(e)))
      most[node] = std::max(most[node], stresses.at(e, stresses.names.size() - 1)[corner++]);
  return most;
}

std::string rows_of(const plate& p, const end_of_step& s) {
  const std::vector<double> stresses = von_mises_at_nodes(s.what.geometry, s.read.stresses);
  std::string rows;
  for (int node = 0; node < p.nodes(); ++node) {
    const place at = place_of_node(s.what.geometry, node);
    const std::string stress = s.read.stresses.names.empty() ? "" : fmt::format(",{}", stresses[node]);
    rows += row_of(s.step, node + 1, at.x, at.y, s.u(3 * node), s.u(3 * node + 1), s.u(3 * node + 2),
                   s.pressure_at(node) + stress);
  }
  return rows;
}

std::string rows_of(const assembled& a, const end_of_step& s) {
  std::string rows;
  for (int dof = 0; dof < a.dofs(); ++dof) rows += row_of(s.step, csv_field(a.label_of(dof)), s.u(dof));
  return rows;
}

std::string columns_of(const beam& b) {
  const bool has_stress = !b.sections.empty() && b.sections.front().W > 0.0;
  return std::string("element,node,x,w,slope,moment,shear,pressure") + (has_stress ? ",stress" : "");
}

std::string columns_of(const plate& p) {
  return std::string("node,x,y,w,wx,wy,pressure") + (p.thickness > 0.0 ? ",von_mises" : "");
}

std::string columns_of(const assembled& /*a*/) {
  return "dof,value";
}

}  // namespace

void write_csv(const run_result& r, int watched, output_file& increments, output_file* pairs) {
  const problem& p = r.what;
  const load_path loads(p);
  path_states states(r);
  if (watched < 0) watched = node_that_deflects_most(r);
  increments.write(
      "step,increment,kind,s,share,force,events,closed,open,at_face,smin,kernels,node,w,name\r\n");
  if (pairs != nullptr) pairs->write("step,increment,pair,node,surface,state,look,w,gap,force,face\r\n");
  for (const path_moment& m : moments_of(r)) {
    const structure_state s = states.at(m);
    const std::vector<pair_reading> readings = readings_at(p, loads.at(s.step, s.fraction), m);
    std::optional<double> w;
    if (!s.displacement.empty()) w = deflection_of(p, s.displacement, watched);
    increments.write(csv_row(r, loads, m, readings, watched, w));
    for (std::size_t i = 0; i < readings.size() && pairs != nullptr; ++i) {
      const contact_pair& at = p.pairs[i];
      const pair_reading& now = readings[i];
      pairs->write(row_of(s.step, s.number, i + 1, csv_field(place_name(p.geometry, at.node)),
                          surface_name(at.surface), state_name(s.isep[i]), look_name(now.look), now.w,
                          now.gap, now.force, now.face));
    }
  }
  increments.finish();
  if (pairs != nullptr) pairs->finish();
}

void write_states_csv(const run_result& r, output_file& out) {
  std::visit(
      [&](const auto& kind) {
        out.write(row_of("step", "name", columns_of(kind)));
        for (const step_record& s : r.record.steps) out.write(rows_of(kind, end_of_step{r.what, s.end}));
      },
      r.what.geometry.kind);
  out.finish();
}

void write_envelope_csv(const run_result& r, output_file& out) {
  const envelope_curves all = curves_of(r);
  std::string row = "x";
  for (const std::string_view name : {"w", "moment", "shear"})
    row += fmt::format(",{0}_min,{0}_min_step,{0}_max,{0}_max_step", name);
  out.write(row_of(row));
  for (std::size_t i = 0; i < all.x.size(); ++i) {
    row = fmt::format("{}", all.x[i]);
    for (const envelope_curves::curve& c : all.curves)
      row += fmt::format(",{},{},{},{}", c.at[i].least.value, c.at[i].least.step, c.at[i].most.value,
                         c.at[i].most.step);
    out.write(row_of(row));
  }
  out.finish();
}

}  // namespace contct
