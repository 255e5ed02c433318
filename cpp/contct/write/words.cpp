#include "contct/write/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/kernel/registry.hpp"
#include "contct/linear/cholesky.hpp"
#include "contct/results/quantities.hpp"
#include "contct/results/rule_1989.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

/// The number of correct digits at a relative error, up to 10: further digits depend on the LAPACK in use.
std::string digits_words(double error) {
  constexpr int enough = 10;
  const int digits = error > 0.0 ? static_cast<int>(-std::log10(error)) : enough;
  return digits >= enough ? fmt::format("{} digits or more", enough) : fmt::format("{} digits", digits);
}

/// The event that was farthest from the face of its pair, up to the end of a step, in words; empty if every
/// pair was at its face except for the rounding of deflections.
std::string worst_until(int step, const certificate& c, const problem& p, const early_toggles& early) {
  const double deflection = c.allowed[quantity::w].value_or(0.0) / certified_share;
  const early_toggle* worst = nullptr;
  for (const early_toggle& t : early.all()) {
    if (t.distance <= 1e-13 * deflection) continue;
    if (t.step <= step && (worst == nullptr || t.share > worst->share)) worst = &t;
  }
  if (worst == nullptr) return "";
  return fmt::format(
      "; in increment {}.{} {} {} contact {:.2g}{} from its face ({} of the largest deflection)", worst->step,
      worst->number, pair_words(p, worst->what.pair), worst->what.what == change::make ? "made" : "broke",
      worst->distance, unit_words(p, unit::length), percent_words(worst->share));
}

std::string allowed_words(const certificate& c) {
  return c.rule.empty() ? percent_words(certified_share) : c.rule;
}

/// The pair in contact that pulls most, in words; empty if none pulls.
std::string pull_words(const certificate& c, const problem& p) {
  if (c.pulling < 0) return "";
  return fmt::format("; {} pulls with {:.3g}{}", pair_words(p, c.pulling), c.pull,
                     unit_words(p, unit::force));
}

}  // namespace

std::vector<std::string> first_of(std::vector<std::string> lines) {
  constexpr std::size_t most = 12;
  if (lines.size() <= most) return lines;
  const std::size_t more = lines.size() - most;
  lines.resize(most);
  lines.push_back(fmt::format("and {} more combinations; --json has all of them", more));
  return lines;
}

std::string event_names(std::span<const event> events) {
  std::vector<std::string> names;
  for (const event& e : events) names.push_back(fmt::format("{} {}", change_name(e.what), e.pair + 1));
  return joined(names, ", ");
}

std::string share_words(double x) {
  for (int digits = 8; digits > 1; --digits) {
    std::string text = fmt::format("{:.{}g}", x, digits);
    if (x < 1.0 && text == "1") return fmt::format("1-{:.0e}", 1.0 - x);
    if (text.size() <= 9) return text;
  }
  return fmt::format("{:.1g}", x);
}

std::string pair_words(const problem& p, std::size_t pair) {
  const contact_pair& at = p.pairs[pair];
  const std::string other = at.other < 0 ? "" : " against " + place_words(p.geometry, at.other);
  return fmt::format("pair {} ({}{}, {})", pair + 1, entry_words(p, on::pairs, pair), other,
                     surface_name(at.surface));
}

std::string digits_words(const certificate& c) {
  constexpr int enough = 10;
  const int digits = digits_of(c);
  if (digits >= enough) return fmt::format("{}+ digits", enough);
  return fmt::format("{} digit{}", digits, digits == 1 ? "" : "s");
}

std::string step_words(const problem& p, int step) {
  return starts_from_zero(p) ? "combination " + in_quotes(p.steps[step - 1].name)
                             : fmt::format("step {}", step);
}

