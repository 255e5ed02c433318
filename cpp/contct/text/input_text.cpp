#include "contct/text/input_text.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

namespace contct {
namespace {

/// Removes a plus sign at the start, which std::from_chars does not accept.
std::string_view without_plus(std::string_view number) {
  const bool plus = number.size() > 1 && number[0] == '+' && number[1] != '-';
  return plus ? number.substr(1) : number;
}

}  // namespace

void refuse_line(std::string_view file, std::int64_t line, std::string_view found, std::string_view allowed) {
  std::string message(file);
  if (line > 0) message += ":" + std::to_string(line);
  throw input_error(message.append(": found ").append(found).append("; allowed: ").append(allowed));
}

std::string read_input(const std::string& path, const std::string& kind, std::size_t most_mib) {
  const bool standard = path == "-";
  const std::string name = standard ? "standard input" : path;
  std::error_code ignored;
  if (!standard && std::filesystem::is_directory(path, ignored))
    refuse_line(name, 0, "a directory", "a " + kind);
  const auto close = [](std::FILE* f) { return f == stdin ? 0 : std::fclose(f); };
  const std::unique_ptr<std::FILE, decltype(close)> file(standard ? stdin : std::fopen(path.c_str(), "rb"));
  if (!file) throw input_error(name + ": cannot be read: " + std::strerror(errno));
  std::string text;
  char block[1 << 16];
  std::size_t got = 0;
  while ((got = std::fread(block, 1, sizeof block, file.get())) > 0) {
    text.append(block, got);
    if (text.size() >> 20 >= most_mib)
      refuse_line(name, 0, std::to_string(most_mib) + " MiB or more",
                  "a " + kind + " of less than " + std::to_string(most_mib) + " MiB");
  }
  if (std::ferror(file.get()) != 0) throw input_error(name + ": cannot be read to its end");
  if (text.starts_with("\xEF\xBB\xBF") && kind != "trace")
    text.erase(0, 3);  // no trace has a byte order mark
  return text;
}

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
    refuse(field_words(field).append(" for ").append(what),
           "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(*value);
}

double text_lines::real(std::string_view field, std::string_view what, bool fortran) const {
  constexpr escape exponents[] = {{'d', "e"}, {'D', "e"}};
  auto value = number_in<double>(without_plus(field));
  if (!value && fortran) value = number_in<double>(escaped(without_plus(field), exponents));
  if (!value || !std::isfinite(*value))
    refuse(field_words(field).append(" for ").append(what),
           "a finite number within the range of double precision, such as 1.5 or -2e-3");
  return *value;
}

void text_lines::refuse(std::string_view found, std::string_view allowed) const {
  refuse_line(file_, line_, found, allowed);
}

void text_lines::refuse_unended() const {
  if (!ended_)
    refuse(field_words(here_, "a line") + " without a line end: the file may be cut short",
           "a line end after every line");
}

bool field_lines::next() {
  fields_.clear();
  while (fields_.empty()) {
    if (!text_lines::next()) return false;
    for (std::size_t at = here().find_first_not_of(blanks); at < here().size();) {
      const std::size_t end = std::min(here().find_first_of(blanks, at), here().size());
      fields_.push_back(here().substr(at, end - at));
      at = here().find_first_not_of(blanks, end);
    }
  }
  refuse_unended();
  return true;
}

void field_lines::expect(std::size_t fields, std::string_view allowed) const {
  if (fields_.size() != fields) refuse(field_words(here(), "a line"), allowed);
}

}  // namespace contct
