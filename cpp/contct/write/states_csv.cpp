#include <fmt/format.h>

#include "contct/session/step_results.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/outputs.hpp"

namespace contct {
namespace {

/// A state at the end of a step, and what is read off it.
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
  const auto add_end = [&](int e, int right, double slope) {
    const int node = e + right;
    rows +=
        fmt::format("{},{},{},{},{},{},{},{},{}\r\n", s.step, e + 1, node + 1, b.x[node], s.u(2 * node),
                    slope, lines.ends().at(e, 1)[right], lines.ends().at(e, 0)[right], s.pressure_at(node));
  };
  const auto add_inside = [&](int e, const element_line& at, double x, double t) {
    rows += fmt::format("{},{},,{},{},{},{},{},\r\n", s.step, e + 1, x, polynomial_at(at.w, t),
                        polynomial_at(at.slope, t), polynomial_at(at.moment, t), polynomial_at(at.shear, t));
  };
  for (int e = 0; e < b.elements(); ++e) {
    const std::vector<element_line> pieces = lines.pieces(e);
    add_end(e, 0, s.u(2 * e + 1));
    for (const element_line& at : pieces) {
      if (&at != &pieces.front()) add_inside(e, at, at.left, 0.0);
      for (const double t : extreme_places(at)) add_inside(e, at, at.left + t * at.h, t);
      if (&at != &pieces.back()) add_inside(e, at, at.right, 1.0);
    }
    // At a hinge the node's slope is that on its right.
    add_end(e, 1, b.has_hinge(e + 1) ? polynomial_at(pieces.back().slope, 1.0) : s.u(2 * e + 3));
  }
  return rows;
}

std::string rows_of(const plate& p, const end_of_step& s) {
  std::string rows;
  for (int node = 0; node < p.nodes(); ++node) {
    const place at = place_of_node(s.what.geometry, node);
    rows += fmt::format("{},{},{},{},{},{},{},{}\r\n", s.step, node + 1, at.x, at.y, s.u(3 * node),
                        s.u(3 * node + 1), s.u(3 * node + 2), s.pressure_at(node));
  }
  return rows;
}

std::string rows_of(const assembled& a, const end_of_step& s) {
  std::string rows;
  for (int dof = 0; dof < a.dofs(); ++dof)
    rows += fmt::format("{},{},{}\r\n", s.step, csv_field(a.label_of(dof)), s.u(dof));
  return rows;
}

}  // namespace

void write_states_csv(const run_result& r, output_file& out) {
  constexpr std::string_view columns[] = {"element,node,x,w,slope,moment,shear,pressure",
                                          "node,x,y,w,wx,wy,pressure", "dof,value"};
  const auto& geometry = r.what.geometry.kind;
  out.write(fmt::format("step,name,{}\r\n", columns[geometry.index()]));
  for (const step_record& s : r.record.steps) {
    const end_of_step end{r.what, s.end};
    out.write(std::visit([&end](const auto& kind) { return rows_of(kind, end); }, geometry));
  }
  out.finish();
}

void write_envelope_csv(const run_result& r, output_file& out) {
  const envelope_curves all = curves_of(r);
  out.write("x");
  for (const std::string_view name : {"w", "moment", "shear"})
    out.write(fmt::format(",{0}_min,{0}_min_step,{0}_max,{0}_max_step", name));
  for (std::size_t i = 0; i < all.x.size(); ++i) {
    out.write(fmt::format("\r\n{}", all.x[i]));
    for (const envelope_curves::curve& c : all.curves)
      out.write(fmt::format(",{},{},{},{}", c.at[i].least.value, c.at[i].least.step, c.at[i].most.value,
                            c.at[i].most.step));
  }
  out.write("\r\n");
  out.finish();
}

}  // namespace contct
