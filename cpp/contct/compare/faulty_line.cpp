#include "contct/compare/faulty_line.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "contct/number/bits.hpp"

namespace contct {
namespace {

namespace l = listing;

/// Special faults of a line, each a suspect of its own.
enum another { none, last_pair, wrong_sign, wrong_product, any_number, loop_left };

/// The index of a suspect. If two have the same cost, the smaller index wins.
constexpr std::size_t at(const listing_line& line, another fault = none) {
  return 10 * static_cast<std::size_t>(line.number) + fault;
}

listing_line line_of(std::size_t suspect) {
  const int number = static_cast<int>(suspect) / 10;
  return *std::find_if(l::all.begin(), l::all.end(),
                       [number](const auto& line) { return line.number == number; });
}

constexpr std::int64_t most_calls = 1000;
constexpr std::int64_t most_pairs = 500'000;  // a limit for the used calls together, to bound the time
constexpr double number_bits = 64.0;          // cost of a number that follows no rule
constexpr double always_bits = 30.0;          // cost of each exception from a fault that must always occur
constexpr double unexplained_bits = 200.0;    // cost of each differing value that the line does not explain

/// log2 of the number of ways to choose `k` of `n`.
double choice_bits(std::int64_t n, std::int64_t k) {
  const auto log_factorial =
      [](std::int64_t x) {  // Stirling's formula, to 0.001: lgamma would add 30 kB to the static program
        constexpr double two_pi = 6.283185307179586;
        const auto v = static_cast<double>(x);
        return x < 2 ? 0.0 : v * std::log(v) - v + std::log(two_pi * v) / 2 + 1 / (12 * v);
      };
  return n <= k ? 0.0 : (log_factorial(n) - log_factorial(k) - log_factorial(n - k)) / std::log(2.0);
}

void explain_one(suspect& s, double bits, std::int64_t values = 1) {
  ++s.wrong;
  s.explained += values;
  s.bits += bits;
}

/// Like explain_one, for an IF that compared `left`.
void explain_if(suspect& s, double left) {
  s.least = s.wrong == 0 ? left : std::min(s.least, left);
  s.most = s.wrong == 0 ? left : std::max(s.most, left);
  explain_one(s, 0.0);
}

/// The rule of wrong numbers: they repeat their value or their ratio to the right number, or only the ratio.
enum class rule { any, ratio };

/// The number of bits that describe a wrong number; few if the number follows a rule.
template <class Real>
double value_bits(suspect& s, Real got, Real right, double for_rounding, rule repeats = rule::any) {
  constexpr std::uint64_t few_ulps = 8;
  const double ratio = static_cast<double>(got) / static_cast<double>(right);
  const bool same_value = repeats != rule::ratio && static_cast<double>(got) == s.last_value;
  const bool same_ratio = std::abs(ratio / s.last_ratio - 1.0) < 1e-6;
  if (!std::isfinite(got) || (got == Real(1) && repeats != rule::ratio) ||
      got == static_cast<Real>(not_an_answer) || got == -right)
    return 2.0;
  if (ulps_between(got, right) <= few_ulps) return for_rounding;
  if (same_value || same_ratio) return 1.0;
  s.last_value = static_cast<double>(got);
  s.last_ratio = ratio;
  return number_bits;
}

/// The numbers from which the listing computes SS of one pair.
template <class Real>
struct pair_values {
  Real gap{}, d_star{}, sschk{}, event{}, delta_first{}, s{};
  Real at_face{}, moving{};  // s by IF (ABS(GAP).LT.EPSGAP) true, and false
  bool responds = false, is_stationary = false, check = false;

