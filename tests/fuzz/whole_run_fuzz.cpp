// A problem made from bytes, and all that the program does with one: its path on every engine, its
// certificates, its exact path, and every file that is written of it, read back. With CONTCT_SHOW in the
// environment the problem is printed.
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>

#include "app/outputs.hpp"
#include "contct/compare/explanation.hpp"
#include "contct/exact/exact_means.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/serve/exact_run.hpp"
#include "contct/serve/states.hpp"
#include "contct/session/run.hpp"
#include "contct/write/exact_output.hpp"
#include "contct/write/explain.hpp"
#include "contct/write/pictures.hpp"
#include "contct/write/words.hpp"
#include "fuzz/fuzz.hpp"
#include "fuzz/problem_from_bytes.hpp"
#include "fuzz/read_back.hpp"
#include "support/scratch_folder.hpp"

namespace contct::fuzz {
namespace {

using namespace contct::app;

constexpr int most_increments = 200;

/// What is printed to standard output goes to memory.
class captured_output {
 public:
  captured_output() : memory_(memfd_create("printed", 0)) {
    require(memory_ >= 0 && dup2(memory_, STDOUT_FILENO) >= 0, "standard output goes to memory");
  }

  /// What was printed since the last call.
  [[nodiscard]] std::string take() const {
    flush_standard_output();
    std::string text(static_cast<std::size_t>(lseek(memory_, 0, SEEK_CUR)), '\0');
    require(pread(memory_, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size()),
            "memory is read");
    require(ftruncate(memory_, 0) == 0 && lseek(memory_, 0, SEEK_SET) == 0, "memory is emptied");
    return text;
  }

 private:
  int memory_;
};

/// The ends of the steps that a path reached, each with its certificate.
struct certified_ends final : observer {
  explicit certified_ends(const problem& p) : what(p) {}

  void step_ended(const step_state& s) override {
    displacement.emplace_back(s.displacement.begin(), s.displacement.end());
  }

  /// The bound on a dof's displacement at the end of a step, from 0; none where nothing is proved.
  [[nodiscard]] std::optional<double> bound(std::size_t step, std::size_t dof) const {
    const auto& c = step < certificates.size() ? certificates[step] : std::optional<certificate>();
    if (!c || !c->proved || !c->unique) return std::nullopt;
    return c->error[dof % dofs_per_node(what.geometry) == 0 ? quantity::w : quantity::slope];
  }

  const problem& what;
  std::vector<std::optional<certificate>> certificates;  // of the run that told the ends
  std::vector<std::vector<double>> displacement;
};

/// Two proofs about one state: their bounds must overlap.
void check_overlap(const certified_ends& a, const certified_ends& b, std::string_view names) {
  for (std::size_t step = 0; step < std::min(a.displacement.size(), b.displacement.size()); ++step) {
    for (std::size_t dof = 0; dof < a.displacement[step].size(); ++dof) {
      const auto bound_a = a.bound(step, dof);
      const auto bound_b = b.bound(step, dof);
      if (!bound_a || !bound_b) continue;
      const double apart = std::abs(a.displacement[step][dof] - b.displacement[step][dof]);
      require(apart <= *bound_a + *bound_b, "proved bounds overlap",
              fmt::format("{}, step {}, dof {}: apart {}, bounds {} and {}", names, step + 1, dof + 1, apart,
                          *bound_a, *bound_b));
    }
  }
}

/// One problem on its way through the program.
class whole_run {
 public:
  whole_run(const problem& p, FuzzedDataProvider& bytes, const captured_output& printed)
      : p_(p),
        file_("p" + words_from(bytes)),
        leader_(bytes.PickValueInArray({"fortran", "cpp", "corrected"})),
        engine_(engine_names()[bytes.ConsumeIntegralInRange<std::size_t>(0, engine_names().size() - 1)]),
        is_detailed_(bytes.ConsumeBool()),
        structure_(structure_of(p)),
        printed_(printed),
        ends_(p_) {}

