// All that pictures of a run are made from, once it is over.
#pragma once

#include <string>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/compare/early_toggles.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/path/frames.hpp"
#include "contct/structure/problem.hpp"
#include "contct/write/run_record.hpp"

namespace contct {

struct finished_run {
  const problem& what;
  const frame_keeper& kept;
  const run_record& record;
  const certifier& judged;
  const early_toggles& early;
  std::string file;                  ///< the problem's, as it was named
  std::vector<std::string> kernels;  ///< the leader first
  std::string engine;
  std::string status;              ///< as results have it: "solved", ...
  std::string end;                 ///< why the path did not reach its end, in words; empty when it did
  bool in_lockstep = false;        ///< every call was put to the other kernels
  bool equal = true;               ///< and they agreed (in lockstep or on paths of their own)
  std::string comparison;          ///< how they did, in words; empty for a kernel alone
  std::vector<std::string> facts;  ///< version, listing, floating point
};

/// A title for people: the problem's, or its file's name.
[[nodiscard]] std::string title_of(const finished_run& r);

/// The words of `title_of` on one line.
[[nodiscard]] std::string on_one_line(std::string text);

}  // namespace contct
