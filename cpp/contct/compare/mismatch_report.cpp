#include "contct/compare/mismatch_report.hpp"

#include <limits>

namespace contct {

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

namespace {

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

std::vector<std::string> words_of(const mismatch_report& f) {
  std::string line = "call ";
  line += std::to_string(f.call);
  line += ": " + f.follower;
  if (f.where.field == "answer") return {line + " gave no answer: " + f.where.follower};
  line += " differs in " + place_words(f.where) + ": " + f.leader + " has " + f.where.leader + ", " +
          f.follower + " has " + f.where.follower + ulp_words(f.where);
  return {line, margin_words(f)};
}

}  // namespace contct
