#include "contct/harness/faulty_line.hpp"

#include <bit>
#include <cmath>
#include <cstdio>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include "contct/harness/compare.hpp"
#include "contct/harness/told_text.hpp"
#include "contct/kernel/contct.hpp"
#include "contct/number/bits.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

namespace l = listing;

constexpr std::int64_t most_calls = 1000;
constexpr std::int64_t most_pairs = 200'000;  // of all judged calls, to bound the time
constexpr double number_bits = 64.0;          // cost of a number that follows no rule
constexpr double always_bits = 30.0;          // cost of each execution where a permanent fault has no effect
constexpr double end_bits = 6.0;              // cost of the end of a loop in a call
constexpr double unexplained_bits = 200.0;    // cost of each differing value that the line does not explain

/// log2 of the number of ways to choose `k` of `n` executions, to a few bits.
double choice_bits(std::int64_t n, std::int64_t k) {
  const auto all = static_cast<double>(n);
  const auto some = static_cast<double>(k);
  if (k == 0 || n <= k) return 0.0;
  return some * std::log2(all / some) + (all - some) * std::log2(all / (all - some));
}

/// The number of pairs before the last ones whose SS all are `unset`.
std::size_t set_pairs(std::span<const double> ss, double unset) {
  std::size_t set = ss.size();
  while (set > 0 && ss[set - 1] == unset) --set;
  return set;
}

/// The cost of describing the wrong number `got`: few bits if it is not finite, if it is 0 or 1 (1 only where
/// `is_1_a_rule`), or if its ratio to `right` is that of the last wrong number; otherwise number_bits.
template <class Real>
double value_bits(suspect& s, Real got, Real right, bool is_1_a_rule = true) {
  const double ratio = static_cast<double>(got) / static_cast<double>(right);
  if (!std::isfinite(got) || got == Real(0) || (is_1_a_rule && got == Real(1))) return 2.0;
  if (std::abs(ratio / s.last_ratio - 1.0) < 1e-6) return 1.0;
  s.last_ratio = ratio;
  return number_bits;
}

}  // namespace

void suspect::count(bool goes_wrong, double bits_if_wrong, double bits_if_right, std::int64_t values) {
  ++reached;
  if (goes_wrong) explain(bits_if_wrong, values);
  if (!goes_wrong) bits += bits_if_right;
}

void suspect::explain(double more_bits, std::int64_t values) {
  ++wrong;
  explained += values;
  bits += more_bits;
}

suspect& fault_finder::at(const listing_line& line, fault kind, std::size_t way) {
  suspect& s = suspects_[faults_of_line * static_cast<std::size_t>(line.number) + kind + way];
  s.line = &line;
  return s;
}

void fault_finder::note(const answered_call& c, int real_bytes, const call_outputs& other, bool equal) {
  if (real_bytes == 8) note_digest(other);
  std::int64_t& calls = equal ? equal_calls_ : differing_calls_;
  if (++calls > most_calls || pairs_ > most_pairs) return;
  pairs_ += c.c.nc();
  in_precision(c.c, real_bytes, [&](const auto& own) { note_call(own, c, other); });
}

void fault_finder::note_digest(const call_outputs& other) {
  const auto word = [this](std::uint32_t w) {
    digest_ = (digest_ ^ w) * 16777619U;
    digest_ ^= digest_ >> 15U;
  };
  const auto number = [&word](double x) {
    const auto bits = std::bit_cast<std::uint64_t>(std::isnan(x) ? std::nan("") : x);
    word(static_cast<std::uint32_t>(bits >> 32U));
    word(static_cast<std::uint32_t>(bits));
  };
  number(other.smin);
  for (const double s : other.ss) number(s);
  for (const int status : other.isep) word(static_cast<std::uint32_t>(status));
}

template <class Real>
void fault_finder::note_call(const call<Real>& c, const answered_call& right, const call_outputs& other) {
  left_by_.clear();
  const std::int64_t before = differ_;
  for (std::size_t i = 0; i < c.cc.size(); ++i) note_pair(c, right, i, static_cast<Real>(other.ss[i]));
  if (!c.cc.empty()) note_loop(c, other.ss);
  note_smallest(other);
  note_toggles<Real>(right, other);
  if (sizeof(Real) == 8) note_flushing(right, other, differ_ - before);
  if (differ_ == before && right.text && *right.text != other.text) note_text(right, other);
}

