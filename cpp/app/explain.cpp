// contct explain: what the listing did in each increment of a run, for each pair, and why.
#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <optional>
#include <stdexcept>

#include "app/commands.hpp"
#include "app/exit_messages.hpp"
#include "app/outputs.hpp"
#include "app/problem_progress.hpp"
#include "app/streams.hpp"
#include "contct/compare/compare.hpp"
#include "contct/compare/explained_path.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/solve/engine.hpp"
#include "contct/text/terminal.hpp"
#include "contct/write/explain_json.hpp"
#include "contct/write/explain_text.hpp"
#include "contct/write/result_json.hpp"

namespace contct::app {
namespace {

/// All of `text` as a number from 1; 0 where it is none.
int number_in(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && value > 0 ? value : 0;
}

/// --step and --increment together; the latter may say both, as the table of `contct run` does: 2.1.
increments_wanted wanted_of(const explain_options& o) {
  increments_wanted wanted{o.step.value_or(0), 0};
  if (o.increment.empty()) return wanted;
  const std::size_t point = o.increment.find('.');
  const bool both = point != std::string::npos;
  const int step = both ? number_in(o.increment.substr(0, point)) : wanted.step;
  wanted.increment = number_in(both ? o.increment.substr(point + 1) : o.increment);
  if (wanted.increment == 0 || (both && step == 0))
    throw std::invalid_argument("--increment: found " + o.increment +
                                "; allowed: a whole number from 1, or STEP.INCREMENT as in 2.1");
  if (both && o.step && *o.step != step)
    throw std::invalid_argument(fmt::format(
        "--increment {} is in step {}, but --step is {}; allowed: one step", o.increment, step, *o.step));
  wanted.step = step;
  return wanted;
}

/// The leader must be the listing, built in: nobody else has its lines.
void refuse_kernels(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (facts_of_kernel(name).rule != "listing")
      throw std::invalid_argument(
          fmt::format("--kernels: \"{}\" follows another rule, and no line of the listing says what it does; "
                      "allowed: kernels with the listing's rule. What it does instead: "
                      "reference/corrected-rule.md, and contct run --free-run --kernels {},fortran",
                      name, name));
  }
  if (names[0].find(':') != std::string::npos)
    throw std::invalid_argument(fmt::format(
        "--kernels: \"{}\" comes from outside and cannot lead; allowed: a kernel that is built in, with this "
        "one second: --kernels fortran,{}",
        names[0], names[0]));
  if (names.size() > 2)
    throw std::invalid_argument(
        fmt::format("--kernels: found {}; allowed: one or two, the first one leads", names.size()));
  if (names.size() == 2 && names[0] == names[1])
    throw std::invalid_argument("--kernels: \"" + names[0] + "\" is named twice");
}

class explanation_run {
 public:
  explicit explanation_run(const explain_options& options)
      : options_(options),
        wanted_(wanted_of(options)),
        prints_(!options.quiet && !takes_standard_output({{"--json", options.json}})) {}

  exit_status go() {
    refuse_unknown_engine(options_.engine);
    refuse_kernels(options_.kernels);
    problem_ = read_with_progress(options_.file, options_.quiet);
    refuse_what_is_not_there();
    refuse_shared_outputs({{"--json", options_.json}}, {{"the problem", options_.file}});
    const std::unique_ptr<output_file> file = open_output({"--json", options_.json});
    const std::unique_ptr<kernel> leader = make_kernel(options_.kernels[0]);
    const int bytes = leader->facts().real_bytes;
    if (prints_)
      text_.emplace(problem_, options_.kernels, bytes, options_.pair.value_or(0), look_at_terminal());
    if (file) json_.emplace(problem_, options_.kernels, bytes, options_.pair.value_or(0), *file);
    explained_path told(leader->facts(), second(), wanted_, [this](const auto& i) { tell(i); });
    const linear_structure structure = build_with_progress(problem_, options_.quiet);
    path_progress shown(problem_.steps.size(), options_.quiet);
    const path_end end =
        follow(problem_, structure, options_.engine, *leader, {shown.before(), &told, shown.behind()});
    shown.erase();
    return finish(end, told);
  }

