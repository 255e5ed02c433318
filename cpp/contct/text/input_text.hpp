// Reads input files: a whole file as text, and a text by lines and fields. Errors name file and line.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "contct/text/strings.hpp"

namespace contct {

/// An error in a file. what() is the whole message, with the position, the text found and the allowed values:
/// "pb.toml:12:3: contact[2].stiffness: found -5; allowed: a number greater than 0".
class input_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws the input_error "file:line: found ...; allowed: ...". Lines count from 1; line 0 is not printed.
[[noreturn]] void refuse_line(std::string_view file, std::int64_t line, std::string_view found,
                              std::string_view allowed);

/// Reads the file at `path`, or standard input for "-". `kind` names the expected file in messages: "problem
/// file". Throws input_error if the file does not exist, is a directory, cannot be read, or has `most_mib` or
/// more. A file with the coordinates of 100,000 nodes has 2 MiB.
[[nodiscard]] std::string read_input(const std::string& path, const std::string& kind = "problem file",
                                     std::size_t most_mib = 32);

/// The characters that separate the fields of a line and are trimmed from its ends.
inline constexpr std::string_view blanks = " \t\r\v\f";

/// Converts all of `text` to a number by std::from_chars, which allows no blanks and no plus sign. Empty if
/// `text` is not one number in the range of the type. `format`: a std::chars_format, for reals.
template <class Number, class... Format>
[[nodiscard]] std::optional<Number> number_in(std::string_view text, Format... format) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, format...);
  return error == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

/// Reads a text line by line. Refusals are input_errors: "K.mtx:12: found ...; allowed: ...".
class text_lines {
 public:
  /// `text` must outlive this object; `file` is its name in messages.
  text_lines(std::string_view text, std::string_view file) : rest_(text), file_(file) {}

  /// Goes to the next line; false if there is none.
  bool next();

  [[nodiscard]] std::string_view here() const { return here_; }  ///< the line without its end
  [[nodiscard]] std::string_view rest() const { return rest_; }  ///< the text after the line
  [[nodiscard]] std::int64_t line() const { return line_; }      ///< from 1; 0 before the first line
  [[nodiscard]] const std::string& file() const { return file_; }

  /// Returns `field` as a whole number, or as a finite real; a plus sign is allowed. Refuses any other field.
  /// `what` describes the number in messages. With `fortran`, a real may have D instead of E.
  [[nodiscard]] int whole(std::string_view field, std::int64_t least, std::int64_t most,
                          std::string_view what) const;
  [[nodiscard]] double real(std::string_view field, std::string_view what, bool fortran = false) const;

  [[noreturn]] void refuse(std::string_view found, std::string_view allowed) const;
  /// Refuses the present line if it has no line end: if it is truncated, its last number may still parse.
  void refuse_unended() const;

 private:
  std::string_view rest_, here_;
  std::string file_;
  std::int64_t line_ = 0;
  bool ended_ = true;
};

/// Reads lines of fields, which the characters in `blanks` separate. Skips blank lines; refuses a last line
/// without a line end. Linear in the text.
class field_lines : public text_lines {
 public:
  using text_lines::text_lines;

  bool next();

  [[nodiscard]] std::size_t fields() const { return fields_.size(); }
  [[nodiscard]] std::string_view field(std::size_t i) const { return fields_[i]; }

  /// Field `i`, from 0, as a number.
  [[nodiscard]] int whole(std::size_t i, std::int64_t least, std::int64_t most, std::string_view what) const {
    return text_lines::whole(field(i), least, most, what);
  }
  [[nodiscard]] double real(std::size_t i, std::string_view what, bool fortran = false) const {
    return text_lines::real(field(i), what, fortran);
  }

  /// Refuses the line if it does not have `fields` fields; `allowed` describes them.
  void expect(std::size_t fields, std::string_view allowed) const;

 private:
  std::vector<std::string_view> fields_;
};

}  // namespace contct
