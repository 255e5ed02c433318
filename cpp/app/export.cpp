// contct export: a problem for another program.
#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/outputs.hpp"
#include "app/problem_progress.hpp"
#include "contct/write/calculix_deck.hpp"

namespace contct::app {
exit_status run_command(const export_options& options) {
  const output_option output = {"--calculix", options.calculix};
  refuse_shared_outputs({output}, {{"the problem", options.file}});
  const problem p = read_with_progress(options.file, false);
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

}  // namespace contct::app