  void go() {
    try {
      follow_and_write();
    } catch (const std::invalid_argument&) {  // the engine does not suit
      engine_ = "refactor";
      ends_.displacement.clear();
      follow_and_write();
    }
    for (const std::string& name : engine_names())
      if (name != engine_) follow_on(name, {leader_});
    follow_on("", {});
    if (has_listings_rule()) explain_it();
  }

  void go_exactly() {
    exact_problem e = exactly_read(p_, file_);
    constexpr std::size_t longest = 20'000;
    e.longest = std::min(e.longest, longest);
    const exact_path path = follow_exactly(e, "corrected", file_);
    const std::vector<kernel_digits> kernels = {digits_of_kernel("cpp", p_, structure_, path)};
    const exact_result r{p_, e, path, kernels};
    std::string text;
    output_file out(&text);
    write_exact_json(r, out);
    require(json_in(text, "an exact path")["steps"].size() == path.steps.size(), "an exact path's steps");
    check_printed(exact_text(r, 30, terminal{}));
    for (std::size_t step = 0; step < std::min(path.steps.size(), ends_.displacement.size()); ++step) {
      if (path.steps[step].fraction != 1) continue;
      for (std::size_t dof = 0; dof < ends_.displacement[step].size(); ++dof) {
        const auto bound = ends_.bound(step, dof);
        if (!bound) continue;
        const double apart = std::abs(
            rounded(path.steps[step].displacement[dof] - binary_value(ends_.displacement[step][dof])));
        require(apart <= *bound, "a proved bound holds",
                fmt::format("step {}, dof {}: off by {}, bound {}", step + 1, dof + 1, apart, *bound));
      }
    }
  }

 private:
  [[nodiscard]] bool has_listings_rule() const { return leader_ != "corrected"; }

  /// A run on an engine, of the leader and those that are compared with it, or of the ends alone.
  [[nodiscard]] session::run_request request_for(const std::string& engine,
                                                 std::vector<std::string> kernels) const {
    return {.file = file_,
            .kernels = std::move(kernels),
            .engine = engine,
            .envelope = true,
            .pictures = true,
            .max_increments = most_increments};
  }

  void follow_and_write();
  void read_back_pictures(const finished_run& r);
  void read_back_reports(const path_end& end);

  /// The same path on an engine, where that suits; without kernels the ends alone.
  void follow_on(const std::string& name, const std::vector<std::string>& kernels) {
    certified_ends ends(p_);
    session::run run(p_, structure_, request_for(name, kernels));
    try {
      run.go({}, {&ends});
    } catch (const std::invalid_argument&) {
      return;
    }
    ends.certificates = run.judged.steps();
    check_overlap(ends_, ends, engine_ + " and " + (kernels.empty() ? "the ends alone" : name));
  }

  void explain_it() {
    const std::unique_ptr<kernel> leader = make_kernel(leader_);
    const explained_kernels of{p_, {leader_}, 8, 0};
    std::string text;
    output_file out(&text);
    explain_json json(of, out);
    explain_text words(of, terminal{}, {is_detailed_, true});
    std::size_t told = 0;
    explained_path path(leader->facts(), nullptr, {}, [&](const explained_increment& i) {
      words.print(i);
      json.write(i, nullptr);
      ++told;
    });
    const path_end end = follow(p_, structure_, "refactor", *leader, {&path}, {most_increments});
    words.finish();
    json.finish(status_name(end.status), path);
    require(json_in(text, "an explanation")["increments"].size() == told, "an explanation's increments");
    check_printed(printed_.take());
  }

