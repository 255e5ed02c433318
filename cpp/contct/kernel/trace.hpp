// Calls of CONTCT as text: the format of trace files and of the messages through a pipe.
// reference/trace-format.md describes it for people.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "contct/kernel/call.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/text/input_text.hpp"

namespace contct {

/// The first line of every trace: the format and the day on which it was fixed.
inline constexpr std::string_view trace_format = "contct-trace-1 2026-11-21";

/// The header of a trace. `real_bytes` and `rule` decide which kernels can answer it, and the kernel "f2c"
/// how its text is compared; the rest is for the reader.
struct trace_header {
  std::vector<std::string> about;  ///< the purpose of the trace, by lines
  std::string kernel;              ///< who answered
  int real_bytes = 8;              ///< 8, or 4 for the listing as printed
  contact_rule rule = contact_rule::listing;
  std::string listing;         ///< checksum of fortran/contct.f
  std::string compiler;        ///< of the kernel that answered
  std::string flags;           ///< and its floating-point flags
  std::string lapack;          ///< whose solves the inputs come from, or "none"
  std::string floating_point;  ///< the result of the probe
};

/// One call, and the answer to it.
struct recorded_call {
  std::int64_t number = 0;
  std::string note;  ///< the purpose of the call; may be empty
  call_inputs<double> in;
  call_outputs out;

  /// The same for comparisons. A kernel with text writes some in every call: where the trace has none, its
  /// kernel had none.
  [[nodiscard]] answered_call answered() {
    return {{in.dd, in.dtest, in.cc, out.ss, out.smin, in.id, out.isep, in.isurf, in.dof},
            in.isep,
            out.text.empty() ? std::nullopt : std::optional<std::string_view>(out.text),
            number};
  }
};

/// The header of a trace that a kernel with these facts answers, in this process: `listing` is the checksum;
/// `lapack` names the library whose solves gave the inputs; empty if none did.
[[nodiscard]] trace_header header_for(const kernel_facts& k, const std::string& listing,
                                      const std::string& lapack = "none");

/// Append the header of a trace.
void append_header(const trace_header& h, std::string& text);

/// Append the inputs of a call, from "call N" and its note to "ask". Of dd and dtest only the dofs of the
/// pairs are written: a kernel may not read others.
void append_inputs(const answered_call& answered, std::string_view note, std::string& text);
void append_inputs(std::int64_t number, std::string_view note, const call_inputs<double>& in,
                   std::string& text);

/// Append an answer, from "smin" to "end".
void append_answer(double smin, std::span<const double> ss, std::span<const int> isep,
                   std::string_view unit_26, std::string& text);

/// Reads calls as text. Every error is an input_error that names file, line, what was found and what is
/// allowed; nothing is half-accepted.
class trace_reader {
 public:
  /// Most dofs of a call: a trace that names one dof must not take all memory.
  static constexpr int most_dofs = 10'000'000;

  /// `text` must outlive this object. `name` is the file's, for messages.
  trace_reader(std::string_view text, std::string_view name) : lines_(text, name) {}

  /// The header. Call it once, first.
  [[nodiscard]] trace_header read_header();

  /// The next call with its answer; false at the end of the text. Calls are numbered in rising order.
  /// dd and dtest are NaN wherever the trace says nothing, so that a kernel that reads there is noticed.
  bool next(recorded_call& c);

  /// The inputs alone, up to "ask"; false at the end of the text.
  bool next_inputs(recorded_call& c);

  /// The answer alone, for as many pairs as `out.ss` has.
  void read_answer(call_outputs& out);

  /// The number of the line read last, from 1.
  [[nodiscard]] std::int64_t line() const { return lines_.line(); }

 private:
  std::string_view need_line(std::string_view allowed);
  [[noreturn]] void refuse(std::string_view found, std::string_view allowed) const;
  void read_header_line(std::string_view line, trace_header& h) const;
  void read_layout(call_inputs<double>& in);
  void forget_dofs(call_inputs<double>& in);
  void read_dofs(call_inputs<double>& in);
  void read_pairs(call_inputs<double>& in);
  void refuse_missing_dofs(const call_inputs<double>& in) const;

  text_lines lines_;
  std::int64_t last_call_ = 0;
  std::vector<std::size_t> given_;  // the dofs that the last call gave, from 0
  std::vector<char> is_given_;      // by dof; never shrinks
};

}  // namespace contct