namespace {

/// What is proved about the mesh of a beam with beds, over all steps.
std::vector<std::string> mesh_words(const problem& p, const mesh_error& e) {
  if (!e.not_proved.empty()) return {"the error of the mesh is not proved: " + e.not_proved};
  std::vector<std::string> shares;
  for (const mesh_number& n : e.numbers) {
    const auto is = [&n](const quantity_name& name) { return n.key == name.key; };
    const bool is_force = is(name_of(quantity::force));
    const bool is_told =
        !is(name_of(quantity::slope)) && !is(name_of(quantity::gap)) && (!is_force || contacts_of(p) > 0);
    if (!is_told || n.of == 0.0) continue;
    std::string_view words = n.key;
    for (const quantity_name& name : {name_of(quantity::force), bed_force_name, bed_contact_name})
      if (is(name)) words = name.words;
    shares.push_back(fmt::format("{} {}", words, percent_words(n.error / n.of)));
  }
  if (shares.empty()) return {};
  std::vector<std::string> items = {"mesh error, proved: " + joined(shares, ", ") + " of the largest"};
  std::vector<std::string> without;
  constexpr double noticeable = 0.01;
  for (const true_extremes& x : e.extremes) {
    const double size = std::max(x.most, -x.least);
    const auto add = [&](double told, double found, int step) {
      const double exact =
          std::abs(found) > 1e-9 * std::max(x.told_most, -x.told_least) ? found : 0.0;  // rounding
      if (std::abs(exact - told) <= noticeable * size) return;
      without.push_back(fmt::format("{} {:.6g}{}", x.key, exact, unit_words(p, row_named(p, x.key).in)));
      if (p.steps.size() > 1) without.back() += " in " + step_words(p, step);
    };
    add(x.told_least, x.least, x.least_step);
    if (x.most != x.least) add(x.told_most, x.most, x.most_step);
  }
  if (!without.empty()) items.push_back("without mesh error: " + joined(without, ", "));
  return items;
}

}  // namespace

std::vector<std::string> certificate_summary(const run_result& r, bool solved) {
  const std::vector<solved_step>& steps = r.record.steps;
  const auto bad =
      std::ranges::find_if(steps, [](const auto& s) { return s.judged && !s.judged->certified; });
  if (bad != steps.end())
    return {fmt::format("{} is NOT certified: {}", step_words(r.what, bad->step), bad->judged->problem),
            "allowed: " + allowed_words(*bad->judged)};
  double worst = 0.0;
  const auto certified = std::ranges::count_if(steps, [](const auto& s) { return s.judged.has_value(); });
  for (const solved_step& s : steps)
    if (s.judged) worst = std::max(worst, s.judged->worst_share);
  if (!solved && starts_from_zero(r.what))
    return {fmt::format("the run is NOT certified: only {} of {} combinations reach their full load",
                        certified, r.what.steps.size()),
            "these are certified"};
  if (!solved) {
    std::vector<std::string> items = {"the run is NOT certified: its path ended before the full load"};
    if (certified == 1) items.emplace_back("step 1 is certified");
    if (certified > 1) items.push_back(fmt::format("steps 1 to {} are certified", certified));
    return items;
  }
  const std::string states = certified == 1   ? "the final state is"
                             : certified == 2 ? "both final states are"
                                              : fmt::format("all {} final states are", certified);
  constexpr double little = 1e-6;  // of the largest number
  const mesh_error of_mesh = largest_of(r.mesh);
  std::vector<std::string> items = {
      states + (has_no_mesh_error(r.what)                      ? " certified: this beam has no mesh error"
                : !r.mesh.empty() && of_mesh.is_within(little) ? " certified"
                                                               : " certified for this mesh"),
      "proved: " + digits_words(worst) + " of every number"};
  if (!r.mesh.empty()) std::ranges::move(mesh_words(r.what, of_mesh), std::back_inserter(items));
  const auto loose = std::ranges::find_if(steps, [](const auto& s) { return s.judged && !s.judged->unique; });
  if (loose != steps.end())
    items.push_back(
        fmt::format("but the displacements of {} are not proved: a rigid-body motion remains free",
                    step_words(r.what, loose->step)));
  return items;
}