template <class Real>
void fault_finder::note_pair(const call<Real>& c, const answered_call& right, std::size_t i, Real got) {
  const int status = right.isep_before[i];
  const std::int64_t dof = c.dof.dof_of(c.id[i]) - 1;
  const auto at_dof = [&](std::int64_t other) { return pair_numbers<Real>(c, status, i, other); };
  const pair_numbers<Real> p = at_dof(dof);
  const bool wrong = !same_bits(got, c.ss[i]);
  differ_ += wrong ? 1 : 0;
  // Judges a line that gives `other` if the line is wrong. `left` is the number that the line compares.
  const auto could_give = [&](suspect& s, Real other, Real left, double bits_if_right = 0.0) {
    if (same_bits(other, c.ss[i])) return;
    const bool gives = wrong && same_bits(got, other);
    s.count(gives, 0.0, bits_if_right);
    if (!gives && (p.d_star == Real(0) || p.is_stationary)) return;
    (gives ? s.compared : s.spared).add(static_cast<double>(left));
    (gives ? s.compared_sizes : s.spared_sizes).add(std::abs(static_cast<double>(left)));
  };
  // Judges a line that can give any number if the line is wrong.
  const auto assigns = [&](suspect& s, bool is_1_a_rule = true) {
    s.count(wrong, wrong ? value_bits(s, got, c.ss[i], is_1_a_rule) : 0.0);
  };
  // Judges a line that takes another dof if the line is wrong. If no dof of the call gives `got`, the line
  // may have read outside the arrays, so that any number is possible.
  const auto takes_dof = [&](suspect& s, auto value_at) {
    constexpr std::int64_t most = 2000;
    const std::int64_t end = wrong && !std::isnan(got) ? std::min<std::int64_t>(std::ssize(c.dd), most) : 0;
    std::int64_t k = 0;
    while (k < end && !same_bits(value_at(at_dof(k)), got)) ++k;
    s.count(wrong, !wrong ? 0.0 : k < end ? 8.0 : value_bits(s, got, c.ss[i]));
  };
  could_give(at(l::common), at_dof((c.id[i] - 1LL) * c.dof.indof + c.dof.ndofpn - 1).s, got, always_bits);
  call<Real> swapped = c;
  std::swap(swapped.dd, swapped.dtest);
  could_give(at(l::arguments), pair_numbers<Real>(swapped, status, i, dof).s, got, always_bits);
  const std::int64_t by_pair = static_cast<std::int64_t>(i) * c.dof.ndofpn + c.dof.indof - 1;
  if (by_pair < std::ssize(c.dd)) could_give(at(l::node), at_dof(by_pair).s, got);
  if (by_pair >= std::ssize(c.dd)) assigns(at(l::node));
  could_give(at(l::if_no_response), p.d_star != Real(0) ? Real(1) : p.without_first, p.d_star);
  if (p.d_star == Real(0)) could_give(at(l::if_no_response, other_way), p.without_first, p.d_star);
  takes_dof(at(l::ndof), [](const auto& q) { return q.s; });
  if (p.d_star == Real(0)) return assigns(at(l::no_response));
  could_give(at(l::if_stationary), p.is_stationary ? p.moving : p.at_face, p.gap);
  if (!p.is_stationary) {
    const auto side = static_cast<Real>(c.isurf[i]);
    const Real of_gaps[] = {-p.moving, std::abs(p.gap) / p.d_star, side * p.gap / p.d_star};
    const Real cut[] = {std::min(p.moving, Real(1)), std::max(p.moving, Real(0)),
                        std::clamp(p.moving, Real(0), Real(1))};
    for (std::size_t way = 0; way < std::size(cut); ++way) {
      could_give(at(l::gap, other_way, way), of_gaps[way], p.gap, always_bits);
      could_give(at(l::moving, other_way, way), cut[way], p.gap);
    }
    takes_dof(at(l::gap), [d_star = p.d_star](const auto& q) { return q.gap / d_star; });
    return assigns(at(l::moving));
  }
  could_give(at(l::if_check_positive), p.sschk > Real(0) ? Real(1) : p.event, p.sschk);
  could_give(at(l::check_variable, wrong_sign), pair_numbers<Real>(c, -status, i, dof).s, p.sschk);
  assigns(at(l::gap));
  assigns(at(l::check_variable));
  if (!(p.sschk > Real(0))) return assigns(at(l::stationary));
  assigns(at(l::if_check_positive, wrong_product), false);
}

