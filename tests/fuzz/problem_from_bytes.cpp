#include "fuzz/problem_from_bytes.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

namespace contct::fuzz {
namespace {

/// `text` as a TOML string: what TOML does not take stands as an escape, bytes from 0x80 as Latin-1.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = byte >= 0x20 && byte < 0x7f && c != '"' && c != '\\';
    out += is_plain ? std::string(1, c) : fmt::format("\\u{:04x}", byte);
  }
  return out + "\"";
}

class problem_maker {
 public:
  explicit problem_maker(FuzzedDataProvider& bytes) : bytes_(bytes) {}

  made_problem make() {
    made_.text = "title = " + quoted(words_from(bytes_)) + "\n";
    if (chance(4))
      made_.text += fmt::format("[units]\nlength = {}\nforce = {}\n", quoted("m" + words_from(bytes_)),
                                quoted("kN" + words_from(bytes_)));
    const int kind = bytes_.ConsumeIntegralInRange(0, 3);
    kind == 3 ? add_matrix() : kind == 2 ? add_plate() : add_beam();
    add_supports();
    const int contacts = bytes_.ConsumeIntegralInRange(0, 3);
    for (int i = 0; i < contacts; ++i) add_contact();
    if (dofs_.size() > 1 && chance(3)) add_bed();
    const int steps = bytes_.ConsumeIntegralInRange(1, 4);
    for (int i = 0; i < steps; ++i) add_step(i);
    return std::move(made_);
  }

 private:
  /// One time in `of`; never where there are no bytes left.
  bool chance(int of) { return bytes_.ConsumeIntegralInRange(1, of) == of; }

  /// A number without a sign, not 0: a round one, a multiple of 1/64, or, rarely, any that a double can be.
  double size() {
    constexpr std::array round = {1.0, 0.001, 0.5, 10.0, 1e3, 1e4, 1e5, 0.1, 1.0 / 3.0, 1e7};
    constexpr std::array extreme = {1e-300, 5e-324, 1e300, 1e-12, 1e12, 1.7e308, 1e-30, 1e30};
    const int kind = bytes_.ConsumeIntegralInRange(0, 31);
    if (kind < 16) return bytes_.PickValueInArray(round);
    if (kind < 30) return bytes_.ConsumeIntegralInRange(1, 255) / 64.0;
    if (kind == 30) return bytes_.PickValueInArray(extreme);
    const double any = std::abs(bytes_.ConsumeFloatingPoint<double>());
    return std::isfinite(any) && any > 0.0 ? any : 1.0;
  }
  double number() { return chance(8) ? 0.0 : chance(3) ? size() : -size(); }

  int place() { return bytes_.ConsumeIntegralInRange(1, nodes_); }
  std::string place_key() {
    return on_matrix() ? fmt::format("dof = {}", quoted(labels_[place() - 1]))
                       : fmt::format("node = {}", place());
  }
  [[nodiscard]] bool on_matrix() const { return !labels_.empty(); }

  void add_beam() {
    dofs_ = {"w", "theta"};
    const int elements = bytes_.ConsumeIntegralInRange(1, 9);
    nodes_ = elements + 1;
    std::string lengths = fmt::format("length = {}\nelements = {}", size(), elements);
    if (chance(3)) {
      std::vector<double> x = {number()};
      for (int e = 0; e < elements; ++e) x.push_back(x.back() + size());
      lengths = fmt::format("x = [{}]", fmt::join(x, ", "));
    }
    made_.text += fmt::format("[beam]\n{}\nEI = {}\n", lengths, size());
  }

  void add_plate() {
    dofs_ = {"w", "wx", "wy"};
    const int columns = bytes_.ConsumeIntegralInRange(1, 3);
    const int rows = bytes_.ConsumeIntegralInRange(1, 3);
    nodes_ = (columns + 1) * (rows + 1);
    made_.text += fmt::format("[plate]\nsize = [{}, {}]\nelements = [{}, {}]\nnu = {}\n", size(), size(),
                              columns, rows, bytes_.ConsumeIntegralInRange(-3, 8) / 16.0);
    made_.text +=
        chance(2) ? fmt::format("D = {}\n", size()) : fmt::format("E = {}\nthickness = {}\n", size(), size());
  }

  /// Springs between dofs, and to the ground: positive semidefinite, but for rounding.
  void add_matrix() {
    dofs_ = {"value"};
    nodes_ = bytes_.ConsumeIntegralInRange(1, 8);
    std::vector<std::vector<double>> k(nodes_, std::vector<double>(nodes_));
    const int springs = bytes_.ConsumeIntegralInRange(0, 12);
    for (int i = 0; i < springs; ++i) {
      const int from = place() - 1;
      const int to = place() - 1;
      const double stiffness = size();
      k[from][from] += stiffness;
      if (to == from) continue;
      k[to][to] += stiffness;
      k[std::max(from, to)][std::min(from, to)] -= stiffness;
    }
    std::string entries;
    int count = 0;
    for (int row = 0; row < nodes_; ++row) {
      for (int column = 0; column <= row; ++column) {
        if (k[row][column] == 0.0) continue;
        entries += fmt::format("{} {} {}\n", row + 1, column + 1, k[row][column]);
        ++count;
      }
    }
    made_.files["k.mtx"] = fmt::format("%%MatrixMarket matrix coordinate real symmetric\n{0} {0} {1}\n{2}",
                                       nodes_, count, entries);
    made_.text += "[matrix]\nstiffness = \"k.mtx\"\ndofs = \"k.dof\"\n";
    add_labels();
    if (chance(8)) made_.text += fmt::format("free_motions = {}\n", bytes_.ConsumeIntegralInRange(0, 6));
    if (chance(3)) made_.text += chance(2) ? "storage = \"sparse\"\n" : "storage = \"band\"\n";
  }

