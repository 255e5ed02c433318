// An explained run for people: the lines of the listing in the left margin, the paper's equations at the
// right.
#pragma once

#include <string>
#include <vector>

#include "contct/compare/explained_path.hpp"
#include "contct/structure/problem.hpp"
#include "contct/text/terminal.hpp"
#include "contct/write/explain_words.hpp"
#include "contct/write/load_text.hpp"

namespace contct::write {

/// Prints increments, one at a time.
class explain_text {
 public:
  /// `p` must outlive this object. `names` are those of one kernel or two; `pair` is the only one wanted,
  /// from 1, or 0.
  explain_text(const problem& p, std::vector<std::string> names, int real_bytes, int pair, const terminal& t);

  void print(const explained_increment& i);

 private:
  void print_head();
  void print_load(const explained_increment& i) const;
  void print_pair(const explained_increment& i, const explained_pair& p) const;
  void print_winner(const explained_increment& i) const;
  void print_toggles(const explained_increment& i) const;
  void print_outcome(const explained_increment& i) const;
  void say(paint p, const std::string& words) const;
  void say(const sentence& t, bool loud = false) const;
  [[nodiscard]] bool wants(const explained_pair& p) const { return pair_ == 0 || pair_ == p.pair + 1; }

  const problem& problem_;
  load_path loads_;
  std::vector<std::string> names_;
  int real_bytes_;
  int pair_;
  terminal terminal_;
  bool shows_statements_;
  bool begun_ = false;
};

}  // namespace contct::write
