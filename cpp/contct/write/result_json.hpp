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
#include "contct/write/finished_run.hpp"
#include "contct/write/json_document.hpp"
#include "contct/write/load_text.hpp"
#include "contct/write/words.hpp"

namespace contct::write {

/// Observes a path and writes it as it goes: memory does not grow with the number of steps.
/// The file appears when `finish` is called.
class result_json final : public observer {
 public:
  /// `p`, `judged` and `out` must outlive this object. It must observe behind the certifier.
  result_json(const problem& p, const std::vector<std::string>& kernels, std::string_view engine,
              const certifier& judged, output_file& out);

  void incremented(const increment& i) override { increments_.emplace_back(i); }
  void step_ended(const step_state& s) override;

  /// Add how another kernel's own path compares.
  void add_free_run(std::string_view kernel, const free_run_difference& d, bool certified) {
    free_runs_.push_back({std::string(kernel), d, certified});
  }

  /// Close the document. `compared` is null when there was one kernel only.
  void finish(std::string_view status, const path_end& end, const lockstep* compared);

 private:
  void write_increments();
  void write_pairs(const step_state& s);
  void write_reactions(const step_state& s, const load& total);
  void write_elements(const step_state& s, const load& total);

  struct compared_path {
    std::string kernel;
    free_run_difference difference;
    bool certified;
  };
  const problem& problem_;
  const certifier& judged_;
  load_path loads_;
  json_document document_;
  std::vector<increment_record> increments_;  // of the current step
  std::vector<compared_path> free_runs_;
};

}  // namespace contct::write
