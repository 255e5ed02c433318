// An explained run as JSON, format "contct-explain-1" (reference/explain-format.md).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contct/compare/explained_path.hpp"
#include "contct/structure/problem.hpp"
#include "contct/text/output_file.hpp"
#include "contct/write/json_document.hpp"
#include "contct/write/load_text.hpp"

namespace contct::write {

/// Writes increments as they come: memory does not grow with them. The file appears with `finish`.
class explain_json {
 public:
  /// `p` and `out` must outlive this object. `pair` is the only one wanted, from 1, or 0.
  explain_json(const problem& p, std::vector<std::string> names, int real_bytes, int pair, output_file& out);

  void write(const explained_increment& i);

  /// Close the document.
  void finish(std::string_view status, const explained_path& path);

 private:
  const problem& problem_;
  load_path loads_;
  std::vector<std::string> names_;
  int real_bytes_;
  int pair_;
  json_document document_;
};

}  // namespace contct::write
