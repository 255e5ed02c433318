// The commands new, kernels, exact and prove.
#include "app/commands.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <system_error>

#include "app/problem_runs.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/number/probe.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/outputs.hpp"

namespace contct {

using embedded_file = std::pair<std::string_view, std::string_view>;  // name and text
/// The files of reference/cookbook; see embed.cmake.
extern const std::span<const embedded_file> cookbook_files;

namespace {

namespace fs = std::filesystem;

/// A problem of the cookbook, and the first sentence of its file. Its files are named KIND: first KIND.toml,
/// then the files that it names.
struct recipe {
  std::string kind, what;
};

std::vector<recipe> recipes() {
  std::vector<recipe> all;
  for (const auto& [name, text] : cookbook_files)
    if (const fs::path file = name; file.extension() == ".toml")
      all.push_back({file.stem(), std::string(text.substr(2, text.find(". ") - 2))});
  return all;
}

/// The files of a kind. Throws std::invalid_argument if there is no such kind.
std::vector<embedded_file> files_of(const std::string& kind) {
  std::vector<embedded_file> files;
  for (const embedded_file& f : cookbook_files)
    if (fs::path(f.first).stem() == kind) files.push_back(f);
  if (!files.empty()) return files;
  std::vector<std::string> kinds;
  for (const recipe& r : recipes()) kinds.push_back(r.kind);
  throw std::invalid_argument(
      fmt::format("KIND: found {}{}; allowed: {}", kind, did_you_mean(kind, kinds), joined(kinds, ", ")));
}

/// Throws std::invalid_argument if `file` exists, even as a link without a target. "-" is standard output.
void refuse_taken(const std::string& file) {
  if (file == "-") return;
  std::error_code ignored;
  const auto kind = fs::symlink_status(file, ignored).type();
  if (kind == fs::file_type::not_found || kind == fs::file_type::none) return;
  throw std::invalid_argument("FILE: found " + file +
                              ", which exists already; allowed: a new name, or - for standard output");
}

constexpr const char* python =
    "/usr/bin/python3";  // Debian's packages of Capstone and Z3 are for this interpreter

}  // namespace

/// Writes a problem file of the cookbook and, to the same folder, the files that the problem names.
exit_status run_command(const new_options& options) {
  if (options.kind.empty()) {
    print_text("contct new KIND writes a commented problem file to start from. The kinds are:\n");
    for (const recipe& r : recipes()) print_text(fmt::format("  {:<12}{}\n", r.kind, r.what));
    return exit_status::bad_input;
  }
  std::vector<embedded_file> files = files_of(options.kind);
  const std::string file = options.file.empty() ? std::string(files[0].first) : options.file;
  if (file == "-") files.resize(1);
  std::vector<std::string> places = {file};
  for (const auto& [name, text] : std::span(files).subspan(1))
    places.push_back((fs::path(file).parent_path() / name).string());
  for (const std::string& place : places) refuse_taken(place);
  for (std::size_t i = 0; i < places.size(); ++i) write_file(places[i], files[i].second);
  if (file != "-")
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
  path_progress shown(p.steps.size(), options.quiet);
  const exact_progress tell = [&](int step, int increment, const rational& fraction) {
    shown.reached(step, increment, rounded(fraction));
  };
  const exact_run run = run_exactly(p, options.file, options.rule, options.kernels, tell, &shown);
  shown.line.erase();
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
  return status_of(path.status());
}

exit_status run_command(const prove_options& options) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  // The package is in the program's folder in a build tree, otherwise in the folder of the installed
  // contct.py.
  const std::vector<std::string> places =
      beside_program("contct_prove", {".", CONTCT_INSTALLED_PYTHON, "../lib/python3/dist-packages"});
  const auto package = std::ranges::find_if(places, [](const std::string& p) { return fs::exists(p); });
  if (package == places.end())
    throw std::runtime_error("the prover is not installed: found no contct_prove next to " +
                             program.string() + "; install the package python3-contct");
  const std::string library = options.library.empty() ? program.string() : options.library;
  flush_standard_output();
  (void)setenv("PYTHONPATH", fs::path(*package).parent_path().c_str(), 1);
  execl(python, python, "-P", "-m", "contct_prove", ("--symbol=" + options.symbol).c_str(),
        ("--json=" + options.json).c_str(), ("--trace=" + options.trace).c_str(), "--", library.c_str(),
        static_cast<char*>(nullptr));
  throw std::system_error(errno, std::generic_category(), std::string("cannot run ") + python);
}

}  // namespace contct
