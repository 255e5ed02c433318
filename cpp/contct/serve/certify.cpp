// contct_certify: bounds on the errors of states from elsewhere.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "contct/certify/certificate.hpp"
#include "contct/exact/exact_means.hpp"
#include "contct/path/path_observers.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/serve/answer.hpp"
#include "contct/serve/serve.h"
#include "contct/write/result_json.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

/// The states of a request, each with its pairs' statuses.
struct given_states {
  std::vector<std::vector<double>> displacement;  // [states][dofs]
  std::vector<std::vector<int>> isep;             // [states][pairs]
};

/// Where no list says so, a pair is closed whose face the state touches or enters.
std::vector<int> statuses_at(const problem& p, const linear_structure& s,
                             std::span<const double> displacement) {
  std::vector<int> isep(p.pairs.size(), separated);
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    const contact_pair& at = p.pairs[i];
    const double w = displacement[static_cast<std::size_t>(at.node) * s.dofs_per_node];
    if (at.surface * (w - at.face) >= 0) isep[i] = in_contact;
  }
  return isep;
}

std::vector<int> statuses_in(const problem& p, const std::vector<double>& closed) {
  std::vector<int> isep(p.pairs.size(), separated);
  for (const double number : closed) {
    // Compared before it is converted: a double beyond the integers has no integer to convert to.
    if (!(number >= 1 && number <= static_cast<double>(p.pairs.size())) || std::floor(number) != number)
      throw std::invalid_argument(
          fmt::format("options: closed: found {}; allowed: pairs from 1 to {}", number, p.pairs.size()));
    isep[static_cast<std::size_t>(number) - 1] = in_contact;
  }
  return isep;
}

given_states read_states(const request& r, const problem& p, const linear_structure& s) {
  given_states states{r.lists("displacement"), {}};
  const std::vector<std::vector<double>> closed = r.lists("closed");
  const std::size_t count = states.displacement.size();
  if (count == 0 || count > p.steps.size())
    throw std::invalid_argument(
        fmt::format("options: displacement: found {} states; allowed: one for each of the first "
                    "steps, from 1 to {}",
                    count, p.steps.size()));
  if (r.has("closed") && closed.size() != count)
    throw std::invalid_argument(fmt::format(
        "options: closed: found {} lists; allowed: {}, one for each state", closed.size(), count));
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<double>& u = states.displacement[i];
    if (std::ssize(u) != dofs(p.geometry))
      throw std::invalid_argument(
          fmt::format("options: displacement: found {} numbers; allowed: {}, one for each dof", u.size(),
                      dofs(p.geometry)));
    states.isep.push_back(closed.empty() ? statuses_at(p, s, u) : statuses_in(p, closed[i]));
  }
  return states;
}

void certify_states(const char* text, const char* options, served_answer& a) {
  const request asked(options, {"file", "folder", "allow_outside", "displacement", "closed"});
  const problem p = read_problem_text(text, asked.file(), asked.allowed(), a);
  const linear_structure s = structure_of(p);
  const given_states states = read_states(asked, p, s);
  run_result r(p, s, exact_means_of(p));
  r.engine = "given";
  for (std::size_t i = 0; i < states.displacement.size(); ++i) {
    const std::unique_ptr<stiffness_engine> factored = make_engine("refactor", s);
    for (std::size_t pair = 0; pair < p.pairs.size(); ++pair)
      if ((states.isep[i][pair] == in_contact) != p.pairs[pair].closed)
        factored->switch_spring(static_cast<int>(pair), states.isep[i][pair] == in_contact);
    r.end.step = static_cast<int>(i) + 1;
    const step_state given{r.end.step, 1.0, states.displacement[i], states.isep[i],
                           factored->reciprocal_condition()};
    r.judged.step_ended(given);
    r.record.step_ended(given);
  }
  output_file out(&a.result);
  write_result(r, out);
  const std::vector<std::string> complaints = certificate_complaints(r);
  a.messages.insert(a.messages.end(), complaints.begin(), complaints.end());
  a.exit = r.judged.all_certified() ? exit_status::solved : exit_status::uncertified;
}

}  // namespace
}  // namespace contct

char* contct_certify(const char* text, const char* options) {
  return contct::answered([&](contct::served_answer& a) { contct::certify_states(text, options, a); });
}
