#include "contct/results/run_result.hpp"

#include <filesystem>

#include "contct/results/exit_status.hpp"
#include "contct/results/rule_1989.hpp"

namespace contct {

std::string_view run_result::status() const {
  return status_name(end.status, equal);
}

const lockstep_on_path* run_result::compared_calls() const {
  if (beside) return &beside->compared;
  return compared ? &*compared : nullptr;
}

const run_recorder& run_result::record_of_calls() const {
  return beside ? beside->record : record;
}

std::string title_of(const problem& p, const std::string& file) {
  const bool named = p.title.find_first_not_of(" \t\r\n") != std::string::npos;
  if (named) return on_one_line(p.title);
  return file == "-" ? "A problem from standard input" : std::filesystem::path(file).filename().string();
}

}  // namespace contct
