// The commands new, kernels, exact and prove.
#include "app/commands.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "app/problem_runs.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/number/probe.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/outputs.hpp"

namespace contct {

// Generated from reference/cookbook by embed.cmake.
extern const std::string_view beam_toml, plate_toml, crane_toml, slab_toml, base_plate_toml, racks_toml,
    rail_toml, bed_toml, matrix_toml, matrix_mtx, matrix_dof, matrix_xyz;

namespace {

namespace fs = std::filesystem;

struct cookbook_file {
  std::string_view name, text;
};

/// A problem of the cookbook: files[0], and the files that it names.
struct recipe {
  std::string_view kind, what;
  std::vector<cookbook_file> files;
};

std::vector<recipe> recipes() {
  return {
      {"beam", "a beam over two one-sided supports; every key is explained", {{"beam.toml", beam_toml}}},
      {"plate", "a plate on the ground, with a stop; every key is explained", {{"plate.toml", plate_toml}}},
      {"crane", "a crane runway that lifts off its last bracket", {{"crane.toml", crane_toml}}},
      {"slab", "a strip of a slab on soil, under an axle", {{"slab.toml", slab_toml}}},
      {"base-plate", "a column's base plate on grout, with bolts", {{"base-plate.toml", base_plate_toml}}},
      {"racks", "a pipe over racks, with a nozzle that rises", {{"racks.toml", racks_toml}}},
      {"rail", "a rail on sleepers that cannot pull, under a wheel", {{"rail.toml", rail_toml}}},
      {"bed", "a footing on soil, under an eccentric load", {{"bed.toml", bed_toml}}},
      {"matrix",
       "a grillage, given by a stiffness matrix from another program",
       {{"matrix.toml", matrix_toml},
        {"matrix.mtx", matrix_mtx},
        {"matrix.dof", matrix_dof},
        {"matrix.xyz", matrix_xyz}}},
  };
}

recipe recipe_of(const std::string& kind) {
  std::vector<std::string> kinds;
  for (const recipe& r : recipes()) {
    if (r.kind == kind) return r;
    kinds.emplace_back(r.kind);
  }
  throw std::invalid_argument(
      fmt::format("KIND: found {}{}; allowed: {}", kind, did_you_mean(kind, kinds), joined(kinds, ", ")));
}

void list_recipes() {
  print_text("contct new KIND writes a commented problem file to start from. The kinds are:\n");
  for (const recipe& r : recipes()) print_text(fmt::format("  {:<12}{}\n", r.kind, r.what));
}

/// Throws std::invalid_argument if `file` exists, even as a link without a target.
void refuse_taken(const std::string& file) {
  std::error_code ignored;
  const auto kind = fs::symlink_status(file, ignored).type();
  if (kind == fs::file_type::not_found || kind == fs::file_type::none) return;
  throw std::invalid_argument("FILE: found " + file +
                              ", which exists already; allowed: a new name, or - for standard output");
}

constexpr const char* python =
    "/usr/bin/python3";  // Debian's packages of Capstone and Z3 are for this interpreter

/// The folder of the Python package contct_prove: the program's own folder in a build tree, otherwise the
/// folder in which contct.py is installed.
fs::path folder_of_prover(const fs::path& program) {
  for (const char* from_here : {".", CONTCT_INSTALLED_PYTHON, "../lib/python3/dist-packages"}) {
    fs::path folder = (program.parent_path() / from_here).lexically_normal();
    if (fs::exists(folder / "contct_prove")) return folder;
  }
  throw std::runtime_error("the prover is not installed: found no contct_prove next to " + program.string() +
                           "; install the package python3-contct");
}

}  // namespace

/// Writes a problem file of the cookbook and, to the same folder, the files that the problem names.
exit_status run_command(const new_options& options) {
  if (options.kind.empty()) {
    list_recipes();
    return exit_status::bad_input;
  }
  const recipe wanted = recipe_of(options.kind);
  const std::string file = options.file.empty() ? std::string(wanted.files[0].name) : options.file;
  if (file == "-") {
    write_file(file, wanted.files[0].text);
    return exit_status::solved;
  }
  std::vector<std::string> places = {file};
  for (const cookbook_file& f : std::span(wanted.files).subspan(1))
    places.push_back((fs::path(file).parent_path() / f.name).string());
  for (const std::string& place : places) refuse_taken(place);
  for (std::size_t i = 0; i < places.size(); ++i) write_file(places[i], wanted.files[i].text);
  print_text(fmt::format("{} {} written; next: contct run {} --strict --html report.html\n",
                         joined(places, ", "), places.size() == 1 ? "is" : "are", file));
  return exit_status::solved;
}

exit_status run_command(const kernels_options& /*options*/) {
  print_text(fmt::format("{:<12} {:<8} {:<9} {:<11} {}\n", "kernel", "REAL", "rule", "language", "compiler"));
  for (const std::string& name : kernel_names()) {
    const kernel_facts f = facts_of_kernel(name);
    print_text(fmt::format("{:<12} {} bytes  {:<9} {:<11} {}\n", f.name, f.real_bytes,
                           f.rule == contact_rule::listing ? "1989" : name_of(f.rule), f.language,
                           f.compiler));
  }
  print_text(
      fmt::format("\nexternal kernels: plugin:LIBRARY (a shared library), pipe:COMMAND (calls as text)\n"));
  print_text(fmt::format("listing sha256 {}\nfloating point: {}\n", CONTCT_LISTING_SHA256,
                         describe(probe_floating_point())));
  return exit_status::solved;
}

/// Prints the path in rational arithmetic, and the number of correct digits of each kernel.
exit_status run_command(const exact_options& options) {
  for (const std::string& name : options.kernels) (void)facts_of_kernel(name);
  const std::vector<output_option> outputs = {{"--json", options.json}};
  const problem p = read_with_warnings(options, outputs);
  const output_files files(outputs);
  progress path_shown(static_cast<std::int64_t>(p.steps.size()), "steps", options.quiet);
  const exact_progress tell = [&](int step, int increment, const rational& fraction) {
    path_shown.say(fmt::format("step {} of {}, increment {}, {:.0f} % of the step's load", step,
                               p.steps.size(), increment, 100.0 * rounded(fraction)));
  };
  path_progress kernels_shown(p.steps.size(), options.quiet);
  const exact_run run = run_exactly(p, {options.file, options.rule, options.kernels}, tell, &kernels_shown);
  path_shown.erase();
  kernels_shown.line.erase();
  const exact_path& path = run.path;
  if (!options.quiet && !takes_standard_output(outputs))
    print_text(exact_text(run, options.digits, look_at_terminal()));
  flush_standard_output();
  if (output_file* const file = files["--json"]) write_exact_json(run, *file);
  for (std::size_t i = 0; i < path.steps.size(); ++i) {
    const exact_step_end& s = path.steps[i];
    if (s.status == path_status::solved) continue;
    complain("{}: {}, at share {} of its load: {}", whole_line(options.file),
             step_words(p, static_cast<int>(i) + 1), short_words(s.fraction, options.digits),
             s.status == path_status::mechanism ? "no equilibrium"
             : s.status == path_status::path_ended
                 ? "the path of the 1989 rule ended: nothing held the structure"
                 : "the limit of increments is reached");
  }
  return status_of(path.status);
}

exit_status run_command(const prove_options& options) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const std::string folder = folder_of_prover(program);
  const std::string library = options.library.empty() ? program.string() : options.library;
  std::array<std::string, 7> words = {python, "-P",   "-m", "contct_prove", "--symbol=" + options.symbol,
                                      "--",   library};
  std::array<char*, words.size() + 1> arguments{};
  std::ranges::transform(words, arguments.begin(), [](std::string& word) { return word.data(); });
  flush_standard_output();
  (void)setenv("PYTHONPATH", folder.c_str(), 1);
  execv(python, arguments.data());
  throw std::system_error(errno, std::generic_category(), std::string("cannot run ") + python);
}

}  // namespace contct
