// contct new: a commented problem file to start from.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "app/commands.hpp"
#include "app/new_problem.hpp"
#include "app/streams.hpp"
#include "contct/text/did_you_mean.hpp"
#include "contct/text/output_file.hpp"

namespace contct {
namespace {

struct new_options {
  std::string shape, file;
};

const char* problem_of(const std::string& shape) {
  if (shape == "beam") return new_beam;
  if (shape == "plate") return new_plate;
  const std::vector<std::string> known = {"beam", "plate"};
  throw std::invalid_argument("SHAPE: found " + shape + did_you_mean(shape, known) +
                              "; allowed: beam or plate");
}

/// A name that is taken, if only by a link that leads nowhere, is never written to.
void refuse_taken(const std::string& file) {
  std::error_code ignored;
  const auto kind = std::filesystem::symlink_status(file, ignored).type();
  if (kind == std::filesystem::file_type::not_found || kind == std::filesystem::file_type::none) return;
  throw std::invalid_argument("FILE: found " + file +
                              ", which is there already; allowed: a new name, or - for standard output");
}

exit_status write_new(const new_options& options) {
  const char* const text = problem_of(options.shape);
  const std::string file = options.file.empty() ? options.shape + ".toml" : options.file;
  if (file != "-") refuse_taken(file);
  output_file out(file);
  out.write(text);
  out.finish();
  if (file != "-") fmt::print("{} is written; now: contct run {}\n", file, file);
  return exit_status::solved;
}

}  // namespace

void add_new(CLI::App& program, exit_status& status) {
  auto options = std::make_shared<new_options>();
  CLI::App* const command = program.add_subcommand("new", "Write a commented problem file to start from");
  command->add_option("SHAPE", options->shape, "beam or plate")->required();
  command->add_option(
      "FILE", options->file,
      "Where to; by default beam.toml or plate.toml. Nothing is overwritten. - is standard output");
  command->callback([options, &status] { status = write_new(*options); });
}

}  // namespace contct