  /// "1.x", "1.y", "2.x" and so on; or one with any characters before the point.
  void add_labels() {
    const std::string odd = chance(4) ? words_from(bytes_) : "";
    constexpr std::array directions = {"x", "y", "z", "rx", "ry", "rz"};
    const int each = bytes_.ConsumeIntegralInRange(1, 3);
    const int first = bytes_.ConsumeIntegralInRange(0, 3);
    std::string places;
    for (int dof = 0; dof < nodes_; ++dof) {
      std::string name = std::to_string(dof / each + 1);
      for (const char c : dof < each ? odd : "")
        if (static_cast<unsigned char>(c) > 0x20 && c != 0x7f) name += c;
      labels_.push_back(fmt::format("{}.{}", name, directions[first + dof % each]));
      made_.files["k.dof"] += labels_.back() + "\n";
      if (dof % each == 0) places += fmt::format("{} {} {} {}\n", name, dof, dof % 3, dof % 2);
    }
    if (!chance(2)) return;
    made_.files["k.xyz"] = places;
    made_.text += "coordinates = \"k.xyz\"\n";
  }

  /// Mostly one that holds the structure, and some more.
  void add_supports() {
    if (!chance(5)) add_support(2);
    const int others = bytes_.ConsumeIntegralInRange(0, 3);
    for (int i = 0; i < others; ++i) add_support(bytes_.ConsumeIntegralInRange(0, 2));
  }

  /// Of kind 0 one that fixes the first dof of a node, of kind 1 a spring, of kind 2 one that fixes all dofs.
  void add_support(int kind) {
    const std::string at = place_key();
    made_.text += "[[support]]\n" + at + "\n";
    if (kind != 1) fixed_.push_back(at);
    if (on_matrix())
      made_.text += kind == 1 ? fmt::format("spring = {}\n", size()) : "fix = true\n";
    else if (kind == 1)
      made_.text += fmt::format("spring = {{ {} = {} }}\n", dofs_.back(), size());
    else
      made_.text += kind == 0 ? fmt::format("fix = \"{}\"\n", dofs_[0])
                              : fmt::format("fix = [\"{}\"]\n", fmt::join(dofs_, "\", \""));
  }

  /// Behind the place: which side, and a face on that side.
  std::string facing() {
    const bool above = chance(2);
    const double face = chance(3) ? 0.0 : size();
    return fmt::format("surface = \"{}\"\nface = {}\n", above ? "above" : "below", above ? face : -face) +
           (chance(4) ? "state = \"separated\"\n" : "");
  }

  void add_contact() {
    made_.text += fmt::format("[[contact]]\n{}\n{}stiffness = {}\n", place_key(), facing(), size());
  }

  void add_bed() { made_.text += fmt::format("[[bed]]\n{}modulus = {}\n", facing(), size()); }

  void add_step(int before) {
    made_.text += "[[step]]\n";
    if (chance(4)) made_.text += "name = " + quoted(words_from(bytes_)) + "\n";
    if (!on_matrix() && chance(2))
      made_.text += fmt::format("uniform = {}\n", before % 2 == 1 ? 0.0 : number());
    made_.text +=
        fmt::format("point = [ {{ {}, {} = {} }} ]\n", place_key(),
                    dofs_[bytes_.ConsumeIntegralInRange<std::size_t>(0, dofs_.size() - 1)], number());
    if (!fixed_.empty() && chance(4))
      made_.text += fmt::format("settlement = [ {{ {}, {} = {} }} ]\n",
                                fixed_[bytes_.ConsumeIntegralInRange<std::size_t>(0, fixed_.size() - 1)],
                                dofs_[0], number());
  }

  FuzzedDataProvider& bytes_;
  made_problem made_;
  int nodes_ = 0;
  std::vector<std::string> dofs_;    // of a node
  std::vector<std::string> labels_;  // of a matrix
  std::vector<std::string> fixed_;   // places of supports that fix a dof
};

}  // namespace

std::string words_from(FuzzedDataProvider& bytes) {
  // What ends a text, or begins something else, in one of the files that the program writes.
  constexpr std::array breaking = {"</script><script>",
                                   "<!--",
                                   "\",\"\"",
                                   "'\"><b>&amp;",
                                   "]]>",
                                   "| a | b |",
                                   "```",
                                   "=1+1",
                                   "*STEP",
                                   "**/",
                                   "-->",
                                   "\\",
                                   "</title>",
                                   "{{data}}"};
  if (bytes.ConsumeIntegralInRange(1, 6) == 6) return bytes.PickValueInArray(breaking);
  constexpr std::size_t longest = 24;
  std::string words = bytes.ConsumeRandomLengthString(longest);
  for (char& c : words) c = static_cast<char>(' ' + static_cast<unsigned char>(c) % ('~' - ' ' + 1));
  return words;
}

made_problem problem_from(FuzzedDataProvider& bytes) {
  return problem_maker(bytes).make();
}

}  // namespace contct::fuzz
