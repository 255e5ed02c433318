#include "listing/judge.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <vector>

#include "listing/edit.hpp"
#include "listing/trial.hpp"

namespace contct_test {
namespace {

/// The untouched listing, compiled with these options; tried out once for each set of them.
const behaviour& untouched(const std::string& listing, const std::vector<std::string>& options) {
  static std::map<std::vector<std::string>, behaviour> known;
  if (!known.contains(options)) known[options] = try_out(listing, options);
  const behaviour& b = known[options];
  if (!b.ends_well) throw std::runtime_error("these options spoil the listing itself: " + b.complaint);
  return b;
}

}  // namespace

outcome carry_out(const undo& u, const std::string& listing) {
  const std::string copy = edited(listing, u.replace);
  outcome seen = classify(untouched(listing, u.compile), try_out(copy, u.compile));
  if (seen.what == unnoticed && checksum_refuses(copy)) seen.what = source_only;
  return seen;
}

std::string in_words(const outcome& seen) {
  std::string words = seen.what;
  if (!seen.call.empty()) words += ", in the call \"" + seen.call + '"';
  if (!seen.field.empty()) words += ", first in " + seen.field;
  return words;
}

std::string objection(const undo& u, const outcome& seen) {
  const std::vector<std::string> legal{
      does_not_compile, aborts_under_bounds_check, dies, other_numbers, other_text, source_only};
  if (std::find(legal.begin(), legal.end(), u.expect) == legal.end()) return "no such outcome: " + u.expect;
  if (u.expect == seen.what && u.call == seen.call && u.field == seen.field) return "";
  return "expected " + in_words({u.expect, u.call, u.field}) + "; seen " + in_words(seen);
}

}  // namespace contct_test