  /// s if IF (DTEST(NDOF).EQ.0.) were missing.
  [[nodiscard]] Real without_first() const { return is_stationary ? at_face : moving; }
};

/// The values of pair `i` on `dof`, from 0; NaN if the call has no such dof.
template <class Real>
pair_values<Real> values_of(const call<Real>& c, int status, std::size_t i, std::int64_t dof) {
  pair_values<Real> p;
  const Real delta = sizeof(Real) == 4 ? static_cast<Real>(1.E-20F) : static_cast<Real>(1.E-20);
  const Real epsgap = sizeof(Real) == 4 ? static_cast<Real>(1.E-10F) : static_cast<Real>(1.E-10);
  const bool is_there = dof >= 0 && dof < std::ssize(c.dd);
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  p.d_star = is_there ? c.dtest[dof] : nan;
  p.gap = c.cc[i] - (is_there ? c.dd[dof] : nan);
  p.sschk = static_cast<Real>(status * c.isurf[i]) / p.d_star;
  p.event = p.sschk * delta;
  p.delta_first =
      static_cast<Real>(status * c.isurf[i]) * delta / p.d_star;  // multiplied before the division
  p.check = p.sschk > Real(0);
  p.at_face = p.check ? p.event : Real(1);
  p.moving = p.gap / p.d_star;
  p.responds = !(p.d_star == Real(0));
  p.is_stationary = std::abs(p.gap) < epsgap;
  p.s = !p.responds ? Real(1) : p.without_first();
  return p;
}

/// The change of each pair that a kernel's text reports. I3 cannot print pairs beyond 999.
std::vector<std::optional<change>> told_by(const std::string& text, std::size_t pairs) {
  std::vector<std::optional<change>> told(pairs);
  change what = change::make;
  for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
    end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    if (line.find("MAKING") != std::string::npos) what = change::make;
    if (line.find("BREAKING") != std::string::npos) what = change::break_;
    const std::size_t pair = line.find("PAIR:");
    const int number =
        pair == std::string::npos ? 0 : static_cast<int>(std::strtol(line.c_str() + pair + 5, nullptr, 10));
    if (number > 0 && static_cast<std::size_t>(number) <= pairs) told[number - 1] = what;
  }
  return told;
}

struct text_line {
  explicit text_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    words = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  /// The label of the FORMAT that the line resembles: 20, 40, 50 or 60.
  [[nodiscard]] int format() const {
    const auto has = [this](const char* word) { return words.find(word) != std::string::npos; };
    return has("NO EVENTS") ? 20 : has("MAKING") ? 40 : has("BREAKING") ? 50 : 60;
  }
  /// Appends the line's numbers to `numbers`, and the line to `form`, with 0 for every character of a number
  /// except the point.
  void split(std::vector<double>& numbers, std::string& form) const {
    for (const char* at = words.c_str(); *at != '\0';) {
      char* end = nullptr;
      const double number = *at == 'N' || *at == 'I' ? 0.0 : std::strtod(at, &end);
      const bool is_number = end != nullptr && end != at;
      if (is_number) numbers.push_back(number);
      const std::size_t length = is_number ? end - at : 1;
      for (std::size_t k = 0; k < length; ++k) form += is_number && at[k] != '.' ? '0' : at[k];
      at += length;
    }
  }
  std::string words;
};

/// The suspect that explains a line of text: a FORMAT if only the form of numbers differs.
std::size_t writer_of(const text_line& right, const text_line& got, int last_node) {
  const int format = right.format();
  if (format == 40 || format == 50)
    return got.format() == format ? (format == 40 ? at(l::format_40) : at(l::format_50))
                                  : (format == 40 ? at(l::write_40) : at(l::write_50));
  std::vector<double> expected;
  std::vector<double> found;
  std::string form;
  std::string other_form;
  right.split(expected, form);
  got.split(found, other_form);
  constexpr double rounding = 6e-4;  // relative rounding of four digits
  const auto same = [](double a, double b) {
    return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
  };
  if (!expected.empty() && !found.empty()) {
    const double power = std::log10(found.back() / expected.back());
    if (std::abs(power - std::round(power)) < rounding)
      found.back() = expected.back();  // only the exponent differs
  }
  const bool only_form = expected.size() != found.size() || form != other_form ||
                         std::equal(expected.begin(), expected.end(), found.begin(), same);
  if (format == 20) return only_form ? at(l::format_20) : at(l::write_20);
  if (only_form || expected.size() < 2) return at(l::format_60);
  const bool node_alone = expected[0] == found[0] && expected[1] != found[1] && found[1] == last_node;
  return node_alone ? at(l::node_again) : at(l::write_60);
}

}  // namespace

