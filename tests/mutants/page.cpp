#include "mutants/page.hpp"

namespace contct_test {
namespace {

/// A line of a source in a cell of a table.
std::string code(std::string line) {
  line.erase(0, line.find_first_not_of(' '));
  std::string cell = "`";
  for (const char c : line) cell += c == '|' ? std::string("\\|") : std::string(1, c);
  return cell + "`";
}

/// Its lines one below the other.
std::string codes(const std::string& text) {
  std::string cell;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    if (line.find_first_not_of(' ') != std::string::npos) cell += (cell.empty() ? "" : "<br>") + code(line);
    at = end + 1;
  }
  return cell.empty() ? "nothing" : cell;
}

std::string bare_name(const std::string& file) {
  return file.substr(file.rfind('/') + 1);
}

std::string golden_cell(const verdict& v) {
  const auto first = v.first_in("trace");
  if (!first) return "-";
  const int count = v.count_in("trace");
  return first->where.substr(6) + ", " + first->what +
         (count > 1 ? "; " + std::to_string(count) + " traces in all" : "");
}

std::string random_cell(const verdict& v) {
  const auto first = v.first_in("random");
  return first ? first->where.substr(7) + "-byte REAL, " + first->what : "-";
}

std::string row(const trial& t) {
  if (!t.which.equivalent.empty()) return equivalent_row(t.which);
  return row_beginning(t.which) + " " + golden_cell(t.seen) + " | " + random_cell(t.seen) + " |";
}

/// "68 mutants: 60 killed by the golden set, 2 by random calls alone, 6 equivalent"
std::string count(const std::vector<trial>& trials, bool fortran) {
  int all = 0;
  int golden = 0;
  int random_only = 0;
  for (const trial& t : trials) {
    if (is_fortran(t.which) != fortran || t.which.find.empty()) continue;
    ++all;
    golden += t.killed() && t.seen.killed_by_golden_set() ? 1 : 0;
    random_only += t.killed() && !t.seen.killed_by_golden_set() ? 1 : 0;
  }
  return std::to_string(all) + " mutants: " + std::to_string(golden) + " killed by the golden set, " +
         std::to_string(random_only) + " by random calls alone, " +
         std::to_string(all - golden - random_only) + " equivalent";
}

std::string table(const std::vector<trial>& trials, bool fortran) {
  std::string text = count(trials, fortran) +
                     ".\n\n| mutant | fault | file | changed | into | golden set | random calls |\n" +
                     "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const trial& t : trials)
    if (is_fortran(t.which) == fortran && !t.which.find.empty()) text += row(t) + "\n";
  return text;
}

}  // namespace

std::string row_beginning(const mutant& m) {
  return "| " + m.id + " | " + m.fault + " | " + bare_name(m.file) + " | " + codes(m.find) + " | " +
         codes(m.replace) + " |";
}

std::string equivalent_row(const mutant& m) {
  return row_beginning(m) + " equivalent | " + m.equivalent + " |";
}

std::string page(const std::vector<trial>& trials, const bounded_fuzz& fuzz) {
  return "# Mutants: what the tests would notice\n\n"
         "Faults put into the kernels on purpose, one at a time, and what notices each: the golden set\n"
         "(`reference/traces`), and " +
         std::to_string(fuzz.calls) +
         " random and adversarial calls in each precision, answered by the kernel of\n"
         "the other language as well. For each the first difference in the first trace that notices is "
         "named, and the\n"
         "first such call. They cannot notice what both kernels share: the rounding to 4 bytes in "
         "`built_in.cpp`.\n"
         "A mutant that nothing notices fails the run, and so does one that is said to be equivalent and is "
         "noticed.\n"
         "Made from `tests/mutants/mutants.toml`, not by hand:\n\n"
         "```sh\nbuild/release/tests/contct_mutants --page reference/mutants.md\n```\n\n"
         "## FORTRAN\n\n" +
         table(trials, true) + "\n## C++\n\n" + table(trials, false);
}

}  // namespace contct_test
