#include "contct/write/run_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "contct/path/solve_problem.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace {

/// How much there is to write: a list of scattered elements counts by its length.
std::size_t parts_of(const load& l) {
  std::size_t parts = l.points.size() + l.settlements.size();
  for (const distributed_load& d : l.distributed)
    parts += d.elements.empty() || is_run(d.elements) ? 1 : d.elements.size();
  return parts;
}

/// A load in words, with its one number apart.
struct load_words {
  std::string before;
  double value;
  std::string after{};
};

/// Of settlements alone: the only one, or the largest.
load_words settlement_words(const model& m, const std::vector<prescribed_displacement>& all) {
  const auto size = [](const prescribed_displacement& g) { return std::abs(g.value); };
  const prescribed_displacement& g = *std::ranges::max_element(all, {}, size);
  if (all.size() > 1) return {"settle ", g.value};
  const std::string name =
      std::holds_alternative<assembled>(m.kind) ? "" : fmt::format("{} ", dof_names(m)[g.dof]);
  return {"settle " + name, g.value, " at " + place_words(m, g.node)};
}

load_words words_for(const model& m, const load& l, const resultant& r) {
  const bool of_matrix = std::holds_alternative<assembled>(m.kind);
  if (!l.settlements.empty() && l.points.empty() && l.distributed.empty())
    return settlement_words(m, l.settlements);
  if (!l.settlements.empty()) return {of_matrix ? "sum " : "force ", r.force};
  if (l.points.size() == 1 && l.distributed.empty()) {
    const point_load& p = l.points[0];
    return {of_matrix ? "" : fmt::format("{} ", dof_names(m)[p.dof]), p.value,
            " at " + place_words(m, p.node)};
  }
  if (l.points.empty() && l.distributed.size() == 1 && l.distributed[0].polynomial.size() == 1)
    return {"uniform ", l.distributed[0].polynomial[0]};
  return {of_matrix ? "sum " : "force ", r.force};
}

/// x, or 0 where it is nothing but the rounding of numbers of this size.
double without_rounding(double x, double size) {
  return std::abs(x) <= 32 * std::numeric_limits<double>::epsilon() * size ? 0.0 : x;
}

double between(double a, double b, double share) {
  return without_rounding(a + share * (b - a), std::max(std::abs(a), std::abs(b)));
}

}  // namespace

bool is_run(const std::vector<int>& elements) {
  return elements.back() - elements.front() + 1 == static_cast<int>(elements.size()) &&
         std::is_sorted(elements.begin(), elements.end());
}

load_path::load_path(const problem& p) : problem_(p), totals_{resultant_of(p.geometry, {})}, parts_(1) {
  for (const load& l : p.steps) {
    totals_.push_back(resultant_of(p.geometry, l));
    parts_.push_back(parts_of(l));
  }
}

load load_path::at(int step, double fraction) const {
  if (step == 0) return {};
  return mix(step > 1 ? problem_.steps[step - 2] : load{}, problem_.steps[step - 1], fraction);
}

resultant load_path::resultant_at(int step, double fraction) const {
  const resultant& a = totals_[step - 1];
  const resultant& b = totals_[step];
  resultant r{between(a.force, b.force, fraction), a.moments};
  for (std::size_t i = 0; i < r.moments.size(); ++i)
    r.moments[i] = between(a.moments[i], b.moments[i], fraction);
  return r;
}

bool load_path::has_many_parts(int step) const {
  constexpr std::size_t most = 32;
  return std::max(parts_[step - 1], parts_[step]) > most;
}

std::string load_path::words_at(int step, double fraction, int width) const {
  const auto words_of = [&](double share) {
    const load l = has_many_parts(step) ? load{} : at(step, share);
    return words_for(problem_.geometry, l, resultant_at(step, share));
  };
  load_words w = words_of(fraction);
  w.value = without_rounding(w.value, std::max(std::abs(words_of(0.0).value), std::abs(words_of(1.0).value)));
  const auto fits = [width](const std::string& text) { return static_cast<int>(text.size()) <= width; };
  const std::string number = fmt::format("{:.6g}", w.value);
  for (std::string text : {w.before + number + w.after, w.before + number, number})
    if (fits(text)) return text;
  return "";
}

double deflection_of(const problem& p, std::span<const double> u, int node) {
  return u[static_cast<std::size_t>(node) * dofs_per_node(p.geometry)];
}