fault_finder::fault_finder() : suspects_(at(l::format_60) + 10) {}

void fault_finder::note(const answered_call& c, int real_bytes, const call_outputs& other, bool equal) {
  if (real_bytes == 8) note_digest(other);
  std::int64_t& calls = equal ? equal_calls_ : differing_calls_;
  if (++calls > most_calls || pairs_ > most_pairs) return;
  pairs_ += c.c.nc();
  if (real_bytes == 8) return note_call(c.c, c, other);
  as_float_call(c.c, [&](const call<float>& f) { note_call(f, c, other); });
}

void fault_finder::note_digest(const call_outputs& other) {
  const auto word = [this](std::uint32_t w) {
    digest_ = (digest_ ^ w) * 16777619U;
    digest_ ^= digest_ >> 15U;
  };
  const auto number = [&word](double x) {
    const auto bits =
        std::bit_cast<std::uint64_t>(std::isnan(x) ? std::bit_cast<double>(0x7ff8000000000000U) : x);
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
  note_scale_factors(c, right, other);
  note_smallest<Real>(other);
  note_toggles<Real>(right, other);
  if (differ_ == before && right.text) note_text(right, other);
  last_smin_ = other.smin;
}

template <class Real>
void fault_finder::note_scale_factors(const call<Real>& c, const answered_call& right,
                                      const call_outputs& other) {
  for (std::size_t i = 0; i < c.cc.size(); ++i) note_pair(c, right, i, static_cast<Real>(other.ss[i]));
  if (!c.cc.empty()) note_loop(c, right, other.ss);
}

template <class Real>
void fault_finder::note_pair(const call<Real>& c, const answered_call& right, std::size_t i, Real got) {
  const int status = right.isep_before[i];
  const auto at_dof = [&](std::int64_t dof) { return values_of(c, status, i, dof); };
  const pair_values<Real> p = at_dof(c.dof.dof_of(c.id[i]) - 1);
  const bool wrong = !same_bits(got, c.ss[i]);
  differ_ += wrong ? 1 : 0;
  // A line that gives `other` if it is wrong.
  const auto could_give = [&](std::size_t name, Real other, Real left) {
    if (same_bits(other, c.ss[i])) return;
    ++suspects_[name].reached;
    if (wrong && same_bits(got, other)) explain_if(suspects_[name], static_cast<double>(left));
  };
  // A line that can give any number if it is wrong.
  const auto assigns = [&](std::size_t name, double for_rounding, rule repeats = rule::any) {
    ++suspects_[name].reached;
    if (wrong) explain_one(suspects_[name], value_bits(suspects_[name], got, c.ss[i], for_rounding, repeats));
  };
  could_give(at(l::common), at_dof((c.id[i] - 1LL) * c.dof.indof + c.dof.ndofpn - 1).s, got);
  call<Real> swapped = c;
  std::swap(swapped.dd, swapped.dtest);
  could_give(at(l::arguments), values_of(swapped, status, i, c.dof.dof_of(c.id[i]) - 1).s, got);
  could_give(at(l::node), at_dof(static_cast<std::int64_t>(i) * c.dof.ndofpn + c.dof.indof - 1).s, got);
  could_give(at(l::if_no_response), p.responds ? Real(1) : p.without_first(), p.d_star);
  ++suspects_[at(l::ndof)].reached;
  const auto of_some_dof = [&](auto s_of) {  // values outside the arrays are unknown
    constexpr std::int64_t most = 2000;
    for (std::int64_t dof = 0; dof < std::min<std::int64_t>(std::ssize(c.dd), most); ++dof)
      if (same_bits(s_of(at_dof(dof)), got)) return true;
    return false;
  };
  const bool is_known = std::isnan(got);
  if (wrong)
    explain_one(suspects_[at(l::ndof)],
                is_known || !of_some_dof([](const auto& q) { return q.s; })
                    ? value_bits(suspects_[at(l::ndof)], got, c.ss[i], number_bits) + 2.0
                    : 8.0);
  if (!p.responds) return assigns(at(l::no_response), 3.0);
  could_give(at(l::if_stationary), p.is_stationary ? p.moving : p.at_face, std::abs(p.gap));
  const bool of_a_gap =
      !(std::abs(got * p.d_star) < Real(0.999e-10));  // slightly less than EPSGAP, for rounding
  if (!p.is_stationary) {
    could_give(at(l::gap, wrong_sign), -p.moving, p.gap);
    const auto other_gap = [d_star = p.d_star](const auto& q) { return q.gap / d_star; };
    if (wrong && (same_bits(got, p.at_face) || (!is_known && of_some_dof(other_gap)))) {
      ++suspects_[at(l::gap)].reached;
      explain_one(suspects_[at(l::gap)], same_bits(got, p.at_face) ? 1.0 : 8.0);
    } else if (!wrong || of_a_gap) {
      assigns(at(l::gap), 5.0);
    }
    return assigns(at(l::moving), 3.0);
  }
  could_give(at(l::if_check_positive), p.check ? Real(1) : p.event, p.sschk);
  could_give(at(l::check_variable, wrong_sign),
             p.check             ? Real(1)
             : p.sschk < Real(0) ? -p.event
                                 : p.s,
             p.sschk);
  if (!wrong || of_a_gap) assigns(at(l::gap), 5.0);
  if (!wrong || got >= Real(0)) assigns(at(l::check_variable), 5.0);
  suspects_[at(l::check_variable)].bits += wrong ? 1.0 : 0.0;  // a repeated ratio points to DELTA
  if (!p.check) return assigns(at(l::stationary), 3.0);
  if (!wrong || !same_bits(got, p.delta_first))
    return assigns(at(l::if_check_positive, wrong_product), 3.0, rule::ratio);
  ++suspects_[at(l::if_check_positive, wrong_product)].reached;
  explain_one(suspects_[at(l::if_check_positive, wrong_product)], 1.0);
}

/// Finds where the other kernel left the loop: the SS after it keep their initial values. Suspects are the
/// branches of the last pair that was set.
template <class Real>
void fault_finder::note_loop(const call<Real>& c, const answered_call& right, std::span<const double> ss) {
  const std::size_t pairs = ss.size();
  for (const auto& [name, i] :
       {std::pair(at(l::do_10), std::size_t{0}), {at(l::do_10, last_pair), pairs - 1}}) {
    ++suspects_[name].reached;
    if (ss[i] == not_an_answer && !same_bits(c.ss[i], static_cast<Real>(not_an_answer)))
      explain_one(suspects_[name], 0.0);
  }
  std::size_t done = pairs;
  while (done > 0 && ss[done - 1] == not_an_answer) --done;
  const auto left_behind = [&](std::size_t name, auto took) {
    std::size_t i = 0;
    while (i < pairs && !took(i)) ++i;
    if (i + 1 < pairs) ++suspects_[name].reached;
    if (i + 1 != done) return;
    if (done < pairs) explain_one(suspects_[name], 1.0, static_cast<std::int64_t>(pairs - done));
    left_by_.push_back(name);
  };
  const auto of = [&](std::size_t i) {
    return values_of(c, right.isep_before[i], i, c.dof.dof_of(c.id[i]) - 1);
  };
  left_behind(at(l::no_response, loop_left), [&](std::size_t i) { return !of(i).responds; });
  left_behind(at(l::moving, loop_left),
              [&](std::size_t i) { return of(i).responds && !of(i).is_stationary; });
  left_behind(at(l::smallest, loop_left),
              [&](std::size_t i) { return c.ss[i] > Real(0) && c.ss[i] < Real(1); });
}

template <class Real>
void fault_finder::note_smallest(const call_outputs& other) {
  double least = 1.0;
  bool is_one_of_them = other.smin == 1.0;
  for (const double s : other.ss) {
    if (s > 0.0 && s < least) least = s;
    is_one_of_them = is_one_of_them || same_bits(s, other.smin);
  }
  for (const std::size_t name : {at(l::smin_is_1), at(l::smallest), at(l::smallest, any_number)})
    ++suspects_[name].reached;
  if (same_bits(least, other.smin)) return;
  ++differ_;
  if (is_one_of_them) explain_one(suspects_[at(l::smallest)], 1.0);
  if (least == 1.0 && other.smin == not_an_answer)
    explain_one(suspects_[at(l::if_no_events)], 2.0);  // returned before SMIN was stored
  for (const std::size_t name : {at(l::smin_is_1), at(l::smallest, any_number)}) {
    if (name == at(l::smin_is_1) && other.smin > least && least < 1.0) continue;
    const double bits = other.smin == last_smin_ ? 1.0
                                                 : value_bits(suspects_[name], static_cast<Real>(other.smin),
                                                              static_cast<Real>(least), 3.0);
    explain_one(suspects_[name], bits);
  }
}

template <class Real>
void fault_finder::note_toggles(const answered_call& right, const call_outputs& other) {
  const std::size_t pairs = other.isep.size();
  const auto smin = static_cast<Real>(other.smin);
  std::vector<Real> diffs(pairs);
  std::vector<int> toggled(pairs);
  std::vector<std::size_t> expected;  // pairs that DO 30 must toggle
  std::vector<std::size_t> found;     // pairs that the other kernel toggled
  std::int64_t without_event = 0;
  std::int64_t wrong = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    const int before = right.isep_before[i];
    diffs[i] = std::abs(static_cast<Real>(other.ss[i]) - smin) / smin;
    const bool within = diffs[i] < Real(1) / Real(256);
    toggled[i] = !within ? before : before == separated ? in_contact : separated;
    if (within) expected.push_back(i);
    if (other.isep[i] != before) found.push_back(i);
    wrong += other.isep[i] != (smin == Real(1) ? before : toggled[i]) ? 1 : 0;
    without_event += other.isep[i] != (smin == Real(1) ? toggled[i] : before) ? 1 : 0;
  }
  differ_ += wrong;
  if (!expected.empty() || wrong > 0) ++suspects_[at(l::if_no_events)].reached;
  const bool has_text = right.text.has_value();
  const auto told = has_text ? told_by(other.text, pairs) : std::vector<std::optional<change>>(pairs);
  const bool told_none = std::ranges::none_of(told, [](const auto& what) { return what.has_value(); });
  if (wrong > 0 && without_event == 0 && (!found.empty() || told_none))
    explain_one(suspects_[at(l::if_no_events)], 4.0, wrong);
  if (wrong > 0 && found.empty())
    for (const std::size_t name : left_by_) suspects_[name].explained += wrong;
  if (smin == Real(1)) return;
  if (expected.size() > 1) {
    ++suspects_[at(l::write_60, loop_left)].reached;
    if (found.size() == 1 && found[0] == expected[0] && wrong + 1 == std::ssize(expected))
      explain_one(suspects_[at(l::write_60, loop_left)], 0.0, wrong);
  }
  for (std::size_t i = 0; i < pairs; ++i) {
    note_toggle(right.isep_before[i], other.isep[i], diffs[i], told[i], has_text && i + 1 < 1000);
    for (const auto& [name, at] :
         {std::pair(at(l::do_30), std::size_t{0}), {at(l::do_30, last_pair), pairs - 1}}) {
      if (i != at || toggled[i] == right.isep_before[i]) continue;
      ++suspects_[name].reached;
      if (other.isep[i] == right.isep_before[i]) explain_one(suspects_[name], 0.0);
    }
  }
}