/// Judges rules by which a wrong DO 10 loop leaves pairs out, if an SS that the kernel does not set is
/// `unset`: the first pair, the last pair, every other pair, or all pairs from one pair on. Returns how many
/// SS the last rule explains.
template <class Real>
std::int64_t fault_finder::note_left_out(const call<Real>& c, std::span<const double> ss, double unset,
                                         std::size_t way) {
  const bool is_marked = unset == not_an_answer;  // any other number can be an answer
  const std::size_t done = set_pairs(ss, unset);
  std::int64_t lost = 0;
  const auto judge = [&](double bits, auto leaves_out) {
    std::int64_t all = lost = 0;
    for (std::size_t i = 0; i < ss.size(); ++i) {
      if (!leaves_out(i) || c.ss[i] == static_cast<Real>(unset)) continue;
      ++all;
      lost += ss[i] == unset ? 1 : 0;
    }
    if (all > 0) at(l::do_10, usual, way).count(lost == all, bits, always_bits, lost);
    ++way;
  };
  const double rule_bits = is_marked ? 0.0 : 2.0;
  judge(rule_bits, [](std::size_t i) { return i == 0; });
  judge(rule_bits, [&](std::size_t i) { return i + 1 == ss.size(); });
  judge(rule_bits, [](std::size_t i) { return i % 2 == 1; });
  judge(is_marked ? end_bits : always_bits, [&](std::size_t i) { return i >= done; });
  return lost;
}

/// Judges the bounds and the step of the DO 10 loop, and lines 32 and 40, where a wrong port leaves the loop.
template <class Real>
void fault_finder::note_loop(const call<Real>& c, std::span<const double> ss) {
  note_left_out(c, ss, 0.0, 8);
  note_left_out(c, ss, 1.0, 4);
  const std::int64_t lost = note_left_out(c, ss, not_an_answer, 0);
  const std::size_t pairs = ss.size();
  const std::size_t done = set_pairs(ss, not_an_answer);
  const auto left_at = [&](suspect& s, auto took) {
    std::size_t i = 0;
    while (i < pairs && !took(i)) ++i;
    if (i + 1 == done) left_by_.push_back(&s);
    if (i + 1 < pairs) s.count(i + 1 == done, 1.0, always_bits, lost);
  };
  left_at(at(l::no_response, loop_left), [&](auto i) { return c.dtest[c.dof.dof_of(c.id[i]) - 1] == 0; });
  left_at(at(l::smallest, loop_left), [&](auto i) { return c.ss[i] > Real(0) && c.ss[i] < Real(1); });
}

/// Judges SMIN by the kernel's SS.
void fault_finder::note_smallest(const call_outputs& other) {
  double least = 1.0;
  bool is_one_of_them = other.smin == 1.0;
  for (const double s : other.ss) {
    if (s > 0.0 && s < least) least = s;
    is_one_of_them = is_one_of_them || same_bits(s, other.smin) || same_bits(std::abs(s), other.smin);
  }
  const bool wrong = !same_bits(least, other.smin);
  differ_ += wrong ? 1 : 0;
  at(l::smallest).count(wrong && is_one_of_them, 1.0);
  for (suspect* s : {&at(l::smin_is_1), &at(l::smallest, any_number)}) {
    const double bits = wrong ? value_bits(*s, other.smin, least) : 0.0;
    s->count(wrong && (s->line != &l::smin_is_1 || !(other.smin > least) || least == 1.0), bits);
  }
  if (wrong && least == 1.0 && other.smin == not_an_answer)
    at(l::if_no_events).explain(2.0);  // returned without storing SMIN
}

