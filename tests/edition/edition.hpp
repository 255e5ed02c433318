// The parallel edition: the listing and the C++ that does its work, as data.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace contct_test {

/// A block of lines in a source of ours.
struct cited_block {
  std::string file;                ///< from the root
  std::vector<std::string> lines;  ///< as the map quotes them, without indentation
};

/// A stretch of the algorithm.
struct edition_part {
  std::string step, title, paper, equation, note;
  std::vector<int> listing;  ///< lines of fortran/contct.f, from 1
  std::vector<cited_block> cpp;
};

struct edition {
  std::string introduction;
  std::vector<edition_part> parts;
};

/// Read the map. Throws contct::app::input_error.
[[nodiscard]] edition read_edition(const std::filesystem::path& map);

/// The sources that an edition quotes.
class sources {
 public:
  explicit sources(std::filesystem::path root) : root_(std::move(root)) {}

  /// The lines of a file; empty where there is none.
  [[nodiscard]] std::vector<std::string> lines_of(const std::string& file) const;
  /// Where in its file a block stands, the first line of each place, from 1.
  [[nodiscard]] std::vector<int> places_of(const cited_block& b) const;

 private:
  std::filesystem::path root_;
};

inline const char* const listing_file = "fortran/contct.f";

/// All that is wrong with an edition: lines of the listing that are left out, are there twice, or are
/// comments; blocks that stand nowhere, or in more than one place. Empty when nothing is.
[[nodiscard]] std::vector<std::string> faults_of(const edition& e, const sources& s);

/// The edition as a page. It must have no faults.
[[nodiscard]] std::string markdown_page(const edition& e, const sources& s);
/// The same as a fragment of HTML, for a page with its own head: one <section class="parallel-edition">.
[[nodiscard]] std::string html_fragment(const edition& e, const sources& s);
/// That section as a page of its own.
[[nodiscard]] std::string html_page(const edition& e, const sources& s);

}  // namespace contct_test