std::vector<std::string> certificate_complaints(const run_result& r) {
  std::vector<std::string> lines;
  for (const solved_step& s : r.record.steps)
    if (const std::optional<certificate>& c = s.judged; c && !c->certified)
      lines.push_back(fmt::format("{} is not certified: {}; allowed: {}{}{}", step_words(r.what, s.step),
                                  c->problem, allowed_words(*c), pull_words(*c, r.what),
                                  worst_until(s.step, *c, r.what, r.early)));
  return starts_from_zero(r.what) ? first_of(std::move(lines)) : lines;
}

namespace {

std::string words_of_pairs(const problem& p, const std::vector<int>& pairs) {
  constexpr std::size_t most_named = 8;
  std::string words;
  for (std::size_t i = 0; i < pairs.size() && i < most_named; ++i)
    words += (i == 0 ? "" : ", ") + pair_words(p, pairs[i]);
  if (pairs.size() > most_named) words += fmt::format(" and {} more", pairs.size() - most_named);
  return words;
}

std::string mechanism_words(const problem& p, const path_end& end) {
  if (end.pairs.empty())
    return "no equilibrium: the load of this step drives a rigid-body motion that no support and no pair "
           "stops. Add a support or a pair that stops it";
  return "no equilibrium: when " + words_of_pairs(p, end.pairs) +
         " separated, the structure became a mechanism";
}

/// The reason why nothing holds the structure, for a path that ended although there may be an equilibrium.
std::string loose_words(const problem& p, const path_end& end) {
  if (!end.pairs.empty())
    return "when " + words_of_pairs(p, end.pairs) + " separated, nothing held the structure";
  return end.by_1989_rule
             ? "the supports and the pairs in contact at the start do not hold the structure, which "
               "the 1989 rule needs"
             : "the supports and the pairs in contact do not hold the structure";
}

/// Tells whether the load has an equilibrium, which the path did not reach, and which rule reaches it.
std::string verdict_words(const path_end& end, bool is_answer) {
  if (!end.has_equilibrium)
    return ". Whether there is an equilibrium under the load of this step is not decided";
  if (!*end.has_equilibrium) return ". There is no equilibrium under the load of this step";
  return std::string(". There is an equilibrium under the load of this step") +
         (end.by_1989_rule && is_answer ? ": --kernels corrected reaches it" : "");
}

}  // namespace

std::vector<std::string> words_of_ends(const problem& p, const path_end& end) {
  if (end.status == path_status::solved) return {};
  std::vector<std::string> lines = {end_words(p, end)};
  for (const path_end& other : end.others) lines.push_back(end_words(p, other));
  return first_of(std::move(lines));
}

std::string end_words(const problem& p, const path_end& end, bool is_answer) {
  if (end.status == path_status::solved) return "";
  const auto verdict = [&] { return verdict_words(end, is_answer); };
  const std::string where =
      fmt::format("{}, at share {:.9g} of its load: ", step_words(p, end.step), end.fraction);
  switch (end.status) {
    case path_status::mechanism:
      return where + mechanism_words(p, end);
    case path_status::cycle:
      return where + "a cycle at constant load: these pairs change their status again and again: " +
             words_of_pairs(p, end.pairs) + verdict();
    case path_status::iteration_limit:
      return where + "the limit of increments (--max-increments) is reached" +
             (end.pairs.empty() ? ""
                                : "; these pairs change their status again and again: " +
                                      words_of_pairs(p, end.pairs) + verdict());
    case path_status::path_ended:
      return where + "the path ended: " + loose_words(p, end) + verdict();
    default:
      return where +
             "the structure is held, but its stiffness is too ill-conditioned, or its loads too large, for "
             "double precision: no digit of the answer would be right. Use fewer elements in a span, or "
             "stiffness and loads of less extreme size";
  }
}

