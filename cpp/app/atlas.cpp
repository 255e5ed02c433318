// contct atlas: where the 1989 code goes wrong, measured on random problems.
#include "contct/lab/atlas.hpp"

#include <fmt/format.h>

#include <memory>

#include "app/commands.hpp"
#include "app/output_options.hpp"
#include "app/progress.hpp"
#include "contct/lab/atlas_output.hpp"
#include "contct/lab/atlas_svg.hpp"

namespace contct {
namespace {

struct atlas_options {
  atlas_request request;
  std::string csv, json, svg;
  bool quiet = false;
};

atlas measured(const atlas_request& r, bool quiet) {
  atlas a{r, atlas_cells()};
  progress shown(static_cast<long>(a.cells.size()) * r.problems, "problems", quiet);
  for (atlas_cell& c : a.cells) fill(c, r, [&shown] { shown.one_more(); });
  return a;
}

/// CLI11 would take -1 for the largest seed there is.
std::string not_negative(const std::string& number) {
  return number.rfind('-', 0) == 0 ? "found " + number + "; allowed: a whole number, at least 0" : "";
}

exit_status run_atlas(const atlas_options& options) {
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
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (files[i] == nullptr) continue;
    files[i]->write(writers[i](a));
    files[i]->finish();
  }
  return exit_status::solved;
}

}  // namespace

void add_atlas(CLI::App& program, exit_status& status) {
  auto options = std::make_shared<atlas_options>();
  CLI::App* const command =
      program.add_subcommand("atlas", "Where the 1989 code goes wrong, measured on random problems");
  constexpr int most_problems = 1'000'000;
  command
      ->add_option("--problems", options->request.problems,
                   "Problems in each cell; the default takes a minute")
      ->check(CLI::Range(1, most_problems))
      ->capture_default_str();
  command->add_option("--seed", options->request.seed, "Another seed, other problems")
      ->check(not_negative)
      ->capture_default_str();
  command->add_option("--csv", options->csv, "Write the cells to this file (- is standard output)");
  command->add_option("--json", options->json, "Write the cells to this file (- is standard output)");
  command->add_option("--svg", options->svg, "Draw the picture to this file (- is standard output)");
  command->add_flag("--quiet", options->quiet, "Print nothing but what is wrong");
  command->callback([options, &status] { status = run_atlas(*options); });
}

}  // namespace contct
