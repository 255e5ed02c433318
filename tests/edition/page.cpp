// The parallel edition as pages.
#include <algorithm>

#include "edition/edition.hpp"

namespace contct_test {
namespace {

/// Lines of a source, numbered, moved to the left as far as they go together.
std::string numbered(const std::vector<std::string>& all, const std::vector<int>& wanted) {
  std::size_t indent = std::string::npos;
  for (const int n : wanted) {
    const std::string& line = all[static_cast<std::size_t>(n - 1)];
    indent = std::min(indent, line.find_first_not_of(' '));
  }
  std::string text;
  for (const int n : wanted) {
    const std::string number = std::to_string(n);
    text += std::string(3 - std::min<std::size_t>(3, number.size()), ' ') + number + "  " +
            all[static_cast<std::size_t>(n - 1)].substr(indent) + "\n";
  }
  return text;
}

/// Fixed form keeps its columns: labels stand before column 6.
std::string listing_code(const edition_part& p, const sources& s) {
  const std::vector<std::string> all = s.lines_of(listing_file);
  std::string text;
  for (const int n : p.listing) text += std::to_string(n) + " " + all[static_cast<std::size_t>(n - 1)] + "\n";
  return text;
}

std::string cpp_code(const cited_block& b, const sources& s) {
  const int first = s.places_of(b).front();
  std::vector<int> wanted;
  for (int i = 0; i < static_cast<int>(b.lines.size()); ++i) wanted.push_back(first + i);
  return numbered(s.lines_of(b.file), wanted);
}

/// "Step 4: no response", "The door".
std::string heading(const edition_part& p) {
  return p.step.empty() ? p.title : "Step " + p.step + ": " + p.title;
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char ch : text) {
    if (ch == '&') {
      safe += "&amp;";
    } else if (ch == '<') {
      safe += "&lt;";
    } else if (ch == '>') {
      safe += "&gt;";
    } else {
      safe += ch;
    }
  }
  return safe;
}

/// In Markdown a star and an underscore mean something.
std::string plain(const std::string& text) {
  std::string safe;
  for (const char ch : text) {
    if (ch == '*' || ch == '_' || ch == '<') safe += '\\';
    safe += ch;
  }
  return safe;
}

/// Without line ends at either end.
std::string trimmed(const std::string& text) {
  const std::size_t from = text.find_first_not_of('\n');
  return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of('\n') - from + 1);
}

}  // namespace

std::string markdown_page(const edition& e, const sources& s) {
  std::string page = "# The parallel edition\n\n" + trimmed(e.introduction) +
                     "\n\nMade from `reference/parallel-edition.toml` and the sources, not by hand:\n\n"
                     "```sh\nbuild/release/tests/contct_edition --page reference/parallel-edition.md --html "
                     "reference/parallel-edition.html\n```\n";
  for (const edition_part& p : e.parts) {
    page += "\n## " + plain(heading(p)) + "\n\n> " + plain(p.paper);
    if (!p.equation.empty()) page += " **Eq. " + p.equation + "**";
    page += "\n\n<table>\n<tr><th>FORTRAN, <code>" + std::string(listing_file) +
            "</code></th><th>C++</th></tr>\n";
    page +=
        "<tr><td valign=\"top\">\n\n```fortran\n" + listing_code(p, s) + "```\n\n</td><td valign=\"top\">\n";
    for (const cited_block& b : p.cpp) page += "\n`" + b.file + "`\n\n```cpp\n" + cpp_code(b, s) + "```\n";
    page += "\n</td></tr>\n</table>\n\n" + plain(p.note) + "\n";
  }
  return page;
}

std::string html_fragment(const edition& e, const sources& s) {
  std::string page = "<section class=\"parallel-edition\">\n<h2>The parallel edition</h2>\n<p>" +
                     escaped(trimmed(e.introduction)) + "</p>\n";
  for (const edition_part& p : e.parts) {
    page += "<h3>" + escaped(heading(p)) + "</h3>\n<blockquote>" + escaped(p.paper);
    if (!p.equation.empty()) page += " <b>Eq. " + escaped(p.equation) + "</b>";
    page += "</blockquote>\n<table>\n<tr><th>FORTRAN, <code>" + std::string(listing_file) +
            "</code></th><th>C++</th></tr>\n<tr><td><pre>" + escaped(listing_code(p, s)) +
            "</pre></td>\n<td>";
    for (const cited_block& b : p.cpp)
      page += "<p><code>" + escaped(b.file) + "</code></p>\n<pre>" + escaped(cpp_code(b, s)) + "</pre>\n";
    page += "</td></tr>\n</table>\n<p>" + escaped(p.note) + "</p>\n";
  }
  return page + "</section>\n";
}

/// The section, between these, is what the page of a run embeds.
std::string html_page(const edition& e, const sources& s) {
  return R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>CONTCT: the parallel edition</title>
<style>
body { margin: 0 auto; max-width: 84rem; padding: 1rem clamp(0.8rem, 3vw, 2rem) 3rem; line-height: 1.5;
  font-family: system-ui, "Helvetica Neue", "Noto Sans", "DejaVu Sans", sans-serif; overflow-wrap: anywhere; }
p, blockquote { max-width: 46rem; }
blockquote { margin: 0.3rem 0; padding-left: 0.8rem; border-left: 3px solid gray; }
h3 { margin: 2rem 0 0.3rem; }
table { width: 100%; table-layout: fixed; border-collapse: collapse; }
th, td { vertical-align: top; text-align: left; padding: 0 0.6rem 0 0; }
pre { overflow-x: auto; margin: 0.2rem 0 0.6rem; padding: 0.5rem; border: 1px solid gray; border-radius: 0.3rem;
  font-size: 0.8rem; overflow-wrap: normal; }
@media (max-width: 56rem) { table, tbody, tr, th, td { display: block; padding: 0; } th + th { display: none; } }
@media print { pre { white-space: pre-wrap; } h3 { break-after: avoid; } }
</style>
</head>
<body>
<h1>CONTCT: the listing of 1989 and the C++ beside it</h1>
)" + html_fragment(e, s) +
         "</body>\n</html>\n";
}

}  // namespace contct_test