namespace {

/// Advice on the pair that is stiffest relative to the structure, if rounding of w may change the force of
/// this pair by more than the force itself; otherwise empty.
std::string stiffness_advice(const run_result& r) {
  constexpr double rigid = 1e8;  // relative stiffness above which digits hardly change
  constexpr double too_stiff = 1e12;
  double most = too_stiff;
  std::string words;
  for (std::size_t i = 0; i < r.structure.pairs.size(); ++i) {
    const int dof = r.structure.pairs[i].dof;
    const double own = r.structure.stiffness.diagonal(r.structure.row_of(dof));
    const double stiffness = r.structure.pairs[i].stiffness;
    if (r.structure.fixed[dof] != 0 || own == 0.0 || stiffness <= most * own) continue;
    most = stiffness / own;
    const double digit = std::pow(10.0, std::floor(std::log10(rigid * own)));
    words = fmt::format(
        "the cause may be the stiffness {:g} of {}, {:.0e} times the structure's stiffness at this dof: the "
        "rounding of w may change the contact force by as much as the force itself. The largest useful "
        "stiffness is {:.0e}; a larger stiffness changes only the 7th digit and later digits",
        stiffness, pair_words(r.what, i), most, std::floor(rigid * own / digit) * digit);
  }
  return words;
}

}  // namespace

std::vector<std::string> complaints_of(const run_result& r) {
  std::vector<std::string> lines = certificate_complaints(r);
  const std::string of_stiffness = stiffness_advice(r);
  if (!of_stiffness.empty() && (!lines.empty() || r.end.status == path_status::not_factored)) {
    lines.push_back(of_stiffness);
    return lines;
  }
  // If a step has no proved bounds, the corrected rule may have no bounds either.
  const bool is_bounded =
      std::ranges::all_of(r.record.steps, [](const auto& s) { return !s.judged || s.judged->proved; });
  if (!lines.empty() && is_bounded && !r.kernels.empty() &&
      facts_of_kernel(r.kernels.front()).rule == contact_rule::listing)
    lines.push_back(
        fmt::format("the corrected rule has no such errors: contct run {} --kernels corrected", r.file));
  return lines;
}

std::vector<std::string> end_messages(const run_result& r) {
  std::vector<std::string> lines = complaints_of(r);
  const std::vector<std::string> why = words_of_ends(r.what, r.end);
  for (const std::string& w : why) lines.push_back(r.file + ": " + w);
  for (const std::string& w : state_warnings(r)) lines.push_back("warning: " + w);
  return lines;
}

std::vector<std::string> refinement_words(const run_result& r) {
  const problem& p = r.what;
  std::vector<std::string> items;
  const auto size = [&p](const quantity_row& row, double x, double of) {
    const std::string unit = unit_words(p, row.in);
    const double share = x == 0.0 ? 0.0 : x / of;
    return 0.0 < x && share <= 1e-9
               ? fmt::format("less than 1e-07 % of {:.4g}{}", of, unit)
               : fmt::format("{}{} ({} of {:.4g})",
                             x < 1000.0 ? fmt::format("{:.3g}", x) : fmt::format("{:.0f}", x), unit,
                             percent_words(share), of);
  };
  for (const mesh_change& c : r.refined) {
    const quantity_row& row = row_named(p, c.kind);
    items.push_back(fmt::format("{}{} by {}", items.empty() ? "half the element size changes the " : "the ",
                                row.words, size(row, c.change, c.of)));
    if (p.steps.size() > 1 && c.change > 1e-9 * c.of) items.back() += " in " + step_words(p, c.step);
  }
  std::size_t estimated = 0;
  for (const mesh_change& c : r.refined) {
    if (!c.order) continue;
    const quantity_row& row = row_named(p, c.kind);
    const std::string error = c.error ? size(row, *c.error, c.of) : "does not converge";
    items.push_back(fmt::format("{}{}: {}",
                                estimated++ == 0 ? "errors of the mesh, estimated by two halvings: " : "",
                                row.words, error));
  }
  if (!items.empty() && std::holds_alternative<beam>(p.geometry.kind))
    items.emplace_back(p.beds.empty() ? "beams are exact between nodes"
                                      : "beams are exact between nodes; the changes come from the bed, which "
                                        "has twice as many pairs then");
  return items;
}

}  // namespace contct
