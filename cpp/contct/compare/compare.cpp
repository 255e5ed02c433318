#include "contct/compare/compare.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "contct/kernel/call.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

/// Removes the first word from `line`. Returns the word without a zero before the point: -.25 for -0.25.
std::string take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  std::string word(line.substr(0, line.find(' ')));
  line.remove_prefix(word.size());
  const std::size_t digit = word.find_first_not_of('-');
  if (digit != std::string::npos && word.compare(digit, 2, "0.") == 0) word.erase(digit, 1);
  return word;
}

bool mean_the_same(std::string_view a, std::string_view b) {
  while (!a.empty() || !b.empty()) {
    if (take_word(a) != take_word(b)) return false;
  }
  return true;
}

std::string described(const kernel_facts& k) {
  return "\"" + k.name + "\" (" + std::to_string(k.real_bytes) + "-byte REAL, " +
         std::string(rule_words(k.rule)) + ")";
}

/// Where the answers differ: "SS(3)", "text, line 2" or "SMIN".
std::string place_words(const mismatch& d) {
  if (d.index == 0) return d.field;
  const std::string index = std::to_string(d.index);
  return d.field == "text" ? "text, line " + index : d.field + "(" + index + ")";
}

/// The first differences of the answer `other` from the leader's in SS, SMIN and ISEP.
struct differences {
  differences(const answered_call& c, const call_outputs& other)
      : of_smin(!same_bits(c.c.smin, other.smin)), no_event(c.c.smin == 1.0) {
    for (std::size_t i = other.ss.size(); i-- > 0;) {
      if (!same_bits(c.c.ss[i], other.ss[i])) ss = i;
      if (c.c.isep[i] != other.isep[i]) isep = i;
      toggled = toggled || other.isep[i] != c.isep_before[i];
    }
    both_toggled =
        isep && c.c.isep[*isep] != c.isep_before[*isep] && other.isep[*isep] != c.isep_before[*isep];
  }

  /// True if the IF `b` of `pair` (from 0) can have caused the first difference in the order SS, SMIN, ISEP.
  [[nodiscard]] bool depends_on(branch b, std::size_t pair) const {
    if (b <= branch::check_positive) return ss == pair;
    if (b <= branch::s_is_smallest) return !ss && of_smin;
    if (ss || of_smin) return false;
    if (b == branch::no_events) return no_event || !toggled;
    return !isep || (isep == pair && both_toggled == (b == branch::was_separated));
  }

  std::optional<std::size_t> ss, isep;  // the first pair that differs in SS, and in ISEP, from 0
  bool of_smin, no_event;
  bool toggled = false;       // the answer `other` toggles at least one pair
  bool both_toggled = false;  // both answers toggle the pair `isep`, to different statuses
};

std::string margin_words(const mismatch_report& f) {
  const std::optional<decision>& least = f.narrowest;
  if (!least) return "branch margin: the difference depends on no IF";
  const bool with_nan = least->ulps == std::numeric_limits<std::uint64_t>::max();
  const bool tie = least->ulps <= tie_ulps;
  return "branch margin: " + words_of(*least) +
         (tie        ? ": a tie, which rounding may decide the other way"
          : with_nan ? ""
                     : "; this smallest margin is too large for a tie, so the difference is a bug");
}

}  // namespace

std::optional<decision> narrowest_decision(const answered_call& c, int real_bytes,
                                           const call_outputs& other) {
  const differences d(c, other);
  return narrowest_decision(c, real_bytes,
                            [&d](branch b, std::size_t pair) { return d.depends_on(b, pair); });
}

std::optional<mismatch> compare_text(std::string_view leader, std::string_view follower, tally& t,
                                     text_equality equality) {
  ++t.values;
  for (int line = 1; leader != follower; ++line) {
    // A missing line, or a line without a newline, is a difference.
    const bool both_end =
        leader.find('\n') != std::string_view::npos && follower.find('\n') != std::string_view::npos;
    const std::string_view a = take_line(leader);
    const std::string_view b = take_line(follower);
    if (both_end && (equality == text_equality::bytes ? a == b : mean_the_same(a, b))) continue;
    ++t.mismatches;
    return mismatch{"text", line, std::string(a), std::string(b), 0};
  }
  return std::nullopt;
}

std::vector<std::string> words_of(const mismatch_report& f) {
  std::string line = std::string("call ") + std::to_string(f.call) + ": " + f.follower;
  if (f.where.field == "answer") return {line + " gave no answer: " + f.where.follower};
  const bool is_number = f.where.field == "SS" || f.where.field == "SMIN";
  const auto value = [is_number](const std::string& v) {  // "0x1p-1 = 0.5"
    return is_number ? v + " = " + short_decimal(std::strtod(v.c_str(), nullptr)) : v;
  };
  line += " differs in " + place_words(f.where) + ": " + f.leader + " has " + value(f.where.leader) + ", " +
          f.follower + " has " + value(f.where.follower);
  const bool is_nan = f.where.ulps == std::numeric_limits<std::uint64_t>::max();
  if (is_number) line += is_nan ? " (one is NaN)" : " (" + std::to_string(f.where.ulps) + " ULP)";
  if (f.lines.empty()) return {line, margin_words(f)};
  return {line, margin_words(f), f.lines};
}

