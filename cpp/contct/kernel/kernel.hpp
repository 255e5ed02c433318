// A kernel: anything that answers one call of CONTCT. Built in are the compiled listing, C++ CONTCT, and the
// corrected rule.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/kernel/call.hpp"

namespace contct {

/// The rule by which a kernel decides about contact.
enum class contact_rule {
  listing,   ///< the 1989 rule
  corrected  ///< reference/corrected-rule.md
};

/// As traces and JSON name the rules.
inline constexpr std::array<std::string_view, 2> rule_names = {"listing", "corrected"};
[[nodiscard]] constexpr std::string_view name_of(contact_rule r) {
  return rule_names[r == contact_rule::corrected ? 1 : 0];
}

/// As messages name them.
[[nodiscard]] constexpr std::string_view rule_words(contact_rule r) {
  return r == contact_rule::listing ? "the 1989 rule" : "the corrected rule";
}

/// The properties of a kernel. Lockstep compares kernels of one precision and one rule.
struct kernel_facts {
  std::string name;  ///< as typed after --kernels
  int real_bytes;    ///< 8, or 4 for the listing as printed
  contact_rule rule;
  std::string language;          ///< for people
  std::string compiler;          ///< for people
  std::string flags;             ///< for people: how floating point was compiled
  bool has_text;                 ///< the kernel writes the listing's unit-26 text
  bool text_by_meaning = false;  ///< its text may write .25 for 0.25, and is compared so
};

/// The facts about an external kernel that follow from its name alone: the 1989 rule, 8-byte REAL, and no
/// text of its own. `what`: its description, for messages.
[[nodiscard]] inline kernel_facts facts_of_outside(std::string name, std::string what) {
  return {std::move(name), 8, contact_rule::listing, std::move(what), "", "", false};
}

/// A kernel that gave no answer: it crashed, did not answer in time, wrote where it must not. External
/// kernels throw it from `answer`, and can be asked again.
class kernel_failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A pure function of one call, in double precision at its boundary: its answer does not depend on earlier
/// calls, and is the same to the bit when the call is repeated. A single-precision kernel rounds dd, dtest
/// and cc to float on the way in and widens ss and smin, exactly, on the way out.
class kernel {
 public:
  virtual ~kernel() = default;
  [[nodiscard]] virtual const kernel_facts& facts() const = 0;

  /// Answer one call: sets c.ss and c.smin, toggles c.isep. Throws kernel_failure.
  virtual void answer(call<double>& c) = 0;

  /// The unit-26 text of the calls since the last take; empty if facts().has_text is false.
  virtual std::string take_text() = 0;
};

/// The names of all built-in kernels: "fortran", "fortran-r4", "cpp", "cpp-r4" and "corrected"; "flang" and
/// "f2c" where built.
[[nodiscard]] std::vector<std::string> kernel_names();

}  // namespace contct
