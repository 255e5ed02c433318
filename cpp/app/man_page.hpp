// Pages for man, in its roff macros: text as roff takes it, and whole pages made of Markdown.
#pragma once

#include <string>
#include <string_view>

namespace contct::app {

/// A word or a line as roff takes it: a hyphen that is typed is a minus, and no line begins a request.
[[nodiscard]] std::string roff(std::string_view text);

/// A paragraph in lines of at most 72 characters.
[[nodiscard]] std::string filled(const std::string& text);

/// A page of section 5.
struct format_page {
  std::string_view name;      ///< "contct-problem"
  std::string_view summary;   ///< a phrase, for NAME
  std::string_view markdown;  ///< its text; see page_from_markdown
};

/// The page in the man macros. Of Markdown it takes headings, paragraphs, lists, code, tables with a header,
/// bold text, code spans and links, of which the text stays. The first heading is the title. A row of a table
/// becomes an entry: its first cell the term, the last one the text, each other one a fact with the
/// name of its column.
[[nodiscard]] std::string page_from_markdown(const format_page& page);

}  // namespace contct::app
