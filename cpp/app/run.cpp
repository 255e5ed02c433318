// contct run: follow the path of a problem, all kernels in lockstep.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>

#include "app/commands.hpp"
#include "app/endings.hpp"
#include "contct/check/free_run.hpp"
#include "contct/check/lockstep.hpp"
#include "contct/io/output_file.hpp"
#include "contct/io/problem_file.hpp"
#include "contct/io/result_json.hpp"
#include "contct/io/table.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/numeric/probe.hpp"
#include "contct/path/engine.hpp"
#include "contct/path/path.hpp"

namespace contct {
namespace {

struct run_options {
  std::string file;
  std::vector<std::string> kernels = {"fortran", "cpp"};
  std::string engine = "refactor";
  std::string json;
  std::string log;
  bool free_run = false;
  int max_increments = 0;
};

/// Keeps what the leader writes to unit 26.
class log_writer final : public observer {
 public:
  explicit log_writer(output_file& out) : out_(out) {}
  void called(const answered_call& c) override { out_.write(c.text); }

 private:
  output_file& out_;
};

/// "1 node", "3 nodes".
template <class Count>
std::string counted(Count n, std::string_view what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

exit_status status_of(path_status status) {
  switch (status) {
    case path_status::solved:
      return exit_status::solved;
    case path_status::mechanism:
      return exit_status::mechanism;
    case path_status::not_factored:
      return exit_status::bad_input;
    default:
      return exit_status::iteration_limit;
  }
}

/// One run of `contct run`.
class run {
 public:
  explicit run(const run_options& options)
      : options_(options),
        problem_(read_problem(options.file)),
        terminal_(look_at_terminal()),
        shows_table_(options.json != "-" && options.log != "-") {
    for (const std::string& w : problem_.warnings) fmt::print(stderr, "contct: warning: {}\n", w);
    (void)make_engine(options.engine, structure_);  // refuses an unknown name before anything is printed
    structure_ = build(problem_.geometry, problem_.supports, problem_.pairs);
    if (options.json == "-" && options.log == "-")
      throw std::invalid_argument("--json and --log cannot both be -");
  }

  exit_status go() {
    refuse_repeated_kernels();
    path_record record;
    if (options_.free_run) return free_run(record);
    const std::unique_ptr<kernel> leader = make_kernel(options_.kernels.at(0));
    std::unique_ptr<lockstep> compared;
    if (options_.kernels.size() > 1) compared = make_lockstep(*leader);
    begin();
    const path_end end = follow(*leader, observers(compared.get(), nullptr));
    if (compared == nullptr) return finish(end, true, nullptr);
    report_lockstep(*compared);
    return finish(end, compared->compared().mismatches == 0, compared.get());
  }

 private:
  void refuse_repeated_kernels() const {
    for (std::size_t i = 0; i < options_.kernels.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        if (options_.kernels[i] == options_.kernels[k]) {
          throw std::invalid_argument("--kernels: \"" + options_.kernels[i] + "\" is named twice");
        }
      }
    }
  }

  [[nodiscard]] std::unique_ptr<lockstep> make_lockstep(const kernel& leader) const {
    std::vector<std::unique_ptr<kernel>> followers;
    for (std::size_t i = 1; i < options_.kernels.size(); ++i)
      followers.push_back(make_kernel(options_.kernels[i]));
    return std::make_unique<lockstep>(leader.facts(), std::move(followers));
  }

  /// Open the output files before anything is solved, and print what is about to be.
  void begin() {
    open_outputs();
    print_heading();
  }

  void open_outputs() {
    if (!options_.json.empty()) {
      json_file_.emplace(options_.json);
      json_.emplace(problem_, options_.kernels, options_.engine, *json_file_);
    }
    if (!options_.log.empty()) {
      log_file_.emplace(options_.log);
      log_.emplace(*log_file_);
    }
  }

  std::vector<observer*> observers(lockstep* compared, path_record* record) {
    std::vector<observer*> all;
    if (compared != nullptr) all.push_back(compared);
    if (shows_table_) all.push_back(&table_.emplace(problem_, compared, terminal_));
    if (json_) all.push_back(&*json_);
    if (log_) all.push_back(&*log_);
    if (record != nullptr) all.push_back(record);
    all.push_back(&digits_);
    return all;
  }

  path_end follow(kernel& k, const std::vector<observer*>& watching) const {
    const std::unique_ptr<stiffness_engine> engine = make_engine(options_.engine, structure_);
    const load_history total = [this](int step, std::span<double> f) {
      add_consistent_loads(problem_.geometry, problem_.steps[static_cast<std::size_t>(step - 1)], f);
    };
    return follow_path(structure_, static_cast<int>(problem_.steps.size()), total, *engine, k, watching,
                       {options_.max_increments});
  }

  void print_heading() const {
    if (!shows_table_) return;
    if (!problem_.title.empty()) fmt::print("{}\n", painted(terminal_, paint::strong, problem_.title));
    const std::vector<std::string> facts = {
        fmt::format("{}, {}, {}", counted(problem_.geometry.nodes(), "node"),
                    counted(problem_.pairs.size(), "pair"), counted(problem_.steps.size(), "step")),
        fmt::format("kernels {}", fmt::join(options_.kernels, ", ")), "engine " + options_.engine};
    for (const std::string& line : wrap(facts, terminal_.width)) fmt::print("{}\n", line);
    fmt::print("\n");
  }

  void print_verdict(bool good, const std::vector<std::string>& items) const {
    if (!shows_table_) return;
    fmt::print("\n");
    for (const std::string& line : wrap(items, terminal_.width)) {
      fmt::print("{}\n", painted(terminal_, good ? paint::good : paint::bad, line));
    }
  }

  /// Say how the comparison came out. A mismatch under a bad probe is the environment's.
  void report_lockstep(const lockstep& compared) const {
    const tally& t = compared.compared();
    const bool equal = t.mismatches == 0;
    print_verdict(equal, {fmt::format("{} {} to the bit", fmt::join(options_.kernels, " and "),
                                      equal ? "are equal" : "are NOT equal"),
                          fmt::format("{} calls, {} values compared, {} mismatches", compared.calls(),
                                      t.values, t.mismatches)});
    if (!compared.first()) return;
    const first_divergence& d = *compared.first();
    fmt::print(stderr, "contct: call {}: {} differs in {}{}: {} has {}, {} has {} ({} ULP)\n", d.call,
               d.follower, d.where.field, d.where.index > 0 ? fmt::format("({})", d.where.index) : "",
               options_.kernels[0], d.where.leader, d.follower, d.where.follower, d.where.ulps);
    const floating_point fp = probe_floating_point();
    if (!fp.strict()) fmt::print(stderr, "contct: environment, not kernel: {}\n", describe(fp));
  }

  /// Drive every kernel on a path of its own, one after the other: unit 26 is there only once.
  exit_status free_run(path_record& record) {
    for (const std::string& name : options_.kernels)
      (void)make_kernel(name);  // all exist, before anything is written
    begin();
    std::unique_ptr<kernel> leader = make_kernel(options_.kernels[0]);
    const kernel_facts leader_facts = leader->facts();
    record.end = follow(*leader, observers(nullptr, &record));
    leader.reset();
    bool all_within = true;
    for (std::size_t i = 1; i < options_.kernels.size(); ++i) {
      const std::unique_ptr<kernel> other = make_kernel(options_.kernels[i]);
      path_record own;
      own.end = follow(*other, {&own});
      const free_run_difference d =
          compare_paths(record, own, free_run_bound(leader_facts, other->facts()), structure_.dofs_per_node);
      all_within = all_within && d.within_bound();
      if (json_) json_->add_free_run(other->facts().name, d);
      report_free_run(other->facts().name, d);
    }
    return finish(record.end, all_within, nullptr);
  }

  void report_free_run(const std::string& name, const free_run_difference& d) const {
    print_verdict(
        d.within_bound(),
        {fmt::format("{} on a path of its own: events {}", name, d.same_events ? "the same" : "DIFFERENT"),
         fmt::format("load fractions within {:.2g}, D within {:.2g} (bound {:.0e})", d.fraction,
                     d.displacement, d.bound)});
    if (!d.first_difference.empty())
      fmt::print(stderr, "contct: {}: first difference: {}\n", name, d.first_difference);
    for (const auto& [what, difference] : {std::pair("a load fraction", d.fraction), {"D", d.displacement}}) {
      if (difference <= d.bound) continue;
      fmt::print(stderr, "contct: {}: {} differs by {:.2g}; allowed: {:.0e}\n", name, what, difference,
                 d.bound);
    }
  }

  exit_status finish(const path_end& end, bool equal, const lockstep* compared) {
    (void)std::fflush(stdout);
    if (end.status == path_status::solved) {
      if (const std::string w = digits_.warning(); !w.empty()) fmt::print(stderr, "contct: warning: {}\n", w);
    } else {
      fmt::print(stderr, "contct: {}: {}\n", options_.file, end_words(problem_, end));
    }
    const exit_status status = equal ? status_of(end.status) : exit_status::kernels_differ;
    if (status == exit_status::bad_input) return status;  // no numbers, and no files
    if (json_) json_->finish(equal ? status_name(end.status) : "kernels-disagree", end, compared);
    if (log_) log_file_->finish();
    return status;
  }

  const run_options& options_;
  problem problem_;
  terminal terminal_;
  linear_structure structure_;
  bool shows_table_;
  std::optional<output_file> json_file_, log_file_;
  std::optional<result_json> json_;
  std::optional<log_writer> log_;
  std::optional<table> table_;
  digit_watch digits_;
};

}  // namespace

void add_run(CLI::App& program, exit_status& status) {
  auto options = std::make_shared<run_options>();
  CLI::App* const command =
      program.add_subcommand("run", "Follow the path of a problem, all kernels in lockstep");
  command->add_option("FILE", options->file, "The problem (TOML); - reads standard input")->required();
  command->add_option("--kernels", options->kernels, "Kernels to run, the first one leads")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--engine", options->engine, "How the stiffness equations are solved")
      ->capture_default_str();
  command->add_flag("--free-run", options->free_run,
                    "Drive each kernel on a path of its own; compare events, load fractions and D");
  command->add_option("--max-increments", options->max_increments, "Limit of increments in a step")
      ->check(CLI::PositiveNumber);
  command->add_option("--json", options->json, "Write the result to this file (- is standard output)");
  command->add_option("--log", options->log, "Write what the leader writes to unit 26 to this file");
  command->callback([options, &status] { status = run(*options).go(); });
}

}  // namespace contct
