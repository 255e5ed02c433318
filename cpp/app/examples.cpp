#include "app/examples.hpp"

#include <fmt/format.h>

namespace contct::app {
namespace {

constexpr example all_examples[] = {
    {"new", "beam beam.toml", "a commented problem to start from"},
    {"new", "plate plate.toml", "the same for a plate"},
    {"run", "beam.toml", "the path, FORTRAN and C++ in lockstep"},
    {"run", "beam.toml --json result.json --log unit26.txt", "all numbers, and what the listing writes"},
    {"run", "beam.toml --kernels corrected --strict", "the repaired rule; exit 3 unless it is certified"},
    {"run", "beam.toml --free-run --kernels corrected,fortran", "where the 1989 rule goes another way"},
    {"run", "beam.toml --final-only", "no path: the end of every step by the oracle, certified"},
    {"run", "beam.toml --html beam.html", "a page to look at, with everything in it"},
    {"export", "beam.toml --calculix beam.inp", "the end of the last step, for CalculiX to solve"},
    {"explain", "beam.toml", "what the listing did, line by line, and why"},
    {"explain", "beam.toml --increment 1.1 --pair 1", "one pair in one increment"},
    {"explain", "beam.toml --quiet --json why.json", "the same for a program"},
    {"verify", "", "every reference problem against its numbers"},
    {"verify", "--quiet --junit verify.xml", "for a CI system"},
    {"fuzz", "--calls 20000 --seed 7", "FORTRAN against C++ on random calls"},
    {"fuzz", "--kernels fortran,plugin:./mine.so --calls 20000", "is a kernel of your own CONTCT?"},
    {"replay", "calls.trace", "recorded calls put to the 1989 code again"},
    {"replay", "--kernel fortran,cpp calls.trace", "the same to two kernels"},
    {"atlas", "--problems 2 --csv atlas.csv", "how often the 1989 rule goes wrong, in a hurry"},
    {"atlas", "--problems 2 --quiet --svg atlas.svg", "the picture alone"},
    {"kernels", "", "what is built in"},
    {"completion", "bash", "what makes a shell complete the words of contct"},
    {"man", "", "the manual page, for man -l -"},
};

}  // namespace

std::vector<example> examples_of(std::string_view command) {
  std::vector<example> found;
  for (const example& e : all_examples)
    if (command.empty() || e.command == command) found.push_back(e);
  return found;
}

std::string line_of(const example& e) {
  return fmt::format("contct {}{}{}", e.command, e.arguments.empty() ? "" : " ", e.arguments);
}

}  // namespace contct::app
