#include "contct/compare/follower.hpp"

#include <stdexcept>
#include <string>

namespace contct {
namespace {

std::string words(const kernel_facts& k) {
  return "\"" + k.name + "\" (" + std::to_string(k.real_bytes) + "-byte REAL, rule \"" + k.rule + "\")";
}

}  // namespace

void refuse_unequal(const kernel_facts& leader, const kernel_facts& follower) {
  if (follower.real_bytes == leader.real_bytes && follower.rule == leader.rule) return;
  const bool precision = follower.real_bytes != leader.real_bytes;
  throw std::invalid_argument(words(leader) + " and " + words(follower) + " differ in " +
                              (precision ? "precision" : "rule") +
                              " and cannot be equal to the bit; compare them with --free-run");
}

std::optional<mismatch> put_to(kernel& follower, const call<double>& answered,
                               std::span<const int> isep_before, std::optional<std::string_view> text,
                               text_equality equality, call_outputs& out, tally& t) {
  constexpr double not_an_answer = -7.0;  // what no kernel may leave behind
  out.ss.assign(answered.ss.size(), not_an_answer);
  out.isep.assign(isep_before.begin(), isep_before.end());
  call<double> copy = answered;
  copy.ss = out.ss;
  copy.isep = out.isep;
  copy.smin = not_an_answer;
  try {
    follower.answer(copy);
  } catch (const kernel_failure& failure) {
    ++t.values;
    ++t.mismatches;
    return mismatch{"answer", 0, "an answer", failure.what(), 0};
  }
  out.smin = copy.smin;
  std::optional<mismatch> found =
      compare<double>({answered.smin, answered.ss, answered.isep}, {out.smin, out.ss, out.isep}, t);
  if (!text || !follower.facts().has_text) return found;
  out.text = follower.take_text();
  std::optional<mismatch> in_text = compare_text(*text, out.text, t, equality);
  return found ? found : in_text;
}

}  // namespace contct