template <class Real>
void fault_finder::note_toggle(int before, int got, Real diff_now, const std::optional<change>& told,
                               bool has_text) {
  const Real epsmul = Real(1) / Real(256);
  const bool is_within = diff_now < epsmul;
  const bool was_separated = before == separated;
  const int if_true = in_contact;  // the new ISEP by IF (ISEP(I).EQ.1)
  const int if_false = separated;
  const int by_branch = was_separated ? if_true : if_false;
  const bool wrong = got != (is_within ? by_branch : before);
  const bool went_in = has_text ? told.has_value() : got != before;
  const auto left = static_cast<double>(diff_now);
  double& least = went_in ? least_true_ : least_false_;
  double& most = went_in ? most_true_ : most_false_;
  least = std::min(least, left);
  most = std::max(most, left);
  ++suspects_[at(l::diff)].reached;
  if (wrong && went_in != is_within && got == (went_in ? by_branch : before)) {
    explain_if(suspects_[at(l::if_within)], left);
    explain_if(suspects_[at(l::diff)], left);
  }
  if (!is_within || (has_text && !told)) return;
  suspect& assigned = suspects_[was_separated ? at(l::make) : at(l::break_)];
  ++assigned.reached;
  const bool other_branch = got == (was_separated ? if_false : if_true);
  const auto [seen, first] = separated_.emplace(before, other_branch != was_separated);
  const bool same_as_before = seen->second == (other_branch != was_separated);
  // A wrong statement sets the same ISEP every time, for each status before.
  const bool is_usual = set_to_.emplace(before, got).first->second == got;
  assigned.bits += is_usual ? 0.0 : always_bits;
  if (!wrong) return;
  if (is_usual)
    explain_one(assigned,
                got == before || got == -before || got == static_cast<int>(assigned.last_value) ? 1.0 : 8.0);
  assigned.last_value = got;
  const bool told_so = !told || (*told == change::make) == !was_separated;
  if (other_branch && same_as_before && told_so)
    explain_one(suspects_[at(l::if_separated)], first ? 2.0 : 0.0);
}

