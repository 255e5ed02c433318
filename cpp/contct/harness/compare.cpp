#include "contct/harness/compare.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "contct/kernel/call.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

/// The words of a line, without a zero before the point of a number: -.25 for -0.25.
std::string meaning_of(std::string_view line) {
  std::string all;
  std::istringstream words{std::string(line)};
  for (std::string word; words >> word; all += word + ' ') {
    const std::size_t digit = word.find_first_not_of('-');
    if (digit != std::string::npos && word.compare(digit, 2, "0.") == 0) word.erase(digit, 1);
  }
  return all;
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

/// The line of the listing that gives the value `s`, or "no line".
template <class Real>
std::string way_words(const pair_numbers<Real>& p, Real s) {
  const bool of_event = same_bits(s, p.event) && s != Real(1);
  if (same_bits(s, p.moving) && (!of_event || !p.is_stationary)) return cited(listing::moving);
  if (of_event) return cited(listing::if_check_positive);
  if (s == Real(1)) return cited(p.d_star != Real(0) ? listing::stationary : listing::no_response);
  return "no line";
}

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
  std::optional<decision> least;
  in_precision(c.c, real_bytes, [&](const auto& own) {
    for_each_decision(own, c.isep_before, [&](branch b, std::size_t i, bool outcome, auto left, auto right) {
      if (d.depends_on(b, i)) keep_narrower(least, {b, i, outcome, left, right});
    });
  });
  return least;
}

std::string lines_taken(const answered_call& c, int real_bytes, const call_outputs& other,
                        const std::string& leader, const std::string& follower) {
  const differences d(c, other);
  if (!d.ss && !d.isep) return "";
  const std::size_t i = d.ss ? *d.ss : *d.isep;
  const auto set_by = [before = c.isep_before[i]](int status) {
    return status == before ? "kept ISEP"
                            : "took " + cited(status == in_contact ? listing::make : listing::break_);
  };
  return in_precision(c.c, real_bytes, [&]<class Real>(const call<Real>& own) {
    const pair_numbers<Real> p(own, c.isep_before, i);
    std::string words = "pair " + std::to_string(i + 1) + ": GAP = " + short_decimal(p.gap) +
                        ", DTEST = " + short_decimal(p.d_star);
    if (p.d_star != Real(0) && p.is_stationary) words += ", SSCHK = " + short_decimal(p.sschk);
    if (d.ss)
      return words + "; " + leader + " took " + way_words(p, own.ss[i]) + "; " + follower +
             " has the SS of " + way_words(p, static_cast<Real>(other.ss[i]));
    return words + "; " + leader + " " + set_by(c.c.isep[i]) + "; " + follower + " " + set_by(other.isep[i]);
  });
}

std::optional<mismatch> compare_answers(const answer& leader, const answer& follower, tally& t) {
  t.values += 1 + static_cast<std::int64_t>(leader.ss.size() + leader.isep.size());
  std::optional<mismatch> first;
  const auto differ = [&](mismatch found) {
    ++t.mismatches;
    if (!first) first = std::move(found);
  };
  const auto real = [&](const char* field, std::size_t index, double a, double b) {
    if (!same_bits(a, b))
      differ({field, static_cast<int>(index), hexfloat(a), hexfloat(b), ulps_between(a, b)});
  };
  real("SMIN", 0, leader.smin, follower.smin);
  for (std::size_t i = 0; i < leader.ss.size(); ++i) real("SS", i + 1, leader.ss[i], follower.ss[i]);
  for (std::size_t i = 0; i < leader.isep.size(); ++i) {
    if (leader.isep[i] == follower.isep[i]) continue;
    differ({"ISEP", static_cast<int>(i) + 1, std::to_string(leader.isep[i]), std::to_string(follower.isep[i]),
            0});
  }
  return first;
}

std::optional<mismatch> compare_text(std::string_view leader, std::string_view follower, tally& t,
                                     bool by_meaning) {
  ++t.values;
  for (int line = 1; leader != follower; ++line) {
    // A missing line, or a line without a newline, is a difference.
    const bool both_end =
        leader.find('\n') != std::string_view::npos && follower.find('\n') != std::string_view::npos;
    const std::string_view a = take_line(leader);
    const std::string_view b = take_line(follower);
    if (both_end && (by_meaning ? meaning_of(a) == meaning_of(b) : a == b)) continue;
    ++t.mismatches;
    return mismatch{"text", line, std::string(a), std::string(b), 0};
  }
  return std::nullopt;
}

std::string words_of(const decision& d) {
  std::string words = d.pair >= 0 ? "pair " + std::to_string(d.pair + 1) + ": " : "";
  words +=
      "IF (" + std::string(branch_conditions[index_of(d.what)]) + ") was " + (d.outcome ? "true" : "false");
  if (d.ulps == whole_numbers) return words;
  if (d.ulps == std::numeric_limits<std::uint64_t>::max()) return words + ", with NaN";
  if (d.ulps == 0) return words + ", exactly on the threshold";
  return words + " by " + std::to_string(d.ulps) + " ULP";
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
  if (comparable(leader, follower)) return;
  const bool precision = follower.real_bytes != leader.real_bytes;
  throw std::invalid_argument(described(leader) + " and " + described(follower) + " differ in " +
                              (precision ? "precision" : "rule") +
                              " and cannot be equal to the bit; compare them with --free-run");
}

follower::follower(kernel_facts leader, kernel& k) : leader_(std::move(leader)), kernel_(&k) {}

std::optional<mismatch> follower::compare(const answered_call& c) {
  call<double> asked = answer_.prepare(c);
  try {
    kernel_->answer(asked);
  } catch (const kernel_failure& failure) {
    ++compared.values;
    ++compared.mismatches;
    return mismatch{"answer", 0, "an answer", failure.what(), 0};
  }
  answer_.smin = asked.smin;
  std::optional<mismatch> found = compare_answers(c.c, asked, compared);
  if (!c.text || !kernel_->facts().has_text) return found;
  answer_.text = kernel_->take_text();
  std::optional<mismatch> in_text =
      compare_text(*c.text, answer_.text, compared, texts_by_meaning(leader_, kernel_->facts()));
  return found ? found : in_text;
}

const std::optional<mismatch>& follower::ask(const answered_call& c) {
  refuse_beyond_limits(c.c, c.isep_before);
  const tally before = compared;
  difference_ = compare(c);
  measure(c.c, before);
  if (difference_ && !first_) first_ = report_of(*difference_, c);
  if (!answered()) return difference_;
  answered_call with_text = c;
  if (!kernel_->facts().has_text) with_text.text.reset();
  faults.note(with_text, leader_.real_bytes, answer_, !difference_);
  return difference_;
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

follower follower_of(const trace_header& h, kernel& k) {
  // f2c omits zeros before decimal points, so its text is compared by meaning. If f2c is not installed, its
  // facts are unknown; therefore the kernel's name in the trace decides.
  return {{"the trace", h.real_bytes, h.rule, "", "", "", true, h.name == "f2c"}, k};
}

std::int64_t replay(trace_reader& calls, follower& f,
                    const std::function<void(const recorded_call& c, const answered_call& right)>& asked) {
  std::int64_t number = 0;
  for (recorded_call c; calls.next(c); ++number) {
    const answered_call right = c.answered();
    (void)f.ask(right);
    if (asked) asked(c, right);
  }
  return number;
}

}  // namespace contct
