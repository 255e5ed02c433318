// Calls of CONTCT as text: the format of trace files and of messages to a pipe kernel, described in
// reference/trace-format.md.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "contct/kernel/call.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/text/input_text.hpp"

namespace contct {

/// The first line of every trace: the name and the date of the format.
inline constexpr std::string_view trace_format = "contct-trace-1 2026-11-21";

/// The header of a trace: name, precision, rule, compiler and flags of the kernel that answered, and more. If
/// `name` is "f2c", unit-26 texts are compared by meaning (.25 equals 0.25).
struct trace_header : kernel_facts {
  std::vector<std::string> about = {};  ///< lines about the purpose of the trace
  std::string listing = {};             ///< checksum of fortran/contct.f
  std::string lapack = {};              ///< library whose solves gave the inputs, or "none"
  std::string floating_point = {};      ///< the result of the floating-point probe
};

/// The header of a trace whose calls a kernel with these facts answers in this process. `listing` is the
/// checksum of the listing; `lapack` names the library whose solves gave the inputs.
[[nodiscard]] trace_header header_for(const kernel_facts& k, const std::string& listing,
                                      const std::string& lapack = "none");

void append_header(const trace_header& h, std::string& text);

/// Appends the inputs of a call, from "call N" and its note to "ask". Writes dd and dtest only at the dofs of
/// pairs, because a kernel may read no other dofs.
void append_inputs(const answered_call& answered, std::string_view note, std::string& text);

/// Appends an answer, from "smin" to "end".
void append_answer(double smin, std::span<const double> ss, std::span<const int> isep,
                   std::string_view unit_26, std::string& text);

/// Appends a whole call, inputs and answer.
void append_call(const answered_call& answered, std::string_view note, std::string& text);

/// Reads calls as text. Every error is an input_error with file, line, the text found and the text allowed.
class trace_reader {
 public:
  /// The largest number of dofs of a call, so that a short trace cannot use all memory.
  static constexpr int most_dofs = 10'000'000;

  /// `text` must outlive this object. `name` is the file's name in messages.
  trace_reader(std::string_view text, std::string_view name) : lines_(text, name) {}

  /// Reads the header of a trace file. Must be called before any other function; messages to and from a pipe
  /// kernel have no header.
  [[nodiscard]] trace_header read_header();

  /// Reads the next call with its answer; returns false at the end of the text. The numbers of calls must
  /// rise. dd and dtest are NaN where the trace has no value, so that a kernel that reads such a value is
  /// noticed.
  bool next(recorded_call& c);

  /// Reads only inputs, up to "ask"; returns false at the end of the text.
  bool next_inputs(recorded_call& c);

  /// Reads only an answer, for out.ss.size() pairs.
  void read_answer(call_outputs& out);

  /// The number of the last line read, from 1.
  [[nodiscard]] std::int64_t line() const { return lines_.line(); }

 private:
  std::string_view need_line(std::string_view allowed);
  [[noreturn]] void refuse(std::string_view found, std::string_view allowed) const;
  void read_header_line(std::string_view line, trace_header& h) const;
  void read_layout(call_inputs& in);
  void forget_dofs(call_inputs& in);
  void read_dofs(call_inputs& in);
  void read_pairs(call_inputs& in);
  void refuse_missing_dofs(const call_inputs& in) const;

  text_lines lines_;
  std::int64_t last_call_ = 0;
  std::vector<std::size_t> given_;  // the dofs with values in the last call, from 0
  std::vector<char> is_given_;      // 1 if a dof is in given_ [dofs]; never shrinks
};

}  // namespace contct
