#include "contct/write/calculix_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "contct/certify/reference_solution.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/write/calculix_mesh.hpp"

namespace contct::write {
namespace {

/// Largest deflection over the structure's length: CalculiX's NLGEOM must not notice that anything turns.
constexpr double smallness = 1e-7;
/// How far a spring's table reaches, in largest deflections: Newton's first steps may go far.
constexpr double reach = 1e6;
/// All forces together, in the unit of force that the deck counts in.
constexpr double total_force = 1e6;
/// A second point of the table near the answer, likewise: the far end alone, rounded to the digits of a
/// field, would misplace the face of a stiff spring.
constexpr double within = 4;

/// CalculiX cuts a field after 20 characters; this has 19 at most.
std::string number(double x) {
  return fmt::format("{:.12e}", x);
}

/// What a spring, one-sided or not, has in common with its like: one table for all of them.
struct spring_law {
  double stiffness;
  double from;  // the shortening at which it begins to press, from the undeformed structure on
  bool both_ways;
  [[nodiscard]] auto key() const { return std::tuple(stiffness, from, both_ways); }
  bool operator<(const spring_law& other) const { return key() < other.key(); }
};

/// A spring between a node of the structure, from 0, and a node on the ground above or below it.
struct ground_spring {
  int node;
  int side;  // +1: the ground is above
  spring_law law;
};

/// Writes one problem's step.
class deck_writer {
 public:
  deck_writer(const problem& p, const calculix_choice& choice) : problem_(p), choice_(choice) {
    if (choice_.step == 0) choice_.step = static_cast<int>(p.steps.size());
    refuse_what_cannot_be_written();
    mesh_ = calculix_mesh_of(p, choice_.refine, choice_.step - 1);
    measure();
    gather_springs();
  }

  calculix_deck write() {
    write_heading();
    write_nodes();
    write_elements();
    write_springs();
    write_boundary();
    write_step();
    return {std::move(text_),
            scale_,
            force_scale(),
            choice_.step,
            static_cast<int>(mesh_.nodes.size()),
            static_cast<int>(mesh_.elements.size()),
            first_ground()};
  }

 private:
  void refuse_what_cannot_be_written() const {
    const int steps = static_cast<int>(problem_.steps.size());
    if (choice_.step < 1 || choice_.step > steps) {
      throw std::invalid_argument(
          fmt::format("--step: found {}; allowed: {}", choice_.step,
                      steps == 1 ? "1, the only one" : fmt::format("1 to {}", steps)));
    }
    const auto* const plate_of = std::get_if<plate>(&problem_.geometry.kind);
    if (plate_of == nullptr && !std::holds_alternative<beam>(problem_.geometry.kind))
      throw std::invalid_argument("only beams and plates can be written for CalculiX");
    if (plate_of != nullptr && plate_of->nu > 0.49) {
      throw std::invalid_argument(fmt::format(
          "plate.nu: found {:g}; allowed: at most 0.49 for CalculiX, whose plates are solid inside",
          plate_of->nu));
    }
    const auto names = dof_names(problem_.geometry);
    for (const support& s : problem_.supports) {
      if (s.fixed || s.dof == 0) continue;
      throw std::invalid_argument(fmt::format(
          "the support at node {} has a spring in {}: CalculiX has none for the turns of beams and "
          "plates; allowed: springs in w",
          s.node + 1, names[s.dof]));
    }
    linear_structure s = structure_of(problem_);
    rigid_rank held;
    for (const rigid_row& row : s.held_by_supports) held.hold(row);
    if (held.rank() < s.rigid_motions) {
      throw std::invalid_argument(
          "the supports alone do not hold the structure: CalculiX's first step, with springs not yet "
          "pressed, has no "
          "answer; allowed: a structure that its [[support]] tables hold");
    }
  }