  const problem& p_;
  std::string file_;
  std::string leader_;
  std::string engine_;
  bool is_detailed_;
  linear_structure structure_;
  const captured_output& printed_;
  certified_ends ends_;
};

/// An output in memory.
struct kept_text {
  std::string text = {};
  output_file file{&text};
};

/// All that `contct run` makes, in memory.
void whole_run::follow_and_write() {
  std::vector<std::string> kernels = {leader_};
  if (has_listings_rule()) kernels.emplace_back(leader_ == "cpp" ? "fortran" : "cpp");
  kept_text result, increments, pairs, trace, proof;
  session::run run(p_, structure_, request_for(engine_, kernels));
  table rows(p_, run.compared(), run.judged, terminal{}, is_detailed_);
  run.go({.result = &result.file,
          .trace = &trace.file,
          .proof = &proof.file,
          .table = &increments.file,
          .pairs = &pairs.file},
         {&ends_, &rows});
  ends_.certificates = run.judged.steps();
  require(run.compares.equal, "FORTRAN and C++ are equal to the bit");
  if (run.end.status == path_status::not_factored) return (void)printed_.take();
  run.finish();
  const auto document = json_in(result.text, "a result");
  require(document["steps"].size() == run.judged.steps().size(), "a result's steps");
  require(document["status"] == run.status(), "a result's status");
  require(document["title"] == p_.title, "a result's title");
  const bool moved = run.end.status != path_status::mechanism;  // one may begin as a mechanism
  require(rows_in_csv(increments.text).size() > (moved ? 1 : 0), "a table of increments");
  const std::size_t states = rows_in_csv(increments.text).size() - 1;
  require(rows_in_csv(pairs.text).size() == 1 + states * p_.pairs.size(), "a table of pairs");
  trace_reader calls(trace.text, "trace");
  (void)calls.read_header();
  recorded_call call;
  std::int64_t count = 0;
  while (calls.next(call)) ++count;
  require(run.compared() == nullptr || count == run.compared()->calls(), "a trace's calls");
  require(json_in(proof.text, "a proof")["steps"].size() <= run.judged.steps().size(), "a proof's steps");
  for (const std::string& line : rows.legend()) print_text(line + "\n");
  check_printed(printed_.take());
  read_back_pictures(run.finished());
  read_back_reports(run.end);
}

void whole_run::read_back_pictures(const finished_run& r) {
  const auto data = data_in_page(run_page(r));
  require(data == nlohmann::json::parse(
                      page_data(r).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)),
          "a page has its data");
  (void)json_in(states_json(r), "states");
  const auto* a = std::get_if<assembled>(&p_.geometry.kind);
  if (a != nullptr && !a->places.known()) return;
  for (const frame& f : r.kept.frames()) check_vtu(vtu_of_frame(p_, f));
  (void)xml_in(pvd_of_frames(file_, r.kept.frames().size()), "VTKFile");
}

void whole_run::read_back_reports(const path_end& end) {
  check_report report{"contct run", common_facts(), {}, 0.0};
  report.facts.push_back(file_);
  report.results = {{"kernels", outcome::passed, p_.title, ""},
                    {file_, outcome::failed, end_words(p_, end), p_.title},
                    {p_.title, outcome::skipped, file_, end_words(p_, end)}};
  require(xml_in(junit_xml(report), "testsuites").all("testcase").size() == report.results.size(),
          "a report's cases");
  check_markdown(markdown(report), report.results.size());
}

/// Where problems' files are: in memory.
const scratch_folder& scratch() {
  static const scratch_folder folder = [] {
    setenv("TMPDIR", "/dev/shm", 1);
    return scratch_folder();
  }();
  return folder;
}

}  // namespace
}  // namespace contct::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace contct::fuzz;
  using contct::read::parse_problem;
  static const captured_output printed;
  FuzzedDataProvider bytes(data, size);
  const bool exactly = bytes.ConsumeIntegralInRange(1, 6) == 1;
  const made_problem made = problem_from(bytes);
  for (const auto& [name, text] : made.files) (void)scratch().write(name, text);
  if (std::getenv("CONTCT_SHOW") != nullptr) (void)std::fputs(made.text.c_str(), stderr);
  const std::string file = scratch().at("problem.toml");
  contct::structure::problem p;
  if (!is_read([&] { p = parse_problem(made.text, file); })) return 0;
  try {
    whole_run run(p, bytes, printed);
    run.go();
    constexpr int most_dofs = 24;
    if (exactly && dofs(p.geometry) <= most_dofs) run.go_exactly();
  } catch (const std::invalid_argument&) {
    (void)printed.take();  // refused, as the program does
  } catch (const contct::text::input_error&) {
    (void)printed.take();
  }
  return 0;
}
