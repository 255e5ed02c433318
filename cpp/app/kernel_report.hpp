// Writes the report of `contct fuzz` and `contct replay` on one kernel (--report): its calls and mismatches.
// The file can be submitted; reference/vectors/verify_report.py checks the file. Also writes the result of
// `contct replay` (--json). contct-replay is built without a JSON library, so this code writes the text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/outputs.hpp"
#include "contct/harness/compare.hpp"

namespace contct {

/// The comparison of a kernel with a trace.
struct compared_trace {
  std::string file, kernel;
  std::string verdict;  ///< "equal", "mismatch", "environment" or "skipped"
  std::int64_t calls = 0;
  tally compared = {};
  std::optional<mismatch_report> first = {};
  std::string name = {};    ///< the file's name without folder and extension
  std::string sha256 = {};  ///< of the file; empty if it is skipped
};

struct kernel_report {
  std::string command;  ///< "replay", or the command that repeats a fuzz run
  std::string kernel;
  std::string rung;  ///< the highest level of equality that the kernel reaches
  std::int64_t calls = 0;
  tally compared;
  std::vector<compared_trace> traces;
  std::vector<std::string> first_mismatch;  ///< the first mismatch, in lines
  std::optional<faulty_line> at_fault = {};
};

/// What all traces together show about a kernel: the line at fault, and lines of text.
struct checked_kernel {
  std::string name;
  std::optional<faulty_line> at_fault;
  std::vector<std::string> findings;
};

/// The result of `contct replay` as JSON, format "contct-replay-1".
[[nodiscard]] std::string replay_json(const kernel_report& r, const std::vector<checked_kernel>& kernels);

/// Throws std::invalid_argument if `outputs`, the file names of --report and --badge, are not empty although
/// the number of checked kernels is not 1.
void refuse_many_reported(std::size_t kernels, const std::string& outputs);

/// Writes the files of --report, as JSON of the format "contct-report-1", and of --badge, an SVG picture of
/// the rung, if requested.
void write_report(const output_files& files, const kernel_report& r);

/// Returns lines "known fault: ..", with the sentences of reference/course/hints.toml about the faults that
/// give the same answers. `answers` has noted a kernel's answers to the golden set (reference/traces) in
/// 8-byte REAL, in the order of the files' names.
[[nodiscard]] std::vector<std::string> known_faults(const fault_finder& answers);

}  // namespace contct
