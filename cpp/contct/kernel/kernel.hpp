// A kernel answers calls of CONTCT. The listing, C++ CONTCT and the corrected rule are built-in kernels.
#pragma once

#include <array>
#include <functional>
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
  corrected  ///< the corrected rule: reference/corrected-rule.md
};

/// The names of the rules in traces and JSON.
inline constexpr std::array<std::string_view, 2> rule_names = {"listing", "corrected"};
[[nodiscard]] constexpr std::string_view name_of(contact_rule r) {
  return rule_names[r == contact_rule::corrected ? 1 : 0];
}

/// The name of a rule in messages.
[[nodiscard]] constexpr std::string_view rule_words(contact_rule r) {
  return r == contact_rule::listing ? "the 1989 rule" : "the corrected rule";
}

/// The properties of a kernel. Kernels in lockstep must have the same precision and rule.
struct kernel_facts {
  std::string name;    ///< the name for --kernels
  int real_bytes = 8;  ///< 8, or 4 for the listing as printed
  contact_rule rule = contact_rule::listing;
  std::string language;
  std::string compiler;
  std::string flags;             ///< the compiler's floating-point flags
  bool has_text = false;         ///< the kernel writes the listing's unit-26 text
  bool text_by_meaning = false;  ///< the text may have .25 for 0.25, which counts as equal
};

/// True if the kernels have the same precision and rule, so that their answers can be equal to the bit.
[[nodiscard]] inline bool comparable(const kernel_facts& a, const kernel_facts& b) {
  return a.real_bytes == b.real_bytes && a.rule == b.rule;
}

/// The facts of an external kernel: the 1989 rule, 8-byte REAL, no text. `what` is shown instead of a
/// language.
[[nodiscard]] inline kernel_facts facts_of_outside(std::string name, std::string what) {
  return {std::move(name), 8, contact_rule::listing, std::move(what), "", "", false};
}

/// A kernel gave no valid answer: for example, it crashed, exceeded the time limit, or wrote to forbidden
/// memory. Thrown by `answer` of an external kernel, which can be called again afterwards.
class kernel_failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A pure function of one call: its answer does not depend on earlier calls. Arguments are doubles. A 4-byte
/// kernel rounds dd, dtest and cc to float, and converts ss and smin exactly to double.
class kernel {
 public:
  explicit kernel(kernel_facts facts) : facts_(std::move(facts)) {}
  virtual ~kernel() = default;
  [[nodiscard]] const kernel_facts& facts() const { return facts_; }

  /// Answers one call: sets c.ss and c.smin, toggles c.isep. Throws kernel_failure.
  virtual void answer(call<double>& c) = 0;

  /// Returns the unit-26 text since the last call of take_text; empty if facts().has_text is false.
  virtual std::string take_text();

 protected:
  std::string text_;  // unit-26 text that was not taken yet

 private:
  kernel_facts facts_;
};

/// A kernel that answers by a function, which appends the unit-26 text to `text`.
class function_kernel : public kernel {
 public:
  using function = std::function<void(call<double>& c, std::string& text)>;
  function_kernel(kernel_facts facts, function f) : kernel(std::move(facts)), function_(std::move(f)) {}
  void answer(call<double>& c) override { function_(c, text_); }

 private:
  function function_;
};

/// Returns the answer of `k` to a call, with its text.
[[nodiscard]] inline call_outputs answer_of(kernel& k, const call_inputs& in) {
  call_outputs out;
  call<double> c = out.prepare(in);
  k.answer(c);
  out.smin = c.smin;
  out.text = k.take_text();
  return out;
}

/// The names of all built-in kernels: "fortran", "fortran-r4", "cpp", "cpp-r4", "corrected", and "flang" and
/// "f2c" if they are built.
[[nodiscard]] std::vector<std::string> kernel_names();

}  // namespace contct
