// The run as a table on the terminal, an increment a row.
#pragma once

#include <string>

#include "contct/check/lockstep.hpp"
#include "contct/io/load_text.hpp"
#include "contct/io/problem.hpp"
#include "contct/io/terminal.hpp"
#include "contct/path/observer.hpp"

namespace contct {

/// Observes a path and prints it as it goes. Place it behind the lockstep that it reports on.
class table final : public observer {
 public:
  /// `p` must outlive this object, and so must `compared`, which is null for a kernel alone.
  table(const problem& p, const lockstep* compared, const terminal& t);

  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

 private:
  void print_heading();
  [[nodiscard]] std::string agreement() const;
  [[nodiscard]] std::string event_words(const event& e) const;

  const problem& problem_;
  load_path loads_;
  const lockstep* compared_;
  terminal terminal_;
  int load_width_;
  int events_width_;
  bool headed_ = false;
};

}  // namespace contct
