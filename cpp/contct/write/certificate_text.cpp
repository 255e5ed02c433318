#include "contct/write/certificate_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/write/words.hpp"

namespace contct::write {
namespace {

/// Correct digits at a relative error. Above ten they depend on the LAPACK in use.
std::string digits_words(double error) {
  constexpr int enough = 10;
  const int digits = error > 0.0 ? static_cast<int>(-std::log10(error)) : enough;
  return digits >= enough ? fmt::format("{} digits or more", enough) : fmt::format("{} digits", digits);
}

/// The toggle farthest from its face, up to the end of a step; null when all were at theirs.
const early_toggle* worst_until(int step, const early_toggles& early) {
  const early_toggle* worst = nullptr;
  for (const early_toggle& t : early.all()) {
    if (t.step <= step && (worst == nullptr || t.share > worst->share)) worst = &t;
  }
  return worst;
}

std::string words_for(const early_toggle& t, const problem& p) {
  const contact_pair& at = p.pairs[t.what.pair];
  return fmt::format(
      "increment {}.{} let pair {} ({}, {}) {} contact {:.2g} away from its face ({:.2g} of "
      "the largest deflection)",
      t.step, t.number, t.what.pair + 1, place_words(p.geometry, at.node), surface_name(at.surface),
      change_name(t.what.what), t.distance, t.share);
}

}  // namespace

std::string certificate_mark(const std::optional<certificate>& c) {
  if (!c) return "no certificate";
  return c->exact ? "certified" : "NOT certified";
}

std::vector<std::string> certificate_summary(const certifier& judged) {
  const auto& steps = judged.steps();
  const auto bad = std::find_if(steps.begin(), steps.end(), [](const auto& c) { return c && !c->exact; });
  if (bad != steps.end()) {
    return {fmt::format("step {} is NOT certified: {}", bad - steps.begin() + 1, (*bad)->problem),
            fmt::format("allowed: {:.1e}", (*bad)->tolerance)};
  }
  double worst = 0.0;
  int certified = 0;
  int independent = 0;
  for (const auto& c : steps) {
    if (!c) continue;
    ++certified;
    if (!c->independent) continue;
    ++independent;
    worst =
        std::max({worst, c->displacement_error, c->shape_error, c->equilibrium, c->penetration, c->tension});
  }
  if (certified == 0) return {};
  const std::string states = certified == 1   ? "the final state is"
                             : certified == 2 ? "both final states are"
                                              : fmt::format("all {} final states are", certified);
  std::vector<std::string> items = {states + " certified"};
  if (independent > 0) items.push_back("the oracle agrees to " + digits_words(worst));
  if (independent < certified)
    items.push_back(fmt::format("{} taken from the oracle, by equilibrium, penetration and tension alone",
                                certified - independent));
  return items;
}

std::vector<std::string> certificate_complaints(const problem& p, const certifier& judged,
                                                const early_toggles& early) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < judged.steps().size(); ++i) {
    const auto& c = judged.steps()[i];
    if (!c || c->exact) continue;
    std::string line =
        fmt::format("step {} is not certified: {}; allowed: {:.1e}", i + 1, c->problem, c->tolerance);
    const early_toggle* worst = worst_until(static_cast<int>(i) + 1, early);
    if (worst != nullptr) line += "; " + words_for(*worst, p);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace contct::write
