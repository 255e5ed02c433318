#include "contct/compare/follower.hpp"

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace contct::compare {
namespace {

std::string described(const kernel_facts& k) {
  return "\"" + k.name + "\" (" + std::to_string(k.real_bytes) + "-byte REAL, rule \"" + k.rule + "\")";
}

/// "SS(3)", "text, line 2", "SMIN".
std::string place_words(const mismatch& d) {
  if (d.index == 0) return d.field;
  std::string words = d.field + (d.field == "text" ? ", line " : "(");
  words += std::to_string(d.index);
  if (d.field != "text") words += ")";
  return words;
}

/// " (3 ULP)", where numbers were compared.
std::string ulp_words(const mismatch& d) {
  if (d.field != "SS" && d.field != "SMIN") return "";
  if (d.ulps == std::numeric_limits<std::uint64_t>::max()) return " (one is NaN)";
  std::string words = " (";
  words += std::to_string(d.ulps);
  return words + " ULP)";
}

}  // namespace

std::string margin_words(const mismatch_report& f) {
  const std::optional<decision> least = narrowest(f.decisions);
  if (!least) return "branch margin: the listing decided nothing in this call";
  const bool with_nan = least->ulps == std::numeric_limits<std::uint64_t>::max();
  const bool tie = least->ulps <= tie_ulps;
  return "branch margin: " + words_of(*least) +
         (tie        ? ": a tie, which rounding may decide otherwise"
          : with_nan ? ""
                     : "; every other decision by as much or more: no tie, a bug");
}

std::vector<std::string> words_of(const mismatch_report& f) {
  std::string line = "call ";
  line += std::to_string(f.call);
  line += ": " + f.follower;
  if (f.where.field == "answer") return {line + " gave no answer: " + f.where.follower};
  line += " differs in " + place_words(f.where) + ": " + f.leader + " has " + f.where.leader + ", " +
          f.follower + " has " + f.where.follower + ulp_words(f.where);
  return {line, margin_words(f)};
}

void refuse_unequal(const kernel_facts& leader, const kernel_facts& follower) {
  if (follower.real_bytes == leader.real_bytes && follower.rule == leader.rule) return;
  const bool precision = follower.real_bytes != leader.real_bytes;
  throw std::invalid_argument(described(leader) + " and " + described(follower) + " differ in " +
                              (precision ? "precision" : "rule") +
                              " and cannot be equal to the bit; compare them with --free-run");
}

std::optional<mismatch> ask_and_compare(kernel& k, const call<double>& answered,
                                        std::span<const int> isep_before,
                                        std::optional<std::string_view> text, text_equality equality,
                                        call_outputs& out, tally& t) {
  out.ss.assign(answered.ss.size(), not_an_answer);
  out.isep.assign(isep_before.begin(), isep_before.end());
  call<double> copy = answered;
  copy.ss = out.ss;
  copy.isep = out.isep;
  copy.smin = not_an_answer;
  try {
    k.answer(copy);
  } catch (const kernel_failure& failure) {
    ++t.values;
    ++t.mismatches;
    return mismatch{"answer", 0, "an answer", failure.what(), 0};
  }
  out.smin = copy.smin;
  std::optional<mismatch> found =
      compare_answers<double>({answered.smin, answered.ss, answered.isep}, {out.smin, out.ss, out.isep}, t);
  if (!text || !k.facts().has_text) return found;
  out.text = k.take_text();
  std::optional<mismatch> in_text = compare_text(*text, out.text, t, equality);
  return found ? found : in_text;
}

follower::follower(kernel_facts leader, kernel& k) : leader_(std::move(leader)), kernel_(&k) {}

const std::optional<mismatch>& follower::ask(std::int64_t number, const call<double>& answered,
                                             std::span<const int> isep_before,
                                             std::optional<std::string_view> text) {
  difference_ = ask_and_compare(*kernel_, answered, isep_before, text, equality(), answer_, compared);
  if (difference_) note(number, *difference_, answered, isep_before);
  return difference_;
}

void follower::note(std::int64_t number, const mismatch& found, const call<double>& answered,
                    std::span<const int> isep_before) {
  if (first_ && first_->call <= number) return;
  first_ = mismatch_report{number, leader_.name, kernel_->facts().name, found,
                           decisions_of(answered, isep_before, leader_.real_bytes)};
}

}  // namespace contct::compare
