#include "referee/problem_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace contct::referee {
namespace {

/// As TOML has it: "-0" would be the whole number 0.
std::string number_text(double x) {
  return x == 0.0 && std::signbit(x) ? "-0.0" : fmt::format("{}", x);
}

std::string list_of_numbers(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double x : values) texts.push_back(number_text(x));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string geometry_text(const beam& b) {
  return fmt::format("[beam]\nx = [{}]\nEI = [{}]\n", list_of_numbers(b.x), list_of_numbers(b.EI));
}

std::string geometry_text(const plate& p) {
  return fmt::format("[plate]\nx = [{}]\ny = [{}]\nD = {}\nnu = {}\n", list_of_numbers(p.x),
                     list_of_numbers(p.y), p.D, p.nu);
}

std::string geometry_text(const assembled& a) {
  return "[matrix]\nstiffness = \"K.mtx\"\n" +
         (a.free_motions ? fmt::format("free_motions = {}\n", *a.free_motions) : "");
}

std::string matrix_text(const sparse_matrix& a) {
  std::string text = fmt::format("%%MatrixMarket matrix coordinate real symmetric\n{0} {0} {1}\n", a.order,
                                 a.entries.size());
  for (const matrix_entry& m : a.entries) text += fmt::format("{} {} {}\n", m.row + 1, m.column + 1, m.value);
  return text;
}

/// `node = 3`, or `dof = "185.3"`.
std::string place_text(const model& m, int node) {
  const auto* a = std::get_if<assembled>(&m.kind);
  return a == nullptr ? fmt::format("node = {}", node + 1) : fmt::format("dof = \"{}\"", a->label_of(node));
}

std::string support_text(const model& m, const support& s) {
  const std::string head = "\n[[support]]\n" + place_text(m, s.node) + "\n";
  if (std::holds_alternative<assembled>(m.kind))
    return head + (s.fixed ? "" : fmt::format("spring = {}\n", s.spring));
  const char* const name = dof_names(m)[static_cast<std::size_t>(s.dof)];
  return head + (s.fixed ? fmt::format("fix = [\"{}\"]\n", name)
                         : fmt::format("spring = {{ {} = {} }}\n", name, s.spring));
}

std::string pair_text(const model& m, const contact_pair& c) {
  return fmt::format("\n[[contact]]\n{}\nsurface = \"{}\"\nface = {}\nstiffness = {}\nstate = \"{}\"\n",
                     place_text(m, c.node), c.surface > 0 ? "above" : "below", number_text(c.face),
                     c.stiffness, c.closed ? "contact" : "separated");
}

std::string distributed_text(const distributed_load& d) {
  const std::string what = d.polynomial.size() == 1
                               ? fmt::format("value = {}", number_text(d.polynomial[0]))
                               : fmt::format("polynomial = [{}]", list_of_numbers(d.polynomial));
  if (d.elements.empty()) return "{ " + what + " }";
  std::vector<int> from_1 = d.elements;
  for (int& e : from_1) ++e;
  return fmt::format("{{ {}, elements = [{}] }}", what, fmt::join(from_1, ", "));
}

std::string at_dof_text(const model& m, int node, int dof, double value) {
  return fmt::format("{{ {}, {} = {} }}", place_text(m, node), dof_names(m)[static_cast<std::size_t>(dof)],
                     number_text(value));
}

std::string list_text(const char* key, const std::vector<std::string>& items) {
  return items.empty() ? "" : fmt::format("{} = [ {} ]\n", key, fmt::join(items, ", "));
}

std::string step_text(const model& m, const load& l) {
  std::vector<std::string> spread, points, settlements;
  for (const distributed_load& d : l.distributed) spread.push_back(distributed_text(d));
  for (const point_load& q : l.points) points.push_back(at_dof_text(m, q.node, q.dof, q.value));
  for (const prescribed_displacement& g : l.settlements)
    settlements.push_back(at_dof_text(m, g.node, g.dof, g.value));
  if (spread.empty() && points.empty() && settlements.empty())  // a file has to say that all load is off
    points.push_back(at_dof_text(m, 0, 0, 0.0));
  return "\n[[step]]\n" + list_text("uniform", spread) + list_text("point", points) +
         list_text("settlement", settlements);
}

}  // namespace

problem_text text_of(const problem& p) {
  problem_text text;
  text.toml = fmt::format("title = \"{}\"\n\n", p.title) +
              std::visit([](const auto& kind) { return geometry_text(kind); }, p.geometry.kind);
  for (const support& s : p.supports) text.toml += support_text(p.geometry, s);
  for (const contact_pair& c : p.pairs) text.toml += pair_text(p.geometry, c);
  for (const load& l : p.steps) text.toml += step_text(p.geometry, l);
  if (const auto* a = std::get_if<assembled>(&p.geometry.kind)) text.matrix = matrix_text(a->stiffness);
  return text;
}

}  // namespace contct::referee
