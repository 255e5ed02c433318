// The run as a table on the terminal, an increment a row.
#pragma once

#include <string>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/path/observer.hpp"
#include "contct/structure/problem.hpp"
#include "contct/text/terminal.hpp"
#include "contct/write/load_text.hpp"

namespace contct::write {

/// A share in at most nine columns, with as many digits as fit. What is less than 1 is never shown as 1,
/// which means the whole load: "1-3e-09".
[[nodiscard]] std::string share_words(double x);

/// Observes a path and prints it as it goes. Place it behind the lockstep and the
/// certifier that it reports on.
class table final : public observer {
 public:
  /// `p` and `judged` must outlive this object, and so must `compared`, which is null for a kernel
  /// alone.
  table(const problem& p, const lockstep* compared, const certifier& judged, const terminal& t);

  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

 private:
  void print_heading();
  [[nodiscard]] std::string agreement() const;
  [[nodiscard]] std::vector<std::string> event_lines(const increment& i) const;

  const problem& problem_;
  load_path loads_;
  const lockstep* compared_;
  const certifier& judged_;
  terminal terminal_;
  int load_width_ = 0;         // 0: no room for loads
  int indent_ = 0;             // of the events
  bool events_below_ = false;  // on a narrow terminal they stand on lines of their own
  bool headed_ = false;
};

}  // namespace contct::write
