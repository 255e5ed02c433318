#include "contct/write/explain_text.hpp"

#include <fmt/format.h>

#include <utility>

#include "contct/write/table.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace {

constexpr int margin = 6;
constexpr int statement_width = 49;
constexpr int width_with_statements = 120;

/// "pair 1, node 5, face below, separated: advancing".
std::string pair_words(const model& m, const explained_pair& p) {
  return fmt::format("Pair {}, {}, face {}, {}: {}", p.pair + 1, place_words(m, p.node - 1),
                     surface_name(p.surface), p.isep_before == separated ? "separated" : "in contact",
                     kind_of_contact(p));
}

/// The smallest margin of a call, in ULP where it is small.
std::string margin_of_call(const decision& d) {
  constexpr std::uint64_t close = 1'000'000;
  if (d.ulps <= close) return "The narrowest decision of this call: " + words_of(d) + ".";
  return "No decision of this call was close.";
}

}  // namespace

explain_text::explain_text(const problem& p, std::vector<std::string> names, int real_bytes, int pair,
                           const terminal& t)
    : problem_(p),
      loads_(p),
      names_(std::move(names)),
      real_bytes_(real_bytes),
      pair_(pair),
      terminal_(t),
      shows_statements_(t.width >= width_with_statements) {}

void explain_text::say(paint p, const std::string& words) const {
  for (const std::string& line : wrap({words}, terminal_.width))
    fmt::print("{}\n", painted(terminal_, p, line));
}

/// "  38  s = GAP / d* = 0.25.                 (4)".
void explain_text::say(const sentence& t, bool loud) const {
  std::string head = t.line > 0 ? fmt::format("{:>4}  ", t.line) : std::string(margin, ' ');
  if (shows_statements_) {
    const std::string_view statement = t.line > 0 ? listing::statement_at(t.line) : std::string_view();
    head += fmt::format("{:<{}}", statement, statement_width);
  }
  const int room = terminal_.width - static_cast<int>(head.size());
  std::vector<std::string> lines = wrap({t.words}, room);
  if (!t.equation.empty()) {
    const auto free = room - static_cast<int>(lines.back().size() + t.equation.size());
    if (free >= 1) {
      lines.back() += std::string(free, ' ') + t.equation;
    } else {
      lines.push_back(fmt::format("{:>{}}", t.equation, room));
    }
  }
  for (const std::string& line : lines) {
    fmt::print("{}{}\n", head, loud ? painted(terminal_, paint::bad, line) : line);
    head.assign(head.size(), ' ');
  }
}

void explain_text::print_head() {
  if (std::exchange(begun_, true)) return;
  if (!problem_.title.empty()) say(paint::strong, problem_.title);
  say(paint::quiet,
      "At the left: lines of the listing, fortran/contct.f. At the right: equations of the paper.");
}

void explain_text::print_load(const explained_increment& i) const {
  constexpr int room = 24;
  const std::string now = loads_.words_at(i.what.step, i.fraction_before, room);
  const std::string aim = loads_.words_at(i.what.step, 1.0, room);
  if (now.empty() || aim.empty()) return;
  say(paint::quiet, fmt::format("The residual load leads from {} to {}.", now, aim));
}

void explain_text::print_pair(const explained_increment& i, const explained_pair& p) const {
  fmt::print("\n");
  say(paint::strong, pair_words(problem_.geometry, p));
  for (const sentence& t : scale_factor_story(p)) say(t);
  if (i.other == nullptr) return;
  const double second = i.other->ss[p.pair];
  const sentence bits{0, "s: " + side_by_side_words(names_[0], p.s, names_[1], second, real_bytes_), {}};
  say(bits, bits.words.find("equal to the bit") == std::string::npos);
}

void explain_text::print_winner(const explained_increment& i) const {
  fmt::print("\n");
  say(paint::strong, "The smallest s");
  for (const sentence& t : winner_story(i.call)) say(t);
  if (i.other != nullptr) {
    const sentence bits{
        0, "SMIN: " + side_by_side_words(names_[0], i.call.smin, names_[1], i.other->smin, real_bytes_), {}};
    say(bits, bits.words.find("equal to the bit") == std::string::npos);
  }
  if (i.call.narrowest) say({0, margin_of_call(*i.call.narrowest), {}});
}

void explain_text::print_toggles(const explained_increment& i) const {
  if (i.call.winner < 0) return;
  for (const explained_pair& p : i.call.pairs) {
    if (!wants(p)) continue;
    fmt::print("\n");
    say(paint::strong, fmt::format("Pair {}: {}", p.pair + 1, name_of(p.why)));
    for (const sentence& t : toggle_story(i.call, p)) {
      const bool loud = t.line == 0 && p.why != why_toggled::same_moment;
      say(t, loud);
    }
    if (i.other == nullptr) continue;
    const int second = i.other->isep[p.pair];
    if (second != p.isep_after)
      say({0, fmt::format("ISEP: {} {}, {} {}: DIFFERENT", names_[0], p.isep_after, names_[1], second), {}},
          true);
  }
}

void explain_text::print_outcome(const explained_increment& i) const {
  fmt::print("\n");
  if (i.left_undone) {
    say(paint::quiet,
        "What would be left of the load after this event is rounding. The driver, not CONTCT, takes the "
        "toggles back and applies the whole residual load.");
  }
  if (i.what.s == 1.0) {
    say(paint::quiet, "The whole residual load is applied: D + d* is the new D (10). The step ends here.");
  } else {
    say(paint::quiet, fmt::format("s = {} of the residual load is applied: D + s d* is the new D (10). {} of "
                                  "the step's load is applied by now.",
                                  share_words(i.what.s), share_words(i.what.fraction)));
  }
  if (i.apart && i.other == nullptr)
    say(paint::bad, fmt::format("{} gave no answer: {}", names_[1], i.apart->follower));
  if (i.apart && i.apart->field == "text")
    say(paint::bad, fmt::format(R"(Unit 26, line {}: {} wrote "{}", {} wrote "{}")", i.apart->index,
                                names_[0], i.apart->leader, names_[1], i.apart->follower));
}

void explain_text::print(const explained_increment& i) {
  print_head();
  fmt::print("\n");
  const std::string heading = fmt::format("Step {}, increment {}", i.what.step, i.what.number);
  say(paint::strong, heading);
  say(paint::strong, std::string(heading.size(), '-'));
  print_load(i);
  for (const explained_pair& p : i.call.pairs) {
    if (wants(p)) print_pair(i, p);
  }
  print_winner(i);
  print_toggles(i);
  print_outcome(i);
}

}  // namespace contct::write