void refuse_unequal(const kernel_facts& leader, const kernel_facts& follower) {
  if (follower.real_bytes == leader.real_bytes && follower.rule == leader.rule) return;
  const bool precision = follower.real_bytes != leader.real_bytes;
  throw std::invalid_argument(described(leader) + " and " + described(follower) + " differ in " +
                              (precision ? "precision" : "rule") +
                              " and cannot be equal to the bit; compare them with --free-run");
}

follower::follower(kernel_facts leader, kernel& k) : leader_(std::move(leader)), kernel_(&k) {}

std::optional<mismatch> follower::compare(const answered_call& c) {
  answer_.ss.assign(c.c.ss.size(), not_an_answer);
  answer_.isep.assign(c.isep_before.begin(), c.isep_before.end());
  call<double> asked = c.c;
  asked.ss = answer_.ss;
  asked.isep = answer_.isep;
  asked.smin = not_an_answer;
  try {
    kernel_->answer(asked);
  } catch (const kernel_failure& failure) {
    ++compared.values;
    ++compared.mismatches;
    return mismatch{"answer", 0, "an answer", failure.what(), 0};
  }
  answer_.smin = asked.smin;
  std::optional<mismatch> found =
      compare_answers<double>({c.c.smin, c.c.ss, c.c.isep}, {asked.smin, asked.ss, asked.isep}, compared);
  if (!c.text || !kernel_->facts().has_text) return found;
  answer_.text = kernel_->take_text();
  std::optional<mismatch> in_text = compare_text(*c.text, answer_.text, compared, equality());
  return found ? found : in_text;
}

const std::optional<mismatch>& follower::ask(const answered_call& c) {
  refuse_beyond_limits(c.c, c.isep_before);
  const tally before = compared;
  difference_ = compare(c);
  measure(c.c, before);
  if (difference_) note(*difference_, c);
  if (!answered()) return difference_;
  answered_call with_text = c;
  if (!kernel_->facts().has_text) with_text.text.reset();
  faults.note(with_text, leader_.real_bytes, answer_, !difference_);
  return difference_;
}

void follower::note(const mismatch& found, const answered_call& c) {
  if (first_ && first_->call <= c.number) return;
  first_ = report_of(found, c);
}

mismatch_report follower::report_of(const mismatch& found, const answered_call& c) const {
  const std::string& name = kernel_->facts().name;
  const bool has_answer = found.field != "answer";
  return {c.number,
          leader_.name,
          name,
          found,
          narrowest_decision(c, leader_.real_bytes, answer_),
          has_answer ? lines_taken(c, leader_.real_bytes, answer_, leader_.name, name) : ""};
}

void follower::measure(const call<double>& leader, const tally& before) {
  last_ = {compared.values - before.values, compared.mismatches - before.mismatches};
  last_.failed = difference_ && difference_->field == "answer";
  near.always_answered = near.always_answered && !last_.failed;
  near.same_events = near.same_events && !last_.failed;
  if (last_.failed || last_.mismatches == 0) return;
  last_.smin_ulps = ulps_between(leader.smin, answer_.smin);
  for (std::size_t i = 0; i < leader.ss.size(); ++i)
    last_.ss_ulps = std::max(last_.ss_ulps, ulps_between(leader.ss[i], answer_.ss[i]));
  near.most_ulps = std::max({near.most_ulps, last_.smin_ulps, last_.ss_ulps});
  near.same_events = near.same_events && std::ranges::equal(leader.isep, answer_.isep);
}

std::string_view name_of(equality_level l) {
  constexpr std::string_view names[] = {"bits", "ulps", "events", "certificate", "none"};
  return names[static_cast<int>(l)];
}

equality_level level_of(const nearness& n, const tally& compared) {
  constexpr std::uint64_t few_ulps = 64;
  if (compared.mismatches == 0) return equality_level::bits;
  if (!n.same_events) return equality_level::none;
  return n.most_ulps <= few_ulps ? equality_level::ulps : equality_level::events;
}

bool comparable(const trace_header& h, const kernel_facts& k) {
  return h.real_bytes == k.real_bytes && h.rule == k.rule;
}

replay_report replay(const trace_header& h, trace_reader& calls, kernel& k,
                     const std::function<void(std::int64_t)>& progress, fault_finder before) {
  replay_report report;
  recorded_call c;
  // f2c omits zeros before decimal points, so its text is compared by meaning. If f2c is not installed, its
  // facts are unknown; therefore the kernel's name in the trace decides.
  follower asked({"the trace", h.real_bytes, h.rule, "", "", "", true, h.kernel == "f2c"}, k);
  asked.faults = std::move(before);
  while (calls.next(c)) {
    ++report.calls;
    const answered_call recorded = c.answered();
    report.branches.count(recorded.c, recorded.isep_before);
    if (progress) progress(report.calls);
    (void)asked.ask(recorded);
  }
  report.compared = asked.compared;
  report.near = asked.near;
  report.first = asked.first();
  report.faults = std::move(asked.faults);
  return report;
}

}  // namespace contct
