// --report of `contct fuzz` and `contct replay`: the calls and mismatches of one kernel, as a file that can
// be submitted and that reference/vectors/verify_report.py checks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/outputs.hpp"
#include "contct/compare/compare.hpp"

namespace contct {

/// A trace that was replayed.
struct replayed_trace {
  std::string name;  ///< the file's name without folder and extension
  std::string sha256;
  std::int64_t calls = 0, mismatches = 0;
};

struct kernel_report {
  std::string command;  ///< "replay", or the command that repeats a fuzz run
  std::string kernel;   ///< the kernel's name
  std::string rung;     ///< the highest level of equality that the kernel reaches
  std::int64_t calls = 0;
  tally compared;
  std::vector<replayed_trace> traces;
  std::vector<std::string> first_mismatch;  ///< the first mismatch, in lines
  std::optional<faulty_line> at_fault = {};
};

/// Throws std::invalid_argument if `outputs` are requested, but not exactly one kernel is checked.
void refuse_many_reported(std::size_t kernels, const std::string& outputs);

/// Writes the requested ones of --report, as JSON of the format "contct-report-1", and --badge, "CONTCT" and
/// the rung.
void write_report(const output_files& files, const kernel_report& r);

/// Explains the faults of a kernel by its answers to the golden set in 8-byte REAL, in the order of the set:
/// "known fault: ..", the sentences of reference/course/hints.toml about the faults that give all of these
/// answers.
[[nodiscard]] std::vector<std::string> known_faults(const fault_finder& answers);

}  // namespace contct
