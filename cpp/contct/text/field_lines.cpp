#include "contct/text/field_lines.hpp"

#include <algorithm>
#include <cmath>

namespace contct::text {
namespace {

/// from_chars takes no plus sign.
std::string_view without_plus(std::string_view number) {
  const bool plus = number.size() > 1 && number[0] == '+' && number[1] != '-';
  return plus ? number.substr(1) : number;
}

std::string with_e_for_d(std::string_view number) {
  std::string text(number);
  for (char& c : text)
    if (c == 'd' || c == 'D') c = 'e';
  return text;
}

}  // namespace

bool text_lines::next() {
  here_ = {};
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  ended_ = end != std::string_view::npos;
  here_ = rest_.substr(0, end);
  rest_.remove_prefix(ended_ ? end + 1 : rest_.size());
  ++line_;
  return true;
}

int text_lines::whole(std::string_view field, std::int64_t least, std::int64_t most,
                      std::string_view what) const {
  const auto value = number_in<std::int64_t>(without_plus(field));
  if (!value || *value < least || *value > most)
    refuse(in_quotes(field).append(" for ").append(what),
           "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(*value);
}

double text_lines::real(std::string_view field, std::string_view what, bool fortran) const {
  auto value = number_in<double>(without_plus(field));
  if (!value && fortran) value = number_in<double>(with_e_for_d(without_plus(field)));
  if (!value || !std::isfinite(*value))
    refuse(in_quotes(field).append(" for ").append(what),
           "a finite number within the range of double precision, as 1.5 or -2e-3");
  return *value;
}

void text_lines::refuse(std::string_view found, std::string_view allowed) const {
  refuse_line(file_, line_, found, allowed);
}

void text_lines::refuse_unended() const {
  if (!ended_)
    refuse(in_quotes(here_) + " without a line's end: the file may be cut short", "a line's end behind it");
}

bool field_lines::next() {
  do {
    if (!text_lines::next()) {
      count_ = 0;
      return false;
    }
    split();
  } while (count_ == 0);
  refuse_unended();
  return true;
}

void field_lines::split() {
  count_ = 0;
  const std::string_view line = here();
  std::size_t at = line.find_first_not_of(blanks);
  while (at != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    if (count_ == most_fields) {
      ++count_;
      return;
    }
    fields_[count_++] = line.substr(at, end - at);
    at = line.find_first_not_of(blanks, end);
  }
}

void field_lines::expect(std::size_t fields, std::string_view allowed) const {
  if (count_ != fields) refuse(in_quotes(here()), allowed);
}

}  // namespace contct::text