void fault_finder::note_text(const answered_call& right, const call_outputs& other) {
  std::string_view a = *right.text;
  std::string_view b = other.text;
  if (a == b) return;
  ++differ_;
  const bool as_many = std::count(a.begin(), a.end(), '\n') == std::count(b.begin(), b.end(), '\n');
  while (!a.empty()) {
    const text_line expected(a);
    const text_line found(b);
    if (expected.words == found.words) continue;
    const int format = expected.format();
    const std::size_t name = as_many ? writer_of(expected, found, right.c.id.empty() ? 0 : right.c.id.back())
                             : format == 20 ? at(l::write_20)
                             : format == 40 ? at(l::write_40)
                             : format == 50 ? at(l::write_50)
                                            : at(l::write_60);
    explain_one(suspects_[name], 1.0);
    if (other.text.empty())
      for (const std::size_t left : left_by_) ++suspects_[left].explained;
    if (name == at(l::write_20)) explain_one(suspects_[at(l::if_no_events)], 2.0);
    return;
  }
}

std::optional<faulty_line> fault_finder::found() const {
  if (differ_ == 0) return std::nullopt;
  constexpr std::string_view compared[] = {"DTEST", "ABS(GAP)", "SSCHK", "DIFF"};
  const std::size_t ifs[] = {at(l::if_no_response), at(l::if_stationary), at(l::if_check_positive),
                             at(l::if_within)};
  // A line with one of these faults is wrong in every execution.
  const std::size_t always[] = {at(l::arguments),          at(l::common),
                                at(l::gap, wrong_sign),    at(l::do_10),
                                at(l::do_10, last_pair),   at(l::do_30),
                                at(l::do_30, last_pair),   at(l::no_response, loop_left),
                                at(l::moving, loop_left),  at(l::smallest, loop_left),
                                at(l::write_60, loop_left)};
  const bool by_threshold = most_true_ < least_false_ || most_false_ < least_true_;
  // A threshold this close to EPSMUL comes from a different rounding of DIFF, not from a wrong EPSMUL.
  const auto next_to = [](double x) { return x != 1.0 / 256.0 && std::abs(x * 256.0 - 1.0) < 1e-6; };
  const bool is_rounded = next_to(most_true_) && next_to(least_false_);
  double least = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  for (std::size_t name = 0; name < suspects_.size(); ++name) {
    const suspect& s = suspects_[name];
    if (s.explained == 0) continue;
    double bits = s.bits + unexplained_bits * static_cast<double>(differ_ - s.explained);
    // DIFF and ISEP determine where these two IFs are wrong, so that no executions need be listed.
    if (name == at(l::if_within))
      bits += !by_threshold || is_rounded ? 1e6 : 1.0;
    else if (name != at(l::if_separated))
      bits += choice_bits(s.reached, s.wrong);
    if (std::ranges::find(always, name) != std::end(always))
      bits += always_bits * static_cast<double>(s.reached - s.wrong);
    if (bits >= least) continue;
    least = bits;
    best = name;
  }
  const suspect& s = suspects_[best];
  if (s.explained == 0) return std::nullopt;
  faulty_line line{line_of(best), s.explained, differ_, std::min(differing_calls_, most_calls), ""};
  for (std::size_t k = 0; k < std::size(ifs); ++k) {
    if (ifs[k] != best || !std::isfinite(s.least) || !std::isfinite(s.most)) continue;
    char text[100];
    (void)std::snprintf(text, sizeof text, "%s was %.9g to %.9g", std::string(compared[k]).c_str(), s.least,
                        s.most);
    line.compared = text;
  }
  return line;
}

