// contct atlas: where the 1989 code goes wrong, measured on random problems.
#include "contct/lab/atlas.hpp"

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/outputs.hpp"
#include "app/progress.hpp"

namespace contct::app {
namespace {

atlas measured(const atlas_request& r, bool quiet) {
  atlas a{r, atlas_cells()};
  progress shown(static_cast<long>(a.cells.size()) * r.problems, "problems", quiet);
  for (atlas_cell& c : a.cells) fill(c, r, [&shown] { shown.one_more(); });
  return a;
}

}  // namespace

exit_status run_command(const atlas_options& options) {
  using writer = std::string (*)(const atlas&);
  const std::vector<output_option> outputs = {
      {"--csv", options.csv}, {"--json", options.json}, {"--svg", options.svg}};
  constexpr writer writers[] = {atlas_csv, atlas_json, atlas_svg};
  refuse_shared_outputs(outputs);
  std::vector<std::unique_ptr<output_file>> files;
  files.reserve(outputs.size());
  for (const output_option& o : outputs) files.push_back(open_output(o));

  const atlas a = measured(options.request, options.quiet);
  if (!options.quiet && !takes_standard_output(outputs)) fmt::print("{}", atlas_table(a, look_at_terminal()));
  flush_standard_output();  // no files when the table is lost
  for (std::size_t i = 0; i < files.size(); ++i)
    if (files[i]) write_whole(files[i], writers[i](a));
  return exit_status::solved;
}

}  // namespace contct::app
