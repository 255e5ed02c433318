#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "contct/text/strings.hpp"
#include "contct/write/outputs.hpp"
#include "contct/write/result_json.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

json fractions(const rational_vector& numbers) {
  return list_of(numbers, [](const rational& x) { return fraction_words(x); });
}

/// The deflections of all nodes, from numbers at all dofs.
rational_vector deflections_in(const problem& p, const rational_vector& u) {
  const auto per_node = static_cast<std::size_t>(dofs_per_node(p.geometry));
  rational_vector w;
  for (std::size_t dof = 0; dof < u.size(); dof += per_node) w.push_back(u[dof]);
  return w;
}

json increment_json(const problem& p, const exact_increment& i, std::size_t number) {
  json entry = {{"increment", number + 1},
                {"fraction", fraction_words(i.fraction)},
                {"events", list_of(i.events, [&p](const event& e) { return event_json(p, e); })}};
  if (i.snaps) entry["snap"] = true;
  return entry;
}

json kernel_json(const kernel_digits& k) {
  json entry = {{"name", k.name}, {"same_events", k.same_events}, {"first_difference", nullptr}};
  if (!k.first_difference.empty()) entry["first_difference"] = k.first_difference;
  entry.update({{"digits", k.digits}, {"event_digits", k.event_digits}, {"force_digits", k.force_digits}});
  if (k.steps == 0) entry["digits"] = entry["force_digits"] = nullptr;
  return entry;
}

class exact_printer {
 public:
  exact_printer(const exact_run& r, int digits, const terminal& t) : r_(r), digits_(digits), terminal_(t) {}

  std::string text() {
    for (const std::string& line : wrap({on_one_line(r_.what.title)}, terminal_.width))
      if (!line.empty()) out_ += painted(terminal_, paint::strong, line) + "\n";
    for (std::size_t step = 0; step < r_.path.steps.size(); ++step) print_step(step);
    if (r_.path.mechanism) print_mechanism(*r_.path.mechanism);
    if (!r_.kernels.empty()) out_ += "\n";
    for (const kernel_digits& k : r_.kernels) print_kernel(k);
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::string number(const rational& x) const { return short_words(x, digits_); }

  /// The sum of the loads on deflections at the end of `step`, which counts from 1; 0 for step 0.
  [[nodiscard]] rational total_load(std::size_t step) const {
    rational sum;
    if (step == 0) return sum;
    for (const rational& x : deflections_in(r_.what, r_.exactly.steps[step - 1].force)) sum += x;
    return sum;
  }

  void print_step(std::size_t step) {
    const exact_step_end& s = r_.path.steps[step];
    const std::string& name = r_.what.steps[step].name;
    const std::string title =
        fmt::format("step {}{}", step + 1, name.empty() ? "" : ", " + on_one_line(name));
    out_ += fmt::format("{}{}\n", out_.empty() ? "" : "\n", painted(terminal_, paint::strong, title));
    const rational before = r_.exactly.steps[step].from_zero ? rational() : total_load(step);
    const rational added = total_load(step + 1) - before;
    for (const exact_increment& i : s.increments) {
      std::vector<std::string> events;
      for (const event& e : i.events)
        events.push_back(pair_words(r_.what, e.pair) +
                         (e.what == change::make ? " makes contact" : " breaks contact"));
      if (i.snaps) events.emplace_back("a rigid-body motion at constant load");
      out_ +=
          fmt::format("  share {}, load {}{}{}\n", number(i.fraction), number(before + i.fraction * added),
                      events.empty() ? "" : ": ", joined(events, ", "));
    }
    print_end(s);
  }

  void print_end(const exact_step_end& s) {
    const rational_vector w = deflections_in(r_.what, s.displacement);
    const auto largest =
        std::ranges::max_element(w, [](const rational& x, const rational& y) { return abs(x) < abs(y); });
    out_ += fmt::format("  largest w {} at {}\n", number(*largest),
                        place_words(r_.what.geometry, static_cast<int>(largest - w.begin())));
    if (s.isep.size() > most_rows) {
      out_ +=
          fmt::format("  {} of {} pairs in contact\n", std::ranges::count(s.isep, in_contact), s.isep.size());
      return;
    }
    for (std::size_t i = 0; i < s.isep.size(); ++i) {
      out_ +=
          fmt::format("  {}: w {}, {}\n", pair_words(r_.what, i), number(w[r_.what.pairs[i].node]),
                      s.isep[i] == in_contact ? "force " + number(s.force[i]) : "gap " + number(s.gap[i]));
    }
  }

  /// Prints the proof that a step has no equilibrium. The rigid-body motion is given by deflections of nodes.
  void print_mechanism(const mechanism_proof& proof) {
    const auto at = std::ranges::find(r_.path.steps, path_status::mechanism, &exact_step_end::status);
    const std::string where =
        starts_from_zero(r_.what)
            ? " of " + step_words(r_.what, static_cast<int>(at - r_.path.steps.begin()) + 1)
            : "";
    out_ += fmt::format(
        "\n{}{}: the supports and the pairs in contact allow this rigid-body motion, no other pair stops it, "
        "and the step's full load does work {} on it.\n  w",
        painted(terminal_, paint::bad, "no equilibrium"), where, number(proof.work));
    const rational_vector w = deflections_in(r_.what, proof.motion);
    for (std::size_t node = 0; node < w.size() && node < most_rows; ++node)
      out_ += (node == 0 ? " " : ", ") + number(w[node]);
    out_ += w.size() > most_rows ? ", ..\n" : "\n";
  }

  void print_kernel(const kernel_digits& k) {
    out_ += k.steps == 0
                ? fmt::format("{}: no end of a step to compare; ", k.name)
                : fmt::format(
                      "{}: {:.1f} digits of displacements, {:.1f} of forces, {:.1f} of the events' shares; ",
                      k.name, k.digits, k.force_digits, k.event_digits);
    out_ += k.same_events ? "the same events\n"
                          : painted(terminal_, paint::bad, "other events") + ": " + k.first_difference + "\n";
  }

  static constexpr std::size_t most_rows = 24;
  const exact_run& r_;
  int digits_;
  const terminal& terminal_;
  std::string out_;
};

}  // namespace