  /// The sizes that everything is chosen by. Only the size of the answer is taken from the reference
  /// solution.
  void measure() {
    const auto [left, right] = std::minmax_element(mesh_.nodes.begin(), mesh_.nodes.end(),
                                                   [](const auto& a, const auto& b) { return a.x < b.x; });
    const auto [low, high] = std::minmax_element(mesh_.nodes.begin(), mesh_.nodes.end(),
                                                 [](const auto& a, const auto& b) { return a.y < b.y; });
    length_ = std::max(right->x - left->x, high->y - low->y);
    thickness_ = length_ / choice_.slenderness;

    const linear_structure s = structure_of(problem_);
    std::vector<double> total(s.dofs(), 0.0);
    loads_of(problem_)(choice_.step, total);
    reference_solver finds(s);
    const reference_answer found = finds.solve(total);
    if (found.how != reference_answer::outcome::found)
      throw std::invalid_argument(
          fmt::format("nothing carries the load of step {}: there is no final state", choice_.step));
    deflection_ = 0.0;
    for (std::size_t dof = 0; dof < found.displacement.size(); dof += s.dofs_per_node)
      deflection_ = std::max(deflection_, std::abs(found.displacement[dof]));
    if (deflection_ == 0.0) deflection_ = length_;  // any length will do
    scale_ = smallness * length_ / deflection_;
    double forces = 0.0;
    for (const auto& [at, value] : mesh_.forces) forces += std::abs(value);
    if (forces > 0.0) unit_ = total_force / (forces * scale_);
  }

  void gather_springs() {
    for (const contact_pair& p : problem_.pairs)
      springs_.push_back({p.node, p.surface, {p.stiffness, p.surface * p.face, false}});
    for (const support& s : problem_.supports) {
      if (!s.fixed) springs_.push_back({s.node, face_below, {s.spring, 0.0, true}});
    }
  }

  [[nodiscard]] double force_scale() const { return scale_ * unit_; }
  [[nodiscard]] int first_ground() const { return static_cast<int>(mesh_.nodes.size()) + 1; }

  template <class... Arguments>
  void line(fmt::format_string<Arguments...> words, Arguments&&... arguments) {
    text_ += fmt::format(words, std::forward<Arguments>(arguments)...) + '\n';
  }

  void write_heading() {
    line("** One state of a problem of contct: the end of its load step {} of {}.", choice_.step,
         problem_.steps.size());
    line("** Displacements and faces are the problem's times the first of these, forces times the second:");
    line("** displacement-scale {}", number(scale_));
    line("** force-scale {}", number(force_scale()));
    line("** NLGEOM, without which CalculiX takes one-sided springs for linear ones, also counts every");
    line("** turn: so the largest deflection is {:g} of the length. And it takes forces far below 0.01 for",
         smallness);
    line("** none, and is content too early: so the loads, with everything elastic, are in smaller units.");
    line("** The problem's node i is node i here; pair i presses on ground node {} + i.", first_ground() - 1);
    line("** No field has more than 20 characters: CalculiX cuts it there.");
  }

  void write_nodes() {
    line("*NODE,NSET=STRUCTURE");
    for (std::size_t i = 0; i < mesh_.nodes.size(); ++i)
      line("{},{},{},0", i + 1, number(mesh_.nodes[i].x), number(mesh_.nodes[i].y));
    if (springs_.empty()) return;
    line("** Ground: a node for each spring, straight above or below its node.");
    line("*NODE,NSET=GROUND");
    int next = first_ground();
    for (const ground_spring& s : springs_) {
      const auto& at = mesh_.nodes[s.node];
      line("{},{},{},{}", next++, number(at.x), number(at.y), number(s.side * length_ / 100));
    }
  }

  void write_elements() {
    if (const auto* b = std::get_if<beam>(&problem_.geometry.kind)) {
      write_beam(*b);
    } else {
      write_plate(std::get<plate>(problem_.geometry.kind));
    }
  }

  void element_lines(const std::vector<std::size_t>& which) {
    for (const std::size_t e : which) {
      std::string nodes;
      for (const int n : mesh_.elements[e]) nodes += fmt::format(",{}", n + 1);
      line("{}{}", e + 1, nodes);
    }
  }

  void write_beam(const beam& b) {
    line("** A square section, 1/{:g} of the length: shear adds (thickness over length)^2. E is what",
         choice_.slenderness);
    line("** gives EI; nu = 0, because EI knows none. Between nodes of the problem the intervals are even.");
    std::map<double, std::vector<std::size_t>> by_stiffness;
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) by_stiffness[b.EI[mesh_.origins[e]]].push_back(e);
    int part = 0;
    for (const auto& [EI, which] : by_stiffness) {
      ++part;
      line("*ELEMENT,TYPE=B32R,ELSET=PART{}", part);
      element_lines(which);
      line("*MATERIAL,NAME=EI{}", part);
      line("*ELASTIC");
      line("{},0.", number(unit_ * 12 * EI / thickness_ / thickness_ / thickness_ / thickness_));
      line("*BEAM SECTION,ELSET=PART{},MATERIAL=EI{},SECTION=RECT", part, part);
      line("{},{}", number(thickness_), number(thickness_));
      line("0.,0.,1.");
    }
  }

