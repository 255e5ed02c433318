// A whole run: a problem's kernels, engine, path, comparison, certificate and outputs, put together here and
// nowhere else.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contct/path/free_run.hpp"
#include "contct/session/exit_status.hpp"
#include "contct/session/run_result.hpp"
#include "contct/text/output_file.hpp"

namespace contct {

struct run_request {
  std::string file = {};  ///< the problem's, as it was named
  std::vector<std::string> kernels =
      {};                   ///< the leader first; none: only the ends of steps, by the reference solution
  bool both_rules = false;  ///< instead of kernels: the corrected rule leads, that of 1989 runs beside it
  std::string engine = {};  ///< empty: what suits the leader
  bool free_run = false;    ///< each kernel runs free, see follow_alone
  bool envelope = false;
  bool pictures = false;   ///< states are kept, also where no output here needs them
  int max_increments = 0;  ///< in a step; 0: the default limit
  int watched = -1;        ///< the node of the table, from 0; -1: the one that deflects most
  std::string date = {};   ///< of the page; may be empty
};

/// What else than the ends of steps is written.
enum class result_parts {
  ends,
  states,  ///< also the structure, states within steps, and all in words: what draws the run needs no more
  report   ///< also the leader's calls and unit 26
};

/// Null: not asked for.
struct run_outputs {
  output_file* result = nullptr;
  result_parts parts = result_parts::ends;  ///< of the result
  output_file *log = nullptr, *trace = nullptr, *proof = nullptr, *page = nullptr;
  output_file *table = nullptr, *pairs = nullptr;      ///< of write_csv
  output_file *states = nullptr, *envelope = nullptr;  ///< of write_states_csv and write_envelope_csv
};

class run {
 public:
  /// `p` and `s`, its structure, must outlive this object. Throws std::invalid_argument for kernels that
  /// cannot be compared.
  run(const problem& p, const linear_structure& s, run_request request);
  run(const run&) = delete;
  run& operator=(const run&) = delete;
  ~run() = default;

  /// Follow the leader's path, or find the ends of the steps. Log and trace are written meanwhile, the others
  /// by write_outputs (contct/write/outputs.hpp).
  /// `shown`, who shows how far the path has come, observes behind the comparison and the certificate.
  void go(const run_outputs& outputs, const std::vector<observer*>& shown = {});

  /// Find the ends of the steps on half the element size, and how they differ.
  void refine();

  /// How the path of another kernel compares with the leader's, for the result too.
  const compared_path& follow_alone(const std::string& name);

  /// Of a run that need not be certified.
  [[nodiscard]] exit_status exit() const;

  const run_request wanted;
  run_result result;
  run_outputs to = {};

 private:
  path_end follow_leader(std::vector<observer*>& all);
  void follow_beside(std::vector<observer*> shown);
  void add_files_of_calls(const kernel_facts& of, std::vector<observer*>& all);

  /// Writes what the leader writes to unit 26.
  struct log_writer final : observer {
    explicit log_writer(output_file& file) : out(file) {}
    void called(const answered_call& c) override { out.write(c.text.value_or("")); }

    output_file& out;
  };

  std::unique_ptr<kernel> leader_;  // while it follows the path
  kernel_facts leader_facts_ = {};
  std::optional<log_writer> log_;
  std::optional<trace_recorder> trace_;
  std::optional<path_record> own_path_;  // of the leader, in free run
};

/// Throws std::invalid_argument unless these are one or two kernels of the 1989 rule, whose lines the listing
/// has, the first one built in.
void refuse_other_rules(const std::vector<std::string>& kernels);

/// A run that is explained as it goes on, line by line of the listing.
struct explained_run {
  /// `kernels` as refuse_other_rules has them; `to` is given the increments that are wanted. Throws
  /// std::invalid_argument where the second cannot be compared with the first, and as make_kernel does.
  explained_run(const std::vector<std::string>& kernels, increments_wanted wanted, explained_path::sink to);

  /// Follow the leader's path; `engine` may be empty or "auto". `shown` watches it too, and may be null.
  path_end follow(const problem& p, const linear_structure& s, const std::string& engine,
                  observer* shown = nullptr);

  [[nodiscard]] bool equal() const { return told.compared().mismatches == 0; }

  std::unique_ptr<kernel> leader;
  explained_path told;
};

}  // namespace contct