template <class Real>
void fault_finder::note_toggles(const answered_call& right, const call_outputs& other) {
  const std::size_t pairs = other.isep.size();
  const auto smin = static_cast<Real>(other.smin);
  std::vector<double> diffs(pairs);
  std::vector<int> toggled(pairs);
  std::vector<std::size_t> expected;  // pairs that DO 30 must toggle
  std::vector<std::size_t> found;     // pairs that the other kernel toggled
  std::int64_t without_event = 0;
  std::int64_t wrong = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    const int before = right.isep_before[i];
    diffs[i] = std::abs(static_cast<Real>(other.ss[i]) - smin) / smin;
    const bool within = diffs[i] < 1.0 / 256.0;
    toggled[i] = !within ? before : before == separated ? in_contact : separated;
    if (within) expected.push_back(i);
    if (other.isep[i] != before) found.push_back(i);
    wrong += other.isep[i] != (smin == Real(1) ? before : toggled[i]) ? 1 : 0;
    without_event += other.isep[i] != (smin == Real(1) ? toggled[i] : before) ? 1 : 0;
  }
  differ_ += wrong;
  if (!expected.empty() || wrong > 0) ++at(l::if_no_events).reached;
  const bool has_text = right.text.has_value();
  const auto told = has_text ? told_by(other.text, pairs) : std::vector<std::optional<change>>(pairs);
  const bool tells_some = std::ranges::any_of(told, [](const auto& what) { return what.has_value(); });
  if (wrong > 0 && without_event == 0 && (!found.empty() || !tells_some))
    at(l::if_no_events).explain(4.0, wrong);
  if (wrong > 0 && found.empty())
    for (suspect* s : left_by_) s->explained += wrong;
  if (smin == Real(1)) return;
  if (expected.size() > 1) {
    const bool first_alone =
        found.size() == 1 && found[0] == expected[0] && wrong + 1 == std::ssize(expected);
    at(l::write_60, loop_left).count(first_alone, 0.0, always_bits, std::int64_t{wrong});
  }
  for (std::size_t i = 0; i < pairs; ++i) {
    note_toggle(right.isep_before[i], other.isep[i], diffs[i], told[i], has_text && i + 1 < 1000);
    note_other_diffs(other.ss[i], other.smin, told[i] || other.isep[i] != right.isep_before[i]);
    if (toggled[i] == right.isep_before[i]) continue;
    const bool is_left_out = other.isep[i] == right.isep_before[i];
    if (i == 0) at(l::do_30).count(is_left_out, 0.0, always_bits);
    if (i + 1 == pairs) at(l::do_30, last_pair).count(is_left_out, 0.0, always_bits);
  }
}

/// Judges other formulas for DIFF.LT.EPSMUL, which round or underflow. `went_in`: the outcome for one pair.
void fault_finder::note_other_diffs(double s, double smin, bool went_in) {
  constexpr double epsmul = 1.0 / 256.0;
  const double distance = std::abs(s - smin);
  const bool outcomes[] = {distance < epsmul * smin, distance * (1.0 / smin) < epsmul,
                           std::abs(s / smin - 1.0) < epsmul, s < smin * (1.0 + epsmul)};
  for (std::size_t way = 0; way < std::size(outcomes); ++way)
    if (outcomes[way] != (distance / smin < epsmul))
      at(l::diff, other_way, way).count(went_in == outcomes[way], 0.0, always_bits);
}

/// Judges the ISEP of one pair. `told` is the event that the kernel's text reports.
void fault_finder::note_toggle(int before, int got, double diff, const std::optional<change>& told,
                               bool has_text) {
  const bool is_within = diff < 1.0 / 256.0;
  const bool was_separated = before == separated;
  const int by_branch = was_separated ? in_contact : separated;
  const bool wrong = got != (is_within ? by_branch : before);
  const bool went_in = has_text ? told.has_value() : got != before;
  (went_in ? diffs_in_ : diffs_out_).add(diff);
  const bool by_if = wrong && went_in != is_within && got == (went_in ? by_branch : before);
  at(l::diff).count(by_if, 0.0);
  if (by_if) at(l::if_within).explain(0.0);
  if (by_if) at(l::if_within).compared.add(diff);
  if (!is_within || (has_text && !told)) return;
  // From the same old status, a statement that sets ISEP always sets the same new status.
  const bool is_usual = set_to_.emplace(before, got).first->second == got;
  at(was_separated ? l::make : l::break_).count(wrong && is_usual, 1.0, is_usual ? 0.0 : always_bits);
  const bool went_true = (got == (was_separated ? separated : in_contact)) != was_separated;
  const auto [seen, first] = separated_.emplace(before, went_true);
  const bool told_so = !told || (*told == change::make) == !was_separated;
  if (wrong && told_so && went_true != was_separated && went_true == seen->second)
    at(l::if_separated).explain(first ? 2.0 : 0.0);
}

/// Judges the mode of arithmetic: subnormal results (FTZ) or operands (DAZ) may be flushed to zero.
void fault_finder::note_flushing([[maybe_unused]] const answered_call& right,
                                 [[maybe_unused]] const call_outputs& other,
                                 [[maybe_unused]] std::int64_t differ) {
#ifdef __SSE2__
  std::vector<event> events(other.ss.size());
  tally unused;
  for (const unsigned mode : {1U, 2U, 3U}) {  // FTZ, DAZ, both
    call_outputs flushed;
    call<double> asked = flushed.prepare(right);
    const unsigned usual_mode = _mm_getcsr();
    _mm_setcsr(usual_mode | (mode & 1U) << 15U | (mode & 2U) << 5U);
    contct(asked, events);
    _mm_setcsr(usual_mode);
    const auto differs = [&](const answer& a) { return compare_answers(asked, a, unused).has_value(); };
    if (differs(right.c)) at(l::flushing, usual, mode).count(!differs(other), 0.0, 0.0, differ);
  }
#endif
}

