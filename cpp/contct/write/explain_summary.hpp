// The summary of an explained run of many increments: a line for each.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "contct/compare/explanation.hpp"
#include "contct/text/terminal.hpp"

namespace contct::write {

/// Collects lines; the caller prints them as often as it likes, so that memory need not grow with their
/// number.
class explain_summary {
 public:
  /// `title` is the problem's; it may be empty.
  explain_summary(const terminal& t, std::string title) : terminal_(t), title_(std::move(title)) {}

  /// Add the line of an increment: its number, its share of the step, its events and which were too early.
  void add(const explained_increment& i);

  /// The lines since the last call; before the first of all, the title and the names of the columns.
  [[nodiscard]] std::string take();

  /// What stands below the last line: how many there are, and how to explain one of them.
  [[nodiscard]] std::string end() const;

 private:
  terminal terminal_;
  std::string title_, lines_;
  bool headed_ = false;
  std::int64_t increments_ = 0;
};

}  // namespace contct::write
