#include "contct/write/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/outside/registry.hpp"

namespace contct::write {
namespace {

/// Correct digits at a relative error. Above ten they depend on the LAPACK in use.
std::string digits_words(double error) {
  constexpr int enough = 10;
  const int digits = error > 0.0 ? static_cast<int>(-std::log10(error)) : enough;
  return digits >= enough ? fmt::format("{} digits or more", enough) : fmt::format("{} digits", digits);
}

/// The toggle farthest from its face, up to the end of a step, in words; nothing when all were at theirs, but
/// for the rounding of the step's deflections.
std::string worst_until(int step, const certificate& c, const problem& p, const early_toggles& early) {
  const double deflection = c.allowed[quantity::w].value_or(0.0) / certified_share;
  const early_toggle* worst = nullptr;
  for (const early_toggle& t : early.all()) {
    if (t.distance <= 1e-13 * deflection) continue;
    if (t.step <= step && (worst == nullptr || t.share > worst->share)) worst = &t;
  }
  if (worst == nullptr) return "";
  const contact_pair& at = p.pairs[worst->what.pair];
  return fmt::format(
      "; in increment {}.{} pair {} ({}, {}) {} contact {:.2g} from its face ({:.2g} of the largest "
      "deflection)",
      worst->step, worst->number, worst->what.pair + 1, place_words(p.geometry, at.node),
      surface_name(at.surface), worst->what.what == change::make ? "made" : "broke", worst->distance,
      worst->share);
}

/// The pair in contact that pulls most, in words; nothing where none does.
std::string pull_words(const certificate& c, const problem& p) {
  if (c.pulling < 0) return "";
  const contact_pair& at = p.pairs[c.pulling];
  return fmt::format("; pair {} ({}, {}) pulls with {:.3g}", c.pulling + 1, place_words(p.geometry, at.node),
                     surface_name(at.surface), c.pull);
}

}  // namespace

std::string certificate_mark(const std::optional<certificate>& c) {
  if (!c) return "no certificate";
  return c->certified ? "certified" : "NOT certified";
}

std::string digits_words(const certificate& c) {
  constexpr int enough = 10;
  const int digits = digits_of(c);
  if (digits >= enough) return fmt::format("{}+ digits", enough);
  return fmt::format("{} digit{}", digits, digits == 1 ? "" : "s");
}

std::vector<std::string> certificate_summary(const certifier& judged, bool solved) {
  const auto& steps = judged.steps();
  const auto bad = std::ranges::find_if(steps, [](const auto& c) { return c && !c->certified; });
  if (bad != steps.end()) {
    return {fmt::format("step {} is NOT certified: {}", bad - steps.begin() + 1, (*bad)->problem),
            fmt::format("allowed: {:.1e}", certified_share)};
  }
  double worst = 0.0;
  const auto certified = std::ranges::count_if(steps, [](const auto& c) { return c.has_value(); });
  for (const auto& c : steps)
    if (c) worst = std::max(worst, c->worst_share);
  if (!solved) {
    std::vector<std::string> items = {"the run is NOT certified: its path ended before the full load"};
    if (certified == 1) items.emplace_back("step 1 is certified");
    if (certified > 1) items.push_back(fmt::format("steps 1 to {} are certified", certified));
    return items;
  }
  const std::string states = certified == 1   ? "the final state is"
                             : certified == 2 ? "both final states are"
                                              : fmt::format("all {} final states are", certified);
  std::vector<std::string> items = {states + " certified",
                                    "proved: " + digits_words(worst) + " of every number"};
  const auto loose = std::ranges::find_if(steps, [](const auto& c) { return c && !c->unique; });
  if (loose != steps.end())
    items.push_back(
        fmt::format("but displacements of step {}: its load leaves a rigid-body motion as it is, and "
                    "nothing stops that",
                    loose - steps.begin() + 1));
  return items;
}

std::vector<std::string> certificate_complaints(const problem& p, const certifier& judged,
                                                const early_toggles& early) {
  std::vector<std::string> lines;
  for (int step = 1; const auto& c : judged.steps()) {
    if (c && !c->certified)
      lines.push_back(fmt::format("step {} is not certified: {}; allowed: {:.1e}{}{}", step, c->problem,
                                  certified_share, pull_words(*c, p), worst_until(step, *c, p, early)));
    ++step;
  }
  return lines;
}

std::string remedy_words(const std::vector<std::string>& kernels, const std::string& file) {
  if (kernels.empty() || facts_of_kernel(kernels.front()).rule != "listing") return "";
  return fmt::format("the corrected rule has no such errors: contct run {} --kernels corrected", file);
}

}  // namespace contct::write
