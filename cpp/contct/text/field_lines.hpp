// Text files of lines that hold a few numbers each: where every mistake is told with file and line.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace contct {

/// Goes through a text line by line; blanks and tabs part the fields of a line, and blank lines are passed
/// by. A last line without an end is refused: a number cut in its middle is a number too. Linear in the text.
/// Refusals are input_errors: "K.mtx:12: found ...; allowed: ...".
class field_lines {
 public:
  /// `text` and `file`, its name for messages, must outlive this object.
  field_lines(std::string_view text, std::string_view file) : rest_(text), file_(file) {}

  /// Go to the next line that is not blank; false when there is none.
  bool next();

  [[nodiscard]] std::int64_t line() const { return line_; }  ///< of the file, from 1
  [[nodiscard]] std::string_view whole_line() const { return here_; }
  /// How many fields the line has; more than `most_fields` count as one more than these.
  [[nodiscard]] std::size_t fields() const { return count_; }
  [[nodiscard]] std::string_view field(std::size_t i) const { return fields_[i]; }
  /// Bytes that are still to be read: no file has more entries than that.
  [[nodiscard]] std::size_t bytes_left() const { return rest_.size(); }

  /// Field `i` (from 0) as a whole number, or as a finite real; `what` it is, for messages.
  [[nodiscard]] int whole(std::size_t i, std::int64_t least, std::int64_t most, std::string_view what) const;
  [[nodiscard]] double real(std::size_t i, std::string_view what) const;

  /// Refuse the line when it has another number of fields.
  void expect(std::size_t fields, std::string_view allowed) const;

  [[noreturn]] void refuse(std::string_view found, std::string_view allowed) const;

  static constexpr std::size_t most_fields = 8;

 private:
  void split();

  std::string_view rest_, file_, here_;
  std::int64_t line_ = 0;
  std::array<std::string_view, most_fields> fields_;
  std::size_t count_ = 0;
};

/// Refuse a file at a line (from 1; 0 when it is none in particular).
[[noreturn]] void refuse_line(std::string_view file, std::int64_t line, std::string_view found,
                              std::string_view allowed);

/// Text from a file, fit for a message: in quotes, without control characters, and cut.
[[nodiscard]] std::string quoted(std::string_view text);

}  // namespace contct
