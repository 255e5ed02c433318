#include "contct/lab/atlas.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <stdexcept>

#include "contct/kernel/fortran.hpp"
#include "contct/lab/packed.hpp"
#include "contct/lab/workers.hpp"
#include "contct/outside/registry.hpp"

extern "C" {
int contct_epsmul_variants(void);
double contct_epsmul_of(int variant);
void contct_call_epsmul(int variant, const double* dd, const double* dtest, const double* cc, double* ss,
                        double* smin, const int* id, int* isep, const int* isurf, int nc, int indof,
                        int ndofpn);
}

namespace contct::lab {

template <class Visit>
void pack(Visit& visit, atlas_cell& c) {
  visit(c.kernel, c.epsmul, c.unit, c.held, c.problems, c.wrong, c.false_equilibrium, c.false_mechanism,
        c.never_held, c.no_end, c.uncertified, c.errors);
}

namespace {

class epsmul_variant final : public kernel {
 public:
  explicit epsmul_variant(int variant) : variant_(variant), facts_(facts_of_kernel("fortran")) {
    char epsmul[24];
    (void)std::snprintf(epsmul, sizeof epsmul, "%g", contct_epsmul_of(variant));
    facts_.name += std::string(" with EPSMUL ") + epsmul;
    facts_.has_text = false;
  }
  [[nodiscard]] const kernel_facts& facts() const override { return facts_; }

  void answer(call<double>& c) override {
    const std::scoped_lock lock(fortran::process_wide());
    contct_call_epsmul(variant_, c.dd.data(), c.dtest.data(), c.cc.data(), c.ss.data(), &c.smin, c.id.data(),
                       c.isep.data(), c.isurf.data(), c.nc(), c.dof.indof, c.dof.ndofpn);
  }

  std::string take_text() override { return {}; }

 private:
  int variant_;  // from 1, as FORTRAN counts
  kernel_facts facts_;
};

std::unique_ptr<kernel> kernel_of(const atlas_cell& c) {
  if (!c.has_other_epsmul()) return make_kernel(c.kernel);
  const std::vector<double> known = epsmul_of_variants();
  const auto at = std::find(known.begin(), known.end(), c.epsmul);
  if (at == known.end()) throw std::invalid_argument("no copy of the listing has that EPSMUL");
  return make_epsmul_variant(at - known.begin());
}

/// Try the problems `from` to `to` - 1 of a cell.
void try_some(atlas_cell& c, const atlas_request& r, int from, int to) {
  random_problem_kind kind;
  kind.least_unit = kind.most_unit = c.unit;
  kind.free_share = c.held ? 0.0 : 1.0;
  for (int number = from; number < to; ++number) {
    const std::unique_ptr<kernel> fresh = kernel_of(c);  // a kernel may keep state between calls
    c.add(try_problem(make_random_problem(r.seed, number, kind), *fresh));
  }
}

}  // namespace

std::vector<double> epsmul_of_variants() {
  std::vector<double> values;
  for (int variant = 1; variant <= contct_epsmul_variants(); ++variant)
    values.push_back(contct_epsmul_of(variant));
  return values;
}

std::unique_ptr<kernel> make_epsmul_variant(std::size_t variant) {
  return std::make_unique<epsmul_variant>(static_cast<int>(variant) + 1);
}

void atlas_cell::add(const problem_result& t) {
  const bool mechanism = t.came_to == verdict::false_mechanism;
  const bool endless = t.came_to == verdict::no_end;
  ++problems;
  false_equilibrium += t.unfounded > 0 ? 1 : 0;
  false_mechanism += mechanism ? 1 : 0;
  never_held += mechanism && t.increments == 0 ? 1 : 0;
  no_end += endless ? 1 : 0;
  uncertified += mechanism || endless || t.uncertified > 0 ? 1 : 0;
  if (t.length_error <= wrong_beyond && t.unfounded == 0) return;
  ++wrong;
  errors.insert(std::upper_bound(errors.begin(), errors.end(), t.displacement_error), t.displacement_error);
}

void atlas_cell::add(const atlas_cell& part) {
  for (int atlas_cell::*count :
       {&atlas_cell::problems, &atlas_cell::wrong, &atlas_cell::false_equilibrium,
        &atlas_cell::false_mechanism, &atlas_cell::never_held, &atlas_cell::no_end, &atlas_cell::uncertified})
    this->*count += part.*count;
  const auto middle = errors.insert(errors.end(), part.errors.begin(), part.errors.end());
  std::inplace_merge(errors.begin(), middle, errors.end());
}

confidence wilson(int hits, int tried) {
  constexpr double z = 1.959963984540054;  // the normal distribution has 95 % between -z and z
  const double n = tried;
  const double middle = (hits + z * z / 2) / (n + z * z);
  const double half = z / (n + z * z) * std::sqrt(hits * (n - hits) / n + z * z / 4);
  return {hits == 0 ? 0.0 : middle - half, hits == tried ? 1.0 : middle + half};
}

std::vector<atlas_cell> atlas_cells() {
  std::vector<atlas_cell> cells;
  for (const bool held : {true, false}) {
    for (int decade = -12; decade <= 12; decade += 2) {
      const double unit = std::pow(10.0, decade);
      cells.push_back({"fortran", printed_epsmul, unit, held});
      cells.push_back({"fortran-r4", printed_epsmul, unit, held});
      cells.push_back({"corrected", 0.0, unit, held});
    }
    for (const double unit : epsmul_units) {
      for (const double epsmul : epsmul_of_variants()) cells.push_back({"fortran", epsmul, unit, held});
    }
  }
  return cells;
}

void fill(atlas_cell& c, const atlas_request& r) {
  try_some(c, r, 0, r.problems);
}

void fill(std::vector<atlas_cell>& cells, const atlas_request& r, int jobs,
          const std::function<void(std::int64_t more)>& tried) {
  constexpr int problems_in_a_task = 16;
  const int parts = (r.problems - 1) / problems_in_a_task + 1;  // of a cell
  const auto work = [&](std::int64_t task) {
    const atlas_cell& c = cells[task / parts];
    const int from = static_cast<int>(task % parts) * problems_in_a_task;
    atlas_cell part{c.kernel, c.epsmul, c.unit, c.held};
    try_some(part, r, from, std::min(r.problems, from + problems_in_a_task));
    return packed(part);
  };
  do_tasks(jobs, std::ssize(cells) * parts, work, [&](std::int64_t task, const std::string& result) {
    atlas_cell part;
    unpack(result, part);
    cells[task / parts].add(part);
    if (tried) tried(part.problems);
  });
}

}  // namespace contct::lab
