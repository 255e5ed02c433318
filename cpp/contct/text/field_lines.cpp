#include "contct/text/field_lines.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "contct/text/input_text.hpp"

namespace contct {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

/// from_chars takes no plus sign.
std::string_view without_plus(std::string_view number) {
  const bool plus = number.size() > 1 && number[0] == '+' && number[1] != '-';
  return plus ? number.substr(1) : number;
}

}  // namespace

void refuse_line(std::string_view file, std::int64_t line, std::string_view found, std::string_view allowed) {
  throw input_error(fmt::format("{}{}: found {}; allowed: {}", file, line > 0 ? fmt::format(":{}", line) : "",
                                found, allowed));
}

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::size_t end = std::min(text.size(), longest);
  while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  std::string safe = "\"";
  for (const char ch : text.substr(0, end))
    safe += static_cast<unsigned char>(ch) < 32 || ch == 127 ? '?' : ch;
  return safe + (end < text.size() ? "...\"" : "\"");
}

bool field_lines::next() {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    here_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
    split();
    if (count_ > 0 && end == std::string_view::npos)
      refuse(quoted(here_) + " without a line's end: the file may be cut short", "a line's end behind it");
    if (count_ > 0) return true;
  }
  here_ = {};
  count_ = 0;
  return false;
}

void field_lines::split() {
  count_ = 0;
  std::size_t at = here_.find_first_not_of(blanks);
  while (at != std::string_view::npos) {
    const std::size_t end = std::min(here_.find_first_of(blanks, at), here_.size());
    if (count_ == most_fields) {
      ++count_;
      return;
    }
    fields_[count_++] = here_.substr(at, end - at);
    at = here_.find_first_not_of(blanks, end);
  }
}

int field_lines::whole(std::size_t i, std::int64_t least, std::int64_t most, std::string_view what) const {
  const std::string_view text = without_plus(fields_[i]);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < least || value > most)
    refuse(fmt::format("{} for {}", quoted(fields_[i]), what),
           fmt::format("a whole number from {} to {}", least, most));
  return static_cast<int>(value);
}

double field_lines::real(std::size_t i, std::string_view what) const {
  const std::string_view text = without_plus(fields_[i]);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    refuse(fmt::format("{} for {}", quoted(fields_[i]), what),
           "a finite number within the range of double precision, as 1.5 or -2e-3");
  return value;
}

void field_lines::expect(std::size_t fields, std::string_view allowed) const {
  if (count_ != fields) refuse(quoted(here_), allowed);
}

void field_lines::refuse(std::string_view found, std::string_view allowed) const {
  refuse_line(file_, line_, found, allowed);
}

}  // namespace contct