pair_reading reading_of(const contact_pair& p, double w, bool closed) {
  return {w, gap_of(p, w, closed), force_of(p, w, closed), look_of(p, w, closed)};
}

pair_reading reading_of(const problem& p, const frame& f, std::size_t pair) {
  const contact_pair& at = p.pairs[pair];
  pair_reading r = reading_of(at, deflection_of(p, f, at.node), f.closed(pair));
  if (!f.pair_forces.empty()) r.force = f.pair_forces[pair];
  return r;
}

std::vector<double> reactions_in(const problem& p, const load& l, const frame& f) {
  return f.numbers ? f.numbers->reactions : reactions(p, l, f.displacement, f.isep);
}

element_results elements_in(const problem& p, const load& l, const frame& f) {
  element_results r = results_in_elements(p.geometry, l, f.displacement);
  if (f.numbers) r.values = f.numbers->element_values;
  return r;
}

void extreme::take(int other_at, double other) {
  if (std::abs(other) > std::abs(value)) *this = {other_at, other};
}

std::vector<int> deflecting_nodes(const problem& p) {
  std::vector<char> is_length(nodes(p.geometry), 1);
  const auto* a = std::get_if<assembled>(&p.geometry.kind);
  if (a != nullptr && (a->places.known() || !p.pairs.empty())) {
    for (std::size_t dof = 0; dof < is_length.size(); ++dof)
      is_length[dof] = a->places.known() && a->places.dofs[dof].is_length() ? 1 : 0;
    for (const contact_pair& pair : p.pairs) is_length[pair.node] = 1;
  }
  std::vector<int> list;
  for (int node = 0; node < nodes(p.geometry); ++node)
    if (is_length[node] != 0) list.push_back(node);
  return list;
}

std::vector<double> bed_pressure(const problem& p, const frame& f) {
  std::vector<double> at(nodes(p.geometry));
  for (const bed& b : p.beds) {
    for (std::size_t i = 0; i < b.share.size(); ++i) {
      const std::size_t pair = b.first_pair + i;
      if (b.share[i] > 0.0) at[p.pairs[pair].node] += reading_of(p, f, pair).force / b.share[i];
    }
  }
  return at;
}

std::string place_name(const model& m, int node) {
  const auto* a = std::get_if<assembled>(&m.kind);
  return a != nullptr ? a->label_of(node) : std::to_string(node + 1);
}

place place_of_node(const model& m, int node) {
  if (const auto* b = std::get_if<beam>(&m.kind)) return {b->x[node], 0.0};
  const auto* p = std::get_if<plate>(&m.kind);
  if (p == nullptr) return {static_cast<double>(node), 0.0};
  return {p->x[node % p->columns()], p->y[node / p->columns()]};
}

void run_recorder::called(const answered_call& c) {
  if (!keeps_calls_) return;
  ++all_calls;
  const std::string_view text = c.text.value_or("");
  all_log += text.size();
  // Whole calls only: a text is never cut in the middle of an event.
  if (log.size() + text.size() <= most_log && log.size() + text.size() == all_log) log += text;
  answers_ = calls.size() < most_calls;
  if (!answers_) return;
  const auto first = c.c.ss.first(std::min(most_ss, c.c.ss.size()));
  calls.push_back({0, 0, c.c.smin, {first.begin(), first.end()}, {}});
  if (compared_ != nullptr) calls.back().followers = compared_->last_answers();
}

void run_recorder::incremented(const increment& i) {
  if (std::exchange(answers_, false)) {
    calls.back().step = i.step;
    calls.back().number = i.number;
  }
  increments_.emplace_back(i);
}

void run_recorder::step_ended(const step_state& s) {
  frame end{.step = s.step,
            .fraction = s.fraction,
            .step_end = true,
            .from_fallback = s.from_fallback,
            .from_exact_path = s.from_exact_path,
            .displacement = {s.displacement.begin(), s.displacement.end()},
            .isep = {s.isep.begin(), s.isep.end()}};
  if (s.numbers != nullptr) end.numbers = *s.numbers;
  steps.push_back({std::move(end), s.rcond, std::exchange(increments_, {})});
}

std::string_view run_result::status() const {
  return equal ? status_name(end.status) : "kernels-disagree";
}

std::string title_of(const problem& p, const std::string& file) {
  const bool named = p.title.find_first_not_of(" \t\r\n") != std::string::npos;
  if (named) return on_one_line(p.title);
  return file == "-" ? "A problem from standard input" : std::filesystem::path(file).filename().string();
}

}  // namespace contct::write