std::string exact_text(const exact_run& r, int digits, const terminal& t) {
  return exact_printer(r, digits, t).text();
}

void write_exact_json(const exact_run& r, output_file& out) {
  json_document document(
      out, {{"format", "contct-exact-1"}, {"title", r.what.title}, {"status", status_name(r.path.status())}},
      "steps");
  for (std::size_t step = 0; step < r.path.steps.size(); ++step) {
    const exact_step_end& s = r.path.steps[step];
    json members = {{"step", step + 1},
                    {"name", r.what.steps[step].name},
                    {"fraction", fraction_words(s.fraction)},
                    {"increments", nullptr},
                    {"displacement", fractions(s.displacement)},
                    {"w", fractions(deflections_in(r.what, s.displacement))},
                    {"pairs", nullptr},
                    {"reactions", nullptr}};
    if (r.what.steps[step].from_zero) members["start"] = "zero";
    document.add(members, {{"increments", s.increments.size(),
                            [&](auto i) { return increment_json(r.what, s.increments[i], i); }},
                           {"pairs", s.isep.size(),
                            [&](auto i) {
                              return pair_state_json(r.what, i, s.isep[i], fraction_words(s.gap[i]),
                                                     fraction_words(s.force[i]));
                            }},
                           {"reactions", s.reactions.size(), [&](auto i) {
                              return reaction_json(r.what, i, fraction_words(s.reactions[i]));
                            }}});
  }
  json members = {{"kernels", list_of(r.kernels, kernel_json)}};
  if (r.path.mechanism)
    members["mechanism"] = {{"motion", fractions(r.path.mechanism->motion)},
                            {"work", fraction_words(r.path.mechanism->work)}};
  document.finish(members);
}

}  // namespace contct
