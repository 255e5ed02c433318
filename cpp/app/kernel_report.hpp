// --report of fuzz and replay: the calls of one kernel and its mismatches, as a file that can be submitted
// and replayed: reference/vectors/verify_report.py.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "contct/compare/compare.hpp"

namespace contct {

/// A trace that was replayed.
struct replayed_trace {
  std::string name;  ///< of the file, without folder and extension
  std::string sha256;
  std::int64_t calls = 0, mismatches = 0;
};

struct kernel_report {
  std::string command;  ///< "replay", or the line that repeats a fuzz run
  std::string kernel;   ///< its name
  std::string rung;     ///< the closest equality that holds
  std::int64_t calls = 0;
  tally compared;
  std::vector<replayed_trace> traces;
  std::vector<std::string> first_mismatch;  ///< the first mismatch, in lines
};

/// Throws std::invalid_argument where `outputs` are asked for and not just one kernel is checked.
void refuse_many_reported(std::size_t kernels, const std::string& outputs);

/// As JSON, format "contct-report-1".
[[nodiscard]] std::string report_json(const kernel_report& r);

/// As a badge: "CONTCT", and the rung.
[[nodiscard]] std::string badge_svg(const kernel_report& r);

/// Explains the faults of a kernel by its answers to the golden set in 8-byte REAL, in the order of the set:
/// the sentences of reference/course/hints.toml, about the known faults that give all of these answers.
[[nodiscard]] std::vector<std::string_view> known_faults(const fault_finder& answers);

/// Of several replays the lowest rung: "bits", "ulps", "events" or "none".
[[nodiscard]] std::string rung_of(const nearness& n, const tally& compared);

}  // namespace contct
