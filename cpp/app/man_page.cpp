#include "app/man_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "contct/text/strings.hpp"
#include "contct/text/terminal.hpp"

namespace contct::app {
namespace {

constexpr escape prose_escapes[] = {{'\\', "\\e"}, {'-', "\\-"}, {'^', "\\(ha"}, {'~', "\\(ti"}};
// In code, quotes stay those that are typed.
constexpr escape code_escapes[] = {{'\\', "\\e"},  {'-', "\\-"},    {'^', "\\(ha"},
                                   {'~', "\\(ti"}, {'\'', "\\(aq"}, {'`', "\\(ga"}};

/// roff takes a line that begins so for a request.
std::string no_request(const std::string& line) {
  return line.starts_with('.') || line.starts_with('\'') ? "\\&" + line : line;
}

/// The text before `end` in `rest`, which loses both.
std::string_view taken_until(std::string_view& rest, std::string_view end) {
  const std::size_t at = std::min(rest.find(end), rest.size());
  const std::string_view taken = rest.substr(0, at);
  rest.remove_prefix(std::min(at + end.size(), rest.size()));
  return taken;
}

/// Bold text, code spans and links in a paragraph or a cell.
std::string spans(std::string_view rest) {
  std::string out;
  while (!rest.empty()) {
    const std::size_t plain = std::min(rest.find_first_of("`*["), rest.size());
    out += escaped(rest.substr(0, plain), prose_escapes);
    rest.remove_prefix(plain);
    const std::size_t link = rest.find("](");
    if (rest.starts_with('`')) {
      rest.remove_prefix(1);
      out += "\\fB" + escaped(taken_until(rest, "`"), code_escapes) + "\\fR";
    } else if (rest.starts_with("**")) {
      rest.remove_prefix(2);
      out += "\\fB" + spans(taken_until(rest, "**")) + "\\fR";
    } else if (rest.starts_with('[') && link != std::string_view::npos) {
      out += spans(rest.substr(1, link - 1));
      (void)taken_until(rest, ")");
    } else if (!rest.empty()) {
      out += rest.front();
      rest.remove_prefix(1);
    }
  }
  return out;
}

/// Text that roff takes, in lines.
std::string lines_of(const std::string& text) {
  std::string out;
  for (const std::string& line : wrap({text}, 72)) out += no_request(line) + "\n";
  return out;
}

std::string_view trimmed_cell(std::string_view text) {
  const std::size_t from = std::min(text.find_first_not_of(' '), text.size());
  return text.substr(from, text.find_last_not_of(' ') + 1 - from);
}

/// The cells of a table's row, "| a | b |"; a last one need not be closed. A code span may have a bar in it,
/// as \|.
std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells;
  std::string cell;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == '|') {
      cells.emplace_back(trimmed_cell(cell));
      cell.clear();
    } else if (line.substr(i, 2) != "\\|") {
      cell += line[i];
    } else {
      cell += line[++i];
    }
  }
  if (!cell.empty()) cells.emplace_back(trimmed_cell(cell));
  return cells;
}

/// A cell behind the name of its column, up to a comma; alone where its own first word is in that name: under
/// "absent or null", "absent: no pairs".
std::string fact(const std::string& column, const std::string& cell) {
  const std::string name = column.substr(0, column.find(','));
  const bool alone = name.find(cell.substr(0, cell.find_first_of(" :"))) != std::string::npos;
  return (alone ? "" : name + ": ") + spans(cell);
}

/// Goes through Markdown line by line.
class man_writer {
 public:
  void take(std::string_view line) {
    if (in_code_) return take_code(line);
    if (!line.starts_with('|')) columns_.clear();
    if (line.starts_with("```")) return begin_code();
    if (line.starts_with('#')) return take_heading(line);
    if (line.starts_with('|')) return take_row(cells_of(line));
    if (line.empty() || line.starts_with("- ")) end_paragraph();
    if (!line.empty()) paragraph_ += (paragraph_.empty() ? "" : " ") + std::string(trimmed_cell(line));
  }

  [[nodiscard]] std::string finish() {
    end_paragraph();
    return std::move(out_);
  }

 private:
  /// man begins a paragraph behind a heading by itself.
  void begin_paragraph() {
    if (!behind_heading_) out_ += ".PP\n";
    behind_heading_ = false;
  }

  void end_paragraph() {
    if (paragraph_.empty()) return;
    std::string_view text = paragraph_;
    if (text.starts_with("- ")) {
      text.remove_prefix(2);
      out_ += ".IP \\(bu 2\n";
      behind_heading_ = false;
    } else {
      begin_paragraph();
    }
    out_ += lines_of(spans(text));
    paragraph_.clear();
  }

  void take_heading(std::string_view line) {
    end_paragraph();
    const std::size_t level = line.find_first_not_of('#');
    if (level > 1) out_ += (level == 2 ? ".SH " : ".SS ") + spans(line.substr(level + 1)) + "\n";
    behind_heading_ = true;
  }

  void begin_code() {
    end_paragraph();
    begin_paragraph();
    out_ += ".RS 4\n.nf\n";
    in_code_ = true;
  }

  void take_code(std::string_view line) {
    in_code_ = !line.starts_with("```");
    out_ += in_code_ ? no_request(escaped(line, code_escapes)) + "\n" : ".fi\n.RE\n";
  }

  void take_row(std::vector<std::string> cells) {
    end_paragraph();
    if (cells.empty()) return;
    if (columns_.empty()) {
      columns_ = std::move(cells);
      return;
    }
    if (cells.front().starts_with("---")) return;
    out_ += ".TP\n" + no_request(spans(cells.front())) + "\n";
    std::vector<std::string> facts;
    for (std::size_t i = 1; i + 1 < std::min(cells.size(), columns_.size()); ++i)
      if (!cells[i].empty()) facts.push_back(fact(columns_[i], cells[i]));
    if (!facts.empty()) out_ += lines_of(joined(facts, "; "));
    if (!facts.empty() && !cells.back().empty()) out_ += ".br\n";
    if (!cells.back().empty()) out_ += lines_of(spans(cells.back()));
    behind_heading_ = false;
  }

  std::string out_, paragraph_;
  std::vector<std::string> columns_;  // of the table at hand
  bool in_code_ = false;
  bool behind_heading_ = true;  // DESCRIPTION's
};

}  // namespace

std::string roff(std::string_view text) {
  return no_request(escaped(text, prose_escapes));
}

std::string filled(const std::string& text) {
  return lines_of(escaped(text, prose_escapes));
}

std::string page_from_markdown(const format_page& page) {
  std::string title(page.name);
  std::ranges::transform(title, title.begin(), [](unsigned char c) { return std::toupper(c); });
  man_writer writer;
  for (std::string_view rest = page.markdown; !rest.empty();) writer.take(taken_until(rest, "\n"));
  return fmt::format(
      ".TH {} 5 {} \"contct {}\" \"File Formats\"\n"
      ".nh\n.SH NAME\n{} \\- {}\n.SH DESCRIPTION\n{}"
      ".SH SEE ALSO\n.BR contct (1)\n",
      roff(title), CONTCT_DATE, CONTCT_VERSION, roff(page.name), page.summary, writer.finish());
}

}  // namespace contct::app
