#include "contct/write/finished_run.hpp"

#include <algorithm>
#include <filesystem>

namespace contct::write {

void run_record::called(const answered_call& c) {
  ++all_calls;
  all_log += c.text.size();
  // Whole calls only: a text is never cut in the middle of an event.
  if (log.size() + c.text.size() <= most_log && log.size() + c.text.size() == all_log) log += c.text;
  answers_ = calls.size() < most_calls;
  if (!answers_) return;
  call_record r;
  r.smin = c.c.smin;
  const auto first = c.c.ss.first(std::min(most_ss, c.c.ss.size()));
  r.ss.assign(first.begin(), first.end());
  if (compared_ != nullptr) r.followers = compared_->last_answers();
  calls.push_back(std::move(r));
}

void run_record::incremented(const increment& i) {
  if (answers_) {
    calls.back().step = i.step;
    calls.back().number = i.number;
  }
  answers_ = false;
  if (all_increments++ < most_increments) increments.emplace_back(i);
}

std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char ch) { return ch == '\n' || ch == '\r'; }, ' ');
  return text;
}

std::string title_of(const finished_run& r) {
  const bool named = r.what.title.find_first_not_of(" \t\r\n") != std::string::npos;
  if (named) return on_one_line(r.what.title);
  return r.file == "-" ? "A problem from standard input" : std::filesystem::path(r.file).filename().string();
}

}  // namespace contct::write