 private:
  [[nodiscard]] std::unique_ptr<kernel> second() const {
    if (options_.kernels.size() < 2) return nullptr;
    const kernel_facts leader = facts_of_kernel(options_.kernels[0]);
    refuse_unequal(leader, facts_of_kernel(options_.kernels[1]));
    return make_kernel(options_.kernels[1]);
  }

  void refuse_what_is_not_there() const {
    if (options_.pair) refuse_beyond("--pair", *options_.pair, problem_.pairs.size(), "pair");
    const std::optional<int> step = wanted_.step > 0 ? wanted_.step : options_.step;
    if (step) refuse_beyond("--step", *step, problem_.steps.size(), "step");
  }

  static void refuse_beyond(const char* option, int found, std::size_t most, const char* what) {
    if (found > 0 && static_cast<std::size_t>(found) <= most) return;
    throw std::invalid_argument(
        most == 0 ? fmt::format("{}: found {}, but the problem has no {}", option, found, what)
                  : fmt::format("{}: found {}; allowed: a {} from 1 to {}", option, found, what, most));
  }

  void tell(const explained_increment& i) {
    if (text_) text_->print(i);
    if (json_) json_->write(i);
  }

  exit_status finish(const path_end& end, const explained_path& told) {
    if (end.status == path_status::not_factored || told.explained() == 0) return nothing_told(end, told);
    if (text_) print_comparison(told);
    flush_standard_output();
    if (told.first())
      for (const std::string& line : words_of(*told.first())) complain("{}", line);
    if (end.status != path_status::solved) complain("{}: {}", options_.file, end_words(problem_, end));
    const bool equal = told.compared().mismatches == 0;
    if (json_) json_->finish(equal ? status_name(end.status) : "kernels-disagree", told);
    if (!equal) return exit_status::kernels_differ;
    return status_of(end.status);
  }

  /// No increment was wanted, or none was reached.
  [[nodiscard]] exit_status nothing_told(const path_end& end, const explained_path& told) const {
    if (end.status != path_status::solved) complain("{}: {}", options_.file, end_words(problem_, end));
    if (wanted_.step > told.steps())
      complain("--step: found {}; allowed: a step from 1 to {}: the path ends there", wanted_.step,
               told.steps());
    else if (wanted_.increment > told.most_increments())
      complain("--increment: found {}; allowed: an increment from 1 to {}{}", options_.increment,
               told.most_increments(),
               wanted_.step == 0 ? "" : fmt::format(", as many as step {} has", wanted_.step));
    const bool asked_for_more = wanted_.step > 0 || wanted_.increment > 0;
    return asked_for_more ? exit_status::bad_input : status_of(end.status);
  }

  void print_comparison(const explained_path& told) const {
    if (options_.kernels.size() < 2) return;
    const bool equal = told.compared().mismatches == 0;
    const terminal t = look_at_terminal();
    fmt::print("\n");
    const std::vector<std::string> items = {
        fmt::format("{} and {} {} to the bit in the whole run", options_.kernels[0], options_.kernels[1],
                    equal ? "are equal" : "are NOT equal"),
        fmt::format("{} calls, {} values compared, {} mismatches", told.calls(), told.compared().values,
                    told.compared().mismatches)};
    for (const std::string& line : wrap(items, t.width))
      fmt::print("{}\n", painted(t, equal ? paint::good : paint::bad, line));
  }

  const explain_options& options_;
  increments_wanted wanted_;
  bool prints_;
  problem problem_;
  std::optional<explain_text> text_;
  std::optional<explain_json> json_;
};

}  // namespace

exit_status run_command(const explain_options& options) {
  return explanation_run(options).go();
}

}  // namespace contct::app
