// What `contct run` draws and tabulates: --html, --svg, --csv and --vtu.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/outputs.hpp"
#include "contct/path/frames.hpp"
#include "contct/write/finished_run.hpp"
#include "contct/write/table.hpp"

namespace contct::app {

/// Every file that these options may write, behind `others`. Throws std::invalid_argument for names that
/// cannot be theirs.
[[nodiscard]] std::vector<output_option> with_pictures(std::vector<output_option> others,
                                                       const picture_options& options);

/// For --vtu: throws std::invalid_argument where a structure given by its matrix has no coordinates, and
/// warns of pairs that get no cell.
void check_grid_coordinates(const problem& p);

/// The files, open before any work is done, and the observers that fill them.
class run_pictures {
 public:
  /// `options` must outlive this object.
  explicit run_pictures(const picture_options& options);

  /// The observers of a run of `p`; they look at `compared`, which may be null and must observe before them.
  std::vector<observer*> observe(const problem& p, const linear_structure& s, const load_history& loads,
                                 const lockstep* compared, bool forces_by_law);

  /// What was seen. Only after `observe`, and only where a picture was asked for.
  [[nodiscard]] bool wants_frames() const { return kept_.has_value(); }
  [[nodiscard]] const frame_keeper& kept() const { return *kept_; }
  [[nodiscard]] const run_record& record() const { return *record_; }

  /// Write and name all files; `r` is asked for only where there is something to draw.
  void finish(const std::function<finished_run()>& r);

 private:
  void finish_vtu(const finished_run& r);

  const picture_options& options_;
  std::unique_ptr<output_file> html_, svg_, csv_, csv_pairs_, vtu_, pvd_;
  std::optional<frame_keeper> kept_;
  std::optional<run_record> record_;
  std::optional<run_csv> tables_;
};

}  // namespace contct::app
