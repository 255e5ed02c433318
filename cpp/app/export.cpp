// contct export: a problem for another program.
#include <fmt/format.h>

#include <memory>

#include "app/commands.hpp"
#include "app/output_options.hpp"
#include "app/read_problem.hpp"
#include "app/streams.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/write/calculix_deck.hpp"

namespace contct {
namespace {

constexpr int most_refinement = 64;

struct export_options {
  std::string file;
  std::string calculix;
  calculix_choice choice;
};

exit_status run_export(const export_options& options) {
  const output_option output = {"--calculix", options.calculix};
  refuse_shared_outputs({output}, {{"the problem", options.file}});
  const problem p = read_as_one_waits(options.file, false);
  for (const std::string& w : p.warnings) complain("warning: {}", w);
  const calculix_deck deck = calculix_deck_of(p, options.choice);
  const std::unique_ptr<output_file> file = open_output(output);
  file->write(deck.text);
  if (!file->is_standard_output()) {
    fmt::print("{}: step {} of {}, {} elements, {} nodes, {} pairs\n", options.calculix, deck.step,
               p.steps.size(), deck.elements, deck.nodes, p.pairs.size());
    fmt::print("displacements are {:.12e} times the problem's, forces {:.12e} times\n",
               deck.displacement_scale, deck.force_scale);
  }
  flush_standard_output();
  file->finish();
  return exit_status::solved;
}

}  // namespace

void add_export(CLI::App& program, exit_status& status) {
  auto options = std::make_shared<export_options>();
  CLI::App* const command =
      program.add_subcommand("export", "Write a beam or a plate for another program, CalculiX");
  command->add_option("FILE", options->file, "The problem (TOML); - reads standard input")->required();
  command
      ->add_option("--calculix", options->calculix,
                   "Write CalculiX's input to this file, JOB.inp (- is standard output)")
      ->required();
  command->add_option("--step", options->choice.step, "The load step whose end it is [the last]")
      ->check(CLI::Range(1, 1'000'000'000));
  command
      ->add_option("--refine", options->choice.refine, "Elements for each of the problem's, along each side")
      ->check(CLI::Range(1, most_refinement))
      ->capture_default_str();
  command
      ->add_option("--slenderness", options->choice.slenderness, "The structure's length over its thickness")
      ->check(CLI::Range(10.0, 10'000.0))
      ->capture_default_str();
  command->callback([options, &status] { status = run_export(*options); });
}

}  // namespace contct
