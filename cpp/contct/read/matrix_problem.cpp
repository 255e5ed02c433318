#include "contct/read/matrix_problem.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "contct/read/contact_face.hpp"
#include "contct/read/dof_labels.hpp"
#include "contct/read/matrix_files.hpp"
#include "contct/read/matrix_tables.hpp"

namespace contct::read {
namespace {

class matrix_problem_reader {
 public:
  matrix_problem_reader(const std::string& folder, problem& p)
      : folder_(folder),
        problem_(p),
        structure_(std::get<assembled>(p.geometry.kind)),
        index_(structure_),
        fixed_(structure_.dofs(), 0) {}

  void read(const table_reader& top) {
    if (top.has("bed"))
      top.refuse_key("bed", "this with a matrix",
                     "a [[contact]] at each dof: a matrix knows no lengths or areas");
    for (const table_reader& t : top.optional_tables("support")) read_support(t);
    for (const table_reader& t : top.optional_tables("contact")) read_contact(t);
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
    t.refuse_beside({"dof"}, "dofs", "either dof or dofs");
    std::vector<int> dofs;
    for (const toml::node& entry : t.array("dofs", "a list of labels", 1))
      dofs.push_back(dof_at(t, entry, indexed("dofs", dofs.size())));
    return dofs;
  }

  void read_support(const table_reader& t) {
    t.allow_only({"dof", "dofs", "fix", "spring"});
    if (t.has("fix") == t.has("spring"))
      t.refuse(t.has("fix") ? "both fix and spring" : "neither fix nor spring", "one of them");
    support s;
    s.fixed = t.has("fix");
    if (s.fixed && t.required("fix", "true").value_exact<bool>() != true) t.refuse_key("fix", "true");
    if (!s.fixed) s.spring = t.real("spring", positive_real);
    for (const int dof : read_dofs(t)) {
      s.node = dof;
      problem_.supports.push_back(s);
      if (s.fixed) fixed_[dof] = 1;
    }
  }

  void read_contact(const table_reader& t) {
    t.allow_only({"dof", "surface", "face", "stiffness", "state"});
    const int dof = read_dof(t);
    read_pair(t, dof, fixed_[dof] != 0 ? fmt::format("dof {} is fixed", structure_.label_of(dof)) : "",
              problem_);
  }

  void read_step(const table_reader& t) {
    t.allow_only({"point", "load"});
    if (!t.has("point") && !t.has("load"))
      t.refuse("a step without loads", "point, load or both; a load of 0 at any dof takes all load off");
    load l;
    if (t.has("load")) read_whole(t, l);
    for (const table_reader& p : t.optional_tables("point")) {
      p.allow_only({"dof", "value"});
      l.points.push_back({read_dof(p), 0, p.real("value", any_real)});
    }
    if (!std::isfinite(resultant_of(problem_.geometry, l).force))
      t.refuse("loads whose sum is not finite", "loads within the range of double precision");
    problem_.steps.push_back(std::move(l));
  }

  void read_whole(const table_reader& t, load& l) const {
    const std::string path = beside(folder_, t.text("load"));
    const std::vector<double> values =
        parse_vector(read_input(path, "Matrix Market file", largest_matrix_file), path, structure_.dofs());
    for (std::size_t dof = 0; dof < values.size(); ++dof)
      if (values[dof] != 0.0) l.points.push_back({static_cast<int>(dof), 0, values[dof]});
  }

  const std::string& folder_;
  problem& problem_;
  const assembled& structure_;
  dof_index index_;
  std::vector<char> fixed_;  // [dofs]
};

}  // namespace

void read_on_matrix(const table_reader& top, const std::string& folder, problem& p) {
  matrix_problem_reader(folder, p).read(top);
}

}  // namespace contct::read
