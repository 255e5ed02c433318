// A whole run: puts together kernels, engine, path, comparison, certificate and outputs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contct/results/exit_status.hpp"
#include "contct/results/free_run.hpp"
#include "contct/results/run_result.hpp"
#include "contct/text/output_file.hpp"

namespace contct {

struct run_request {
  std::string file = {};                  ///< the path of the problem file as given
  std::vector<std::string> kernels = {};  ///< the leader first; empty: only ends of steps
  bool both_rules = false;                ///< replaces `kernels`: the corrected rule, compared with 1989
  std::string engine = {};                ///< empty: the default of the leading kernel
  bool free_run = false;                  ///< each kernel follows its own path, see follow_alone
  bool envelope = false;
  bool compare_all = false;  ///< compares the rules in all combinations, not only in 20
  bool appendix = false;     ///< the printed page has its appendix
  bool pictures = false;     ///< keep all states, even if no output of this run needs them
  int max_increments = 0;    ///< limit for each step; 0: the default limit
  int watched = -1;          ///< the node in the table, from 0; -1: the node with the largest deflection
  std::string date = {};     ///< date for the page; may be empty
};

/// The parts of a result that are written besides the ends of steps.
enum class result_parts {
  ends,
  states,  ///< the structure, states within steps, and texts: all that a drawing of the run needs
  report   ///< `states`, the calls of the leader and unit 26
};

/// The files to write; null if not requested.
struct run_outputs {
  output_file* result = nullptr;
  result_parts parts = result_parts::ends;  ///< the parts in `result`
  output_file *log = nullptr, *trace = nullptr, *proof = nullptr, *page = nullptr;
  output_file *increments = nullptr, *pairs = nullptr;  ///< see write_csv
  /// See write_states_csv, write_supports_csv and write_envelope_csv.
  output_file *states = nullptr, *supports = nullptr, *envelope = nullptr;
};

class run {
 public:
  /// `p` and its structure `s` must outlive this object. Throws std::invalid_argument for kernels that cannot
  /// be compared.
  run(const problem& p, const linear_structure& s, run_request request);
  run(const run&) = delete;
  run& operator=(const run&) = delete;
  ~run() = default;

  /// Follows the leader's path, and for both rules the 1989 path; without kernels, finds the ends of the
  /// steps. Writes log and trace meanwhile; write_outputs (contct/write/outputs.hpp) writes the other files.
  /// The observers `shown`, which show the progress, are called after the comparison and the certificate.
  void go(const run_outputs& outputs, const std::vector<observer*>& shown = {});

  /// Finds the ends of the steps with half the element size, of a plate also with a quarter, and sets
  /// result.refined. Throws as refined does.
  void refine(int halvings = 2);

  /// Of a beam with beds: finds what is proved about the mesh's error at the end of each step.
  void find_mesh_errors();

  /// After a go() in free run: follows the path of kernel `name`, and compares it with the leader's path.
  const compared_path& follow_alone(const std::string& name);

  /// The exit status without --strict.
  [[nodiscard]] exit_status exit() const;

  const run_request wanted;
  run_result result;
  run_outputs to = {};

 private:
  solved_path follow_leader(std::vector<observer*>& all, certifier& proof);
  void follow_beside(std::vector<observer*> shown);
  void add_files_of_calls(const kernel_facts& of, std::vector<observer*>& all);

  /// Writes what the leader writes to unit 26.
  struct log_writer final : observer {
    explicit log_writer(output_file& file) : out(file) {}
    void called(const answered_call& c) override { out.write(c.text.value_or("")); }

    output_file& out;
  };

  std::unique_ptr<kernel> leader_;  // null after the path is followed
  kernel_facts leader_facts_ = {};
  std::optional<log_writer> log_;
  std::optional<trace_recorder> trace_;
};

/// Throws std::invalid_argument unless `kernels` are one or two different kernels of the 1989 rule, the first
/// one built in. Other rules do not follow the listing, whose lines are explained.
void refuse_other_rules(const std::vector<std::string>& kernels);

/// A path whose calls are explained by lines of the listing.
struct explained_run {
  /// `kernels`: see refuse_other_rules. `to` receives the increments selected by `wanted`. Throws
  /// std::invalid_argument if the kernels cannot be compared, and as make_kernel does.
  explained_run(const std::vector<std::string>& kernels, increments_wanted wanted, explained_path::sink to);

  /// Follows the leader's path. `engine`: see engine_for. The observer `shown` may be null.
  path_end follow(const problem& p, const linear_structure& s, const std::string& engine,
                  observer* shown = nullptr);

  [[nodiscard]] bool equal() const { return told.compared().mismatches == 0; }

  std::unique_ptr<kernel> leader;
  explained_path told;
};

}  // namespace contct
