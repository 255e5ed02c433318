#include "mutants/verdict.hpp"

#include <csignal>
#include <sstream>
#include <stdexcept>

#include "listing/child.hpp"
#include "mutants/build.hpp"

namespace contct_test {
namespace {

const int not_the_mutants_fault = 9;      // judge_main.cpp
const unsigned judge_cpu_seconds = 5;     // a mutant that lives takes a quarter of one
const std::string from_judge = "judge ";  // a mutant may print lines of its own

bool begins(const std::string& text, const std::string& beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

std::string in_words(const child_end& end) {
  if (end.exited) return "ends with status " + std::to_string(end.status);
  if (end.status == SIGXCPU || end.status == SIGKILL || end.status == SIGALRM) return "hangs";
  return "crashes (signal " + std::to_string(end.status) + ")";
}

/// "3 SS(2)" as "call 3, SS(2)".
std::string call_and_field(const std::string& said) {
  const std::size_t blank = said.find(' ');
  return "call " + said.substr(0, blank) + ", " + said.substr(blank + 1);
}

verdict read_verdict(const child_end& end) {
  verdict v;
  std::string at = "start";
  bool finished = false;
  std::istringstream stream(end.out);
  for (std::string line; std::getline(stream, line);) {
    if (!begins(line, from_judge)) continue;
    line.erase(0, from_judge.size());
    finished = line == "end";
    if (begins(line, "at ")) at = line.substr(3);
    if (begins(line, "differs ")) v.kills.push_back({at, call_and_field(line.substr(8))});
  }
  if (end.exited && end.status == not_the_mutants_fault) throw std::runtime_error(end.err);
  if (!end.well() || !finished) v.kills.push_back({at, in_words(end)});
  return v;
}

}  // namespace

std::optional<kill> verdict::first_in(const std::string& beginning) const {
  for (const kill& k : kills)
    if (begins(k.where, beginning)) return k;
  return {};
}

int verdict::count_in(const std::string& beginning) const {
  int count = 0;
  for (const kill& k : kills) count += begins(k.where, beginning) ? 1 : 0;
  return count;
}

verdict judged(const mutant& m, const std::string& source, const bounded_fuzz& fuzz) {
  const scratch_folder folder;
  const std::filesystem::path program = build_program(m, source, folder.path());
  return read_verdict(run_child({program.string(), is_fortran(m) ? "fortran" : "cpp", CONTCT_TRACES,
                                 std::to_string(fuzz.calls), std::to_string(fuzz.seed)},
                                folder.path(), judge_cpu_seconds));
}

}  // namespace contct_test