void fault_finder::note_text(const answered_call& right, const call_outputs& other) {
  ++differ_;
  const int last_node = right.c.id.empty() ? 0 : right.c.id.back();
  const listing_line& line = fault_of_text(*right.text, other.text, last_node);
  at(line).explain(1.0);
  if (other.text.empty())
    for (suspect* s : left_by_) ++s->explained;
  if (&line == &l::write_20) at(l::if_no_events).explain(2.0);
}

std::optional<faulty_line> fault_finder::found() const {
  const bool by_threshold = diffs_in_.is_apart_from(diffs_out_);
  // EPSMUL is 1/256. If the kernel's threshold seems to be next to 1/256, DIFF is rounded in another way.
  const bool is_rounded = diffs_in_.most != 1.0 / 256.0 && std::abs(diffs_in_.most * 256.0 - 1.0) < 1e-6;
  double least = std::numeric_limits<double>::infinity();
  const suspect* best = nullptr;
  for (const suspect& s : suspects_) {
    // A kernel that flushes does so in nearly every call in which this matters, unlike a kernel with a wrong
    // line. What else is wrong in it shows when it no longer flushes.
    const bool is_line = s.line != &l::flushing;
    const bool flushes = !is_line && 10 * s.wrong >= 9 * s.reached && 10 * s.explained >= differ_;
    if (s.explained == 0 || (!is_line && !flushes)) continue;
    double bits = s.bits + unexplained_bits * static_cast<double>(differ_ - s.explained);
    // DIFF tells which executions of IF (DIFF.LT.EPSMUL) are wrong, and ISEP which of IF (ISEP(I).EQ.1), so
    // that no list of wrong executions is needed.
    if (s.line == &l::if_within)
      bits += !by_threshold || is_rounded ? 1e6 : 1.0;
    else if (s.line != &l::if_separated)
      bits += choice_bits(s.reached, s.wrong);
    // If an IF did not go wrong by a threshold, an SS of 1 is more likely a fault of line 38.
    if ((s.line == &l::if_no_response || s.line == &l::if_stationary) &&
        !s.compared.is_apart_from(s.spared) && !s.compared_sizes.is_apart_from(s.spared_sizes))
      bits += 3.0 * static_cast<double>(s.wrong);
    if (flushes) bits = -static_cast<double>(s.explained);
    if (bits >= least) continue;
    least = bits;
    best = &s;
  }
  if (best == nullptr) return std::nullopt;
  faulty_line line{*best->line, best->explained, differ_, std::min(differing_calls_, most_calls), ""};
  if (best->line == &l::diff && best != &suspects_[faults_of_line * l::diff.number])
    line.compared = "lines 51 and 52 are computed in another way, which rounds or underflows";
  const std::string_view statement = line.at.statement;
  const std::size_t open = statement.find("IF (") + 4;
  const bool is_size = statement.find("ABS(") != std::string_view::npos;
  const auto& [first, last] = is_size ? best->compared_sizes : best->compared;
  if (open < 4 || !std::isfinite(first) || !std::isfinite(last)) return line;
  char text[100];
  (void)std::snprintf(text, sizeof text, " was %.9g to %.9g", first, last);
  line.compared = "in these " + std::string(statement.substr(open, statement.find('.', open) - open)) + text;
  return line;
}

std::string cited(const listing_line& line) {
  if (line.number == 0) return std::string(line.statement);
  return "line " + std::to_string(line.number) + ", " + std::string(line.statement);
}

std::string words_of(const faulty_line& f) {
  std::string words = cited(f.at) + ": explains " +
                      (f.explained != f.differ ? std::to_string(f.explained) + " of "
                       : f.differ > 1          ? "all "
                                               : "the ") +
                      counted(f.differ, "value") +
                      (f.differ == 1 ? " that differs, in " : " that differ, in ") + counted(f.calls, "call");
  if (!f.compared.empty()) words += "; " + f.compared;
  return words;
}

}  // namespace contct
