#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/session/path_states.hpp"
#include "contct/session/step_results.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/outputs.hpp"
#include "contct/write/words.hpp"

namespace contct {

std::string csv_field(std::string_view raw) {
  // Spreadsheets take a cell that begins so for a formula.
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

/// The row of a moment. A step that ends without an increment has none of its numbers.
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
  return fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", step, i == nullptr ? 0 : i->number, kind,
      i == nullptr ? "" : number(i->s), fraction, loads.resultant_at(step, fraction).force,
      csv_field(i == nullptr ? "" : event_names(i->events)), count(pair_state::closed),
      count(pair_state::open), count(pair_state::at_face), i == nullptr ? "" : number(i->smin),
      !is_compared ? ""
      : i->equal   ? "equal"
                   : "differ",
      csv_field(place_name(r.what.geometry, watched)), number(w), csv_field(r.what.steps[step - 1].name));
}

/// Within a step by the path's own D.
std::vector<pair_reading> readings_at(const problem& p, const load& l, const path_moment& m) {
  const std::vector<contact_pair> now = pairs_under(p, l);
  std::vector<pair_reading> all;
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    const contact_pair& at = now[i];
    // D is counted from moving faces.
    all.push_back(m.is_end ? reading_of(at, at.seen_in(m.step->end.displacement, dofs_per_node(p.geometry)),
                                        m.step->end.closed(i))
                           : reading_of(at, m.increment->d[i] + (at.face - p.pairs[i].face),
                                        m.increment->isep[i] == in_contact));
    if (m.is_end && m.step->end.numbers) all.back().force = m.step->end.numbers->pair_forces[i];
  }
  return all;
}

/// Columns at the ends of steps.
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
      pairs->write(fmt::format("{},{},{},{},{},{},{},{},{},{},{}\r\n", s.step, s.number, i + 1,
                               csv_field(place_name(p.geometry, at.node)), surface_name(at.surface),
                               state_name(s.isep[i]), look_name(now.look), now.w, now.gap, now.force,
                               now.face));
    }
  }
  increments.finish();
  if (pairs != nullptr) pairs->finish();
}

}  // namespace contct
