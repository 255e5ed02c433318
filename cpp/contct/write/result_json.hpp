// The result of a run as JSON, format "contct-result-1".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/compare/free_run.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/path/observer.hpp"
#include "contct/path/path.hpp"
#include "contct/structure/problem.hpp"
#include "contct/text/output_file.hpp"
#include "contct/write/load_text.hpp"

namespace contct {

/// Observes a path and writes it as it goes: memory does not grow with the number of steps.
/// The file appears when `finish` is called.
class result_json final : public observer {
 public:
  /// `p`, `judged` and `out` must outlive this object. It must observe behind the certifier.
  result_json(const problem& p, const std::vector<std::string>& kernels, std::string_view engine,
              const certifier& judged, output_file& out);

  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

  /// Add how another kernel's own path compares.
  void add_free_run(std::string_view kernel, const free_run_difference& d, bool certified);

  /// Close the document. `compared` is null when there was one kernel only.
  void finish(std::string_view status, const path_end& end, const lockstep* compared);

 private:
  void write_pairs(const step_state& s);
  void write_reactions(const step_state& s, const load& total);
  void write_elements(const step_state& s, const load& total);
  template <class Entry>
  void write_list(std::string_view name, std::size_t count, Entry entry, bool last = false);

  const problem& problem_;
  const certifier& judged_;
  load_path loads_;
  output_file& out_;
  std::vector<std::string> increments_;  // of the step under way, as JSON
  std::vector<std::string> free_runs_;   // as JSON
  bool first_step_ = true;
};

/// "below" or "above".
[[nodiscard]] std::string_view surface_name(int surface);
/// "make" or "break".
[[nodiscard]] std::string_view change_name(change c);
/// "solved", "mechanism" or "iteration-limit".
[[nodiscard]] std::string_view status_name(path_status status);

}  // namespace contct
