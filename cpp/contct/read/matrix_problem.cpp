#include "contct/read/matrix_problem.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "contct/read/contact_face.hpp"
#include "contct/read/dof_labels.hpp"
#include "contct/read/matrix_market.hpp"
#include "contct/read/matrix_tables.hpp"

namespace contct {
namespace {

class matrix_problem_reader {
 public:
  matrix_problem_reader(const std::string& folder, std::string_view file, problem& p)
      : folder_(folder),
        file_(file),
        problem_(p),
        structure_(std::get<assembled>(p.geometry.kind)),
        index_(structure_),
        fixed_(static_cast<std::size_t>(structure_.dofs()), 0) {}

  void read(const table_reader& top) {
    if (top.has("bed"))
      top.refuse(top.required("bed", ""), "bed", "this with a matrix",
                 "a [[contact]] at each dof: a matrix knows no lengths or areas");
    if (top.has("support"))
      for (const table_reader& t : top.tables("support")) read_support(t);
    if (top.has("contact"))
      for (const table_reader& t : top.tables("contact")) read_contact(t);
    for (const table_reader& t : top.tables("step")) read_step(t);
  }

 private:
  [[nodiscard]] int dof_at(const table_reader& t, const toml::node& node, const std::string& name) const {
    const std::optional<int> dof = index_.find(t.text_of(node, name, index_.allowed()));
    if (!dof) t.refuse(node, name, found_words(node), index_.allowed());
    return *dof;
  }

  [[nodiscard]] int read_dof(const table_reader& t) const {
    return dof_at(t, t.required("dof", index_.allowed()), "dof");
  }

  /// The dofs that "dof" or "dofs" names.
  [[nodiscard]] std::vector<int> read_dofs(const table_reader& t) const {
    if (!t.has("dofs")) return {read_dof(t)};
    if (t.has("dof")) t.refuse(t.required("dof", ""), "dof", "this beside dofs", "either dof or dofs");
    const toml::node& node = t.required("dofs", "");
    const toml::array* const list = node.as_array();
    if (list == nullptr || list->empty()) t.refuse(node, "dofs", found_words(node), "a list of labels");
    std::vector<int> dofs;
    for (std::size_t i = 0; i < list->size(); ++i)
      dofs.push_back(dof_at(t, *list->get(i), indexed("dofs", i)));
    return dofs;
  }

  void read_support(const table_reader& t) {
    t.allow_only({"dof", "dofs", "fix", "spring"});
    if (t.has("fix") == t.has("spring"))
      t.refuse(t.has("fix") ? "both fix and spring" : "neither fix nor spring", "one of them");
    support s;
    s.fixed = t.has("fix");
    if (s.fixed) {
      const toml::node& node = t.required("fix", "true");
      if (node.value_exact<bool>() != true) t.refuse(node, "fix", found_words(node), "true");
    } else {
      s.spring = t.real("spring", positive_real);
    }
    for (const int dof : read_dofs(t)) {
      s.node = dof;
      problem_.supports.push_back(s);
      if (s.fixed) fixed_[static_cast<std::size_t>(dof)] = 1;
    }
  }

  void read_contact(const table_reader& t) {
    t.allow_only({"dof", "surface", "face", "stiffness", "state"});
    const int dof = read_dof(t);
    contact_pair p = read_face(t, 0);
    p.node = dof;
    p.stiffness = t.real("stiffness", positive_real);
    if (fixed_[static_cast<std::size_t>(dof)] != 0) {
      problem_.warnings.push_back(
          fmt::format("{}:{}: {}: dof {} is fixed; the pair cannot change the answer, but the listing may "
                      "toggle it",
                      file_, t.line(), t.where(), structure_.label_of(dof)));
    }
    problem_.pairs.push_back(p);
  }

  void read_step(const table_reader& t) {
    t.allow_only({"point", "load"});
    if (!t.has("point") && !t.has("load"))
      t.refuse("a step without loads", "point, load or both; a load of 0 at any dof takes all load off");
    load l;
    if (t.has("load")) read_whole(t, l);
    if (t.has("point")) {
      for (const table_reader& p : t.tables("point")) {
        p.allow_only({"dof", "value"});
        l.points.push_back({read_dof(p), 0, p.real("value", any_real)});
      }
    }
    if (!std::isfinite(resultant_of(problem_.geometry, l).force))
      t.refuse("loads whose sum is not finite", "loads within the range of double precision");
    problem_.steps.push_back(std::move(l));
  }

  void read_whole(const table_reader& t, load& l) const {
    const std::vector<double> values = read_vector(beside(folder_, t.text("load")), structure_.dofs());
    for (std::size_t dof = 0; dof < values.size(); ++dof)
      if (values[dof] != 0.0) l.points.push_back({static_cast<int>(dof), 0, values[dof]});
  }

  const std::string& folder_;
  std::string_view file_;
  problem& problem_;
  const assembled& structure_;
  dof_index index_;
  std::vector<char> fixed_;  // [dofs]
};

}  // namespace

void read_on_matrix(const table_reader& top, const std::string& folder, std::string_view file, problem& p) {
  matrix_problem_reader(folder, file, p).read(top);
}

}  // namespace contct