namespace {

std::string cited(const listing_line& line) {
  return "line " + std::to_string(line.number) + ", " + std::string(line.statement);
}

/// The line of the listing that gives `s`; empty if none does.
template <class Real>
std::string way_words(const pair_values<Real>& p, Real s) {
  if (p.responds && !p.is_stationary && same_bits(s, p.moving)) return cited(l::moving);
  if (same_bits(s, p.event) && s != Real(1)) return cited(l::if_check_positive);
  if (same_bits(s, p.moving)) return cited(l::moving);
  if (s == Real(1)) return cited(p.responds ? l::stationary : l::no_response);
  return "";
}

template <class Real>
std::string lines_in(const call<Real>& c, const answered_call& right, const call_outputs& other,
                     const std::string& leader, const std::string& follower) {
  std::size_t ss = 0;
  std::size_t isep = 0;
  while (ss < other.ss.size() && same_bits(c.ss[ss], static_cast<Real>(other.ss[ss]))) ++ss;
  while (isep < other.isep.size() && right.c.isep[isep] == other.isep[isep]) ++isep;
  const std::size_t i = ss < other.ss.size() ? ss : isep;
  if (i >= other.isep.size()) return "";
  const int before = right.isep_before[i];
  const pair_values<Real> p = values_of(c, before, i, c.dof.dof_of(c.id[i]) - 1);
  std::string words = "pair " + std::to_string(i + 1) + ": GAP = " + short_decimal(p.gap) +
                      ", DTEST = " + short_decimal(p.d_star);
  if (p.responds && p.is_stationary) words += ", SSCHK = " + short_decimal(p.sschk);
  if (i == ss) {
    const std::string way = way_words(p, static_cast<Real>(other.ss[i]));
    return words + "; " + leader + " took " + way_words(p, c.ss[i]) + "; " + follower +
           (way.empty() ? " has an SS that no line gives" : " has the SS of " + way);
  }
  const auto set_by = [before](int status) {
    return status == before ? "kept ISEP" : "took " + cited(status == in_contact ? l::make : l::break_);
  };
  return words + "; " + leader + " " + set_by(right.c.isep[i]) + "; " + follower + " " +
         set_by(other.isep[i]);
}

}  // namespace

std::string lines_taken(const answered_call& c, int real_bytes, const call_outputs& other,
                        const std::string& leader, const std::string& follower) {
  if (real_bytes == 8) return lines_in(c.c, c, other, leader, follower);
  return as_float_call(c.c, [&](const call<float>& f) { return lines_in(f, c, other, leader, follower); });
}

std::string words_of(const faulty_line& f) {
  std::string words = cited(f.at) + ": explains " +
                      (f.explained == f.differ ? "all " : std::to_string(f.explained) + " of ") +
                      std::to_string(f.differ) + " values that differ, in " + std::to_string(f.calls) +
                      " call(s)";
  if (!f.compared.empty()) words += "; in these " + f.compared;
  return words;
}

}  // namespace contct