  void write_plate(const plate& p) {
    line("** Thickness 1/{:g} of the length: shear adds (thickness over length)^2. E is what gives D.",
         choice_.slenderness);
    line("*ELEMENT,TYPE=S8R,ELSET=PLATE");
    std::vector<std::size_t> all(mesh_.elements.size());
    for (std::size_t e = 0; e < all.size(); ++e) all[e] = e;
    element_lines(all);
    line("*MATERIAL,NAME=D");
    line("*ELASTIC");
    line("{},{}", number(unit_ * 12 * p.D * (1 - p.nu * p.nu) / thickness_ / thickness_ / thickness_),
         number(p.nu));
    line("*SHELL SECTION,ELSET=PLATE,MATERIAL=D");
    line("{}", number(thickness_));
  }

  /// Each law is a table of force over lengthening. CalculiX holds the force constant outside it, so it ends
  /// far beyond anything that happens.
  void write_springs() {
    if (springs_.empty()) return;
    line(
        "** Springs to the ground: SPRINGA, since SPRING1 cannot be nonlinear in CalculiX 2.20. A table is "
        "force");
    line(
        "** over lengthening: the slope k up to the face, zero beyond. Outside a table the force stays as at "
        "its");
    line("** end, so it ends {:g} largest deflections away.", reach);
    std::map<spring_law, std::vector<std::size_t>> by_law;
    for (std::size_t i = 0; i < springs_.size(); ++i) by_law[springs_[i].law].push_back(i);
    const double far = reach * deflection_ * scale_;
    int set = 0;
    for (const auto& [law, which] : by_law) {
      ++set;
      line("*ELEMENT,TYPE=SPRINGA,ELSET=SPRINGS{}", set);
      for (const std::size_t i : which) {
        line("{},{},{}", mesh_.elements.size() + 1 + i, springs_[i].node + 1,
             first_ground() + static_cast<int>(i));
      }
      line("*SPRING,ELSET=SPRINGS{},NONLINEAR", set);
      const double face = -law.from * scale_;
      const double near = within * deflection_ * scale_;
      for (const double end : {-far, -near})
        line("{},{}", number(unit_ * law.stiffness * end), number(face + end));
      if (!law.both_ways) line("0.,{}", number(face));
      line("{},{}", law.both_ways ? number(unit_ * law.stiffness * far) : "0.", number(face + far));
    }
  }

  void write_boundary() {
    line("*BOUNDARY");
    for (const auto& [node, direction] : mesh_.fixed) line("{},{}", node + 1, direction);
    if (!springs_.empty()) line("GROUND,1,3");
  }

  void write_step() {
    line(
        "** One increment. The usual criterion is enough: on springs of straight pieces Newton's method "
        "ends.");
    line("*STEP,NLGEOM");
    line("*STATIC");
    line("1.,1.");
    line("*CLOAD");
    for (const auto& [at, value] : mesh_.forces) {
      if (value != 0.0) line("{},{},{}", at.first + 1, at.second, number(value * force_scale()));
    }
    line("*NSET,NSET=GIVEN,GENERATE");
    line("1,{},1", nodes(problem_.geometry));
    line("*NODE PRINT,NSET=GIVEN");
    line("U");
    if (!springs_.empty()) {
      line("** What the ground is held with: the pairs' forces, up positive.");
      line("*NODE PRINT,NSET=GROUND");
      line("RF");
    }
    line("*NODE FILE,OUTPUT=2D");
    line("U");
    line("*END STEP");
  }

  const problem& problem_;
  calculix_choice choice_;
  calculix_mesh mesh_;
  std::vector<ground_spring> springs_;  // the pairs', then those of elastic supports
  double length_ = 0.0;
  double thickness_ = 0.0;
  double deflection_ = 0.0;  // the largest
  double scale_ = 1.0;       // of displacements
  double unit_ = 1.0;        // of force: everything elastic is so much stiffer than the problem's
  std::string text_;
};

}  // namespace

calculix_deck calculix_deck_of(const problem& p, const calculix_choice& choice) {
  return deck_writer(p, choice).write();
}

}  // namespace contct::write
