// The run as tables, an increment a row: on the terminal, and in files for spreadsheets and data frames.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "contct/text/output_file.hpp"
#include "contct/text/terminal.hpp"
#include "contct/write/step_results.hpp"

namespace contct::write {

/// A share in at most nine columns, with as many digits as fit. What is less than 1 is never shown as 1,
/// which means the whole load: "1-3e-09".
[[nodiscard]] std::string share_words(double x);

/// The largest of each quantity on a path so far, by name: what is nothing but rounding of it is printed as
/// 0.
using sizes_so_far = std::map<std::string, double, std::less<>>;

/// The largest deflection, moment, contact force and reaction with their places, a line each, of at most
/// `width` columns where that is 60 or more.
[[nodiscard]] std::vector<std::string> largest_lines(const problem& p, const step_results& r, int width,
                                                     sizes_so_far& sizes);

/// Tables of all pairs, reactions and ends of elements, 80 columns wide.
[[nodiscard]] std::string detail_tables(const problem& p, const step_state& s, const step_results& r);

/// Observes a path and prints it as it goes. Place it behind the lockstep and the
/// certifier that it reports on.
class table final : public observer {
 public:
  /// `p` and `judged` must outlive this object, and so must `compared`, which is null where
  /// one kernel runs. `detail`: every event, and all numbers of each step's end.
  table(const problem& p, const lockstep* compared, const certifier& judged, const terminal& t, bool detail);

  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

  /// What the columns and words of the rows so far mean, to stand below them.
  [[nodiscard]] std::vector<std::string> legend() const;

 private:
  [[nodiscard]] std::string row(std::string_view number, std::string_view share, std::string_view s,
                                std::string_view kernels, std::string_view load,
                                std::string_view events) const;
  [[nodiscard]] std::string agreement() const;
  void print_row(const increment& i, std::string_view kernels, const std::vector<std::string>& events);
  void flush_first_load();

  const problem& problem_;
  load_path loads_;
  const lockstep* compared_;
  const certifier& judged_;
  terminal terminal_;
  int load_width_ = 0;         // 0: no room for loads
  int indent_ = 0;             // of the events
  bool events_below_ = false;  // on a narrow terminal they stand on lines of their own
  bool headed_ = false, snapped_ = false, ended_ = false;  // what the rows so far have shown
  std::vector<event> last_events_;                         // of the increment before
  std::vector<int> deflecting_;
  sizes_so_far sizes_;
  bool detail_;

  /// Increments at which a step's load has only begun: one row for them all.
  struct {
    increment last{};
    int increments = 0;
    std::set<int> makes = {}, breaks = {};  // pairs
    bool equal = true;
    std::vector<std::string> events;
  } first_load_;
};

/// A field of a table in a file: quoted where it has to be.
[[nodiscard]] std::string csv_field(std::string_view raw);

/// Observes a path and writes it as it goes, by RFC 4180, numbers with all their digits: memory does not grow
/// with its length.
///
/// The first table has a row an increment: step, increment, kind ("load"; "snap": a rigid motion at constant
/// load; "end": the step ended without an increment, "rescue": in a state from elsewhere), s, share (of the
/// step's load), force (sum of the loads), events ("make 1, break 3"), closed, open and at_face (how many
/// pairs), smin (of the call, as the kernel gave it), kernels ("equal" or "differ"; empty: not compared),
/// node (the watched one: a number or a label) and w, its deflection.
///
/// The second has a row for each pair in each of these: step, increment, pair, node, surface, state
/// ("contact", "separated"; a dof's label stands for the node where each dof is one), look ("closed", "open",
/// "at its face"), w, gap, force.
class run_csv final : public observer {
 public:
  /// `compared` and `pairs` may be null; all must outlive this object, which observes behind `compared` and
  /// `states`. These solve for every increment (frame_keeper::solve_each). `watched`: a node, from 0.
  run_csv(const problem& p, const lockstep* compared, const frame_keeper& states, int watched,
          output_file& increments, output_file* pairs);

  void called(const answered_call& c) override;
  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

  void finish();

 private:
  void write_pending();

  const problem& problem_;
  load_path loads_;
  const lockstep* compared_;
  const frame_keeper& states_;
  int watched_;
  output_file& increments_;
  output_file* pairs_;
  std::optional<double> smin_;
  std::string_view agreement_;
  bool pending_ = false;  // the last increment waits for its step's end, which knows it better
  struct {
    int step = 0, number = 0;
    std::string_view kind;
    double s = 0.0, fraction = 0.0;
    std::vector<event> events;
    std::vector<double> w;       // [pairs]
    std::vector<int> isep;       // [pairs]
    std::vector<double> forces;  // [pairs]
    std::optional<double> watched;
  } last_;
};

}  // namespace contct::write
