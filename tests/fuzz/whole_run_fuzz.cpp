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
#include "contct/exact/exact_follower.hpp"
#include "contct/exact/exact_residual.hpp"
#include "contct/matrix/lapack_identity.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/serve/exact_run.hpp"
#include "contct/serve/states.hpp"
#include "contct/write/exact_output.hpp"
#include "contct/write/explain.hpp"
#include "contct/write/pictures.hpp"
#include "contct/write/proof_json.hpp"
#include "contct/write/result_json.hpp"
#include "contct/write/run_words.hpp"
#include "contct/write/table.hpp"
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
  certified_ends(const problem& p, const linear_structure& s)
      : what(p), judged(p, s, exact::exact_residual_of(p), exact::semidefinite_test_of(p)) {}

  void step_ended(const step_state& s) override {
    displacement.emplace_back(s.displacement.begin(), s.displacement.end());
  }

  /// The bound on a dof's displacement at the end of a step, from 0; none where nothing is proved.
  [[nodiscard]] std::optional<double> bound(std::size_t step, std::size_t dof) const {
    const auto& c = step < judged.steps().size() ? judged.steps()[step] : std::optional<certificate>();
    if (!c || !c->proved || !c->unique) return std::nullopt;
    return c->error[dof % dofs_per_node(what.geometry) == 0 ? quantity::w : quantity::slope];
  }

  const problem& what;
  certifier judged;
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
        leader_(make_kernel(bytes.PickValueInArray({"fortran", "cpp", "corrected"}))),
        engine_(engine_names()[bytes.ConsumeIntegralInRange<std::size_t>(0, engine_names().size() - 1)]),
        is_detailed_(bytes.ConsumeBool()),
        structure_(structure_of(p)),
        printed_(printed),
        ends_(p_, structure_) {}

  void go() {
    follow_and_write();
    for (const std::string& name : engine_names()) follow_on(name);
    find_ends();
    if (leader_->facts().rule == "listing") explain_it();
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
  [[nodiscard]] path_limits limits(certifier& judged) const {
    return {most_increments, judged.fallback(), judged.refiner(), exact::exact_follower_of(p_)};
  }

  void follow_and_write();
  void read_back_pictures(const finished_run& r);
  void read_back_reports(const path_end& end, bool equal);

  /// The same path on an engine, where that suits.
  void follow_on(const std::string& name) {
    if (name == engine_) return;
    certified_ends ends(p_, structure_);
    try {
      (void)follow(p_, structure_, name, *leader_, {&ends.judged, &ends}, limits(ends.judged));
    } catch (const std::invalid_argument&) {
      return;
    }
    check_overlap(ends_, ends, engine_ + " and " + name);
  }

  /// The ends alone, without a path.
  void find_ends() {
    certified_ends ends(p_, structure_);
    observer* const watching[] = {&ends.judged, &ends};
    (void)find_final_states(structure_, static_cast<int>(p_.steps.size()), loads_of(p_, structure_), watching,
                            &ends.judged);
    check_overlap(ends_, ends, "path and final states");
  }

  void explain_it() {
    const explained_kernels of{p_, {leader_->facts().name}, 8, 0};
    std::string text;
    output_file out(&text);
    explain_json json(of, out);
    explain_text words(of, terminal{}, {is_detailed_, true});
    std::size_t told = 0;
    explained_path path(leader_->facts(), nullptr, {}, [&](const explained_increment& i) {
      words.print(i);
      json.write(i, nullptr);
      ++told;
    });
    const path_end end = follow(p_, structure_, "refactor", *leader_, {&path}, {most_increments});
    words.finish();
    json.finish(status_name(end.status), path);
    require(json_in(text, "an explanation")["increments"].size() == told, "an explanation's increments");
    check_printed(printed_.take());
  }

  const problem& p_;
  std::string file_;
  std::unique_ptr<kernel> leader_;
  std::string engine_;
  bool is_detailed_;
  linear_structure structure_;
  const captured_output& printed_;
  certified_ends ends_;
};

/// All that `contct run` makes, in memory.
void whole_run::follow_and_write() {
  const std::string other = leader_->facts().name == "cpp" ? "fortran" : "cpp";
  const std::vector<std::string> others(leader_->facts().rule == "listing" ? 1 : 0, other);
  lockstep compared = make_lockstep(leader_->facts(), others);
  lockstep* const watched = others.empty() ? nullptr : &compared;
  std::string result_text;
  std::string increments_text;
  std::string pairs_text;
  std::string trace_text;
  output_file result_file(&result_text);
  output_file increments_file(&increments_text);
  output_file pairs_file(&pairs_text);
  std::vector<std::string> names = {leader_->facts().name};
  names.insert(names.end(), others.begin(), others.end());
  certifier& judged = ends_.judged;
  judged.keep_proofs();
  early_toggles early;
  passage_watch passages{p_};
  digit_watch digits;
  table rows(p_, watched, judged, terminal{}, is_detailed_);
  result_json result(p_, names, engine_, judged, result_file);
  trace_header header = header_for(leader_->facts(), "none", lapack_identity());
  header.about = {"every call of " + on_one_line(file_), on_one_line(p_.title)};
  trace_recorder trace(header, [&trace_text](std::string_view text) { trace_text += text; });
  frame_keeper frames(structure_, loads_of(p_, structure_), watched == nullptr);
  run_record record(watched);
  envelope extremes(p_);
  frames.show_each_to([&extremes](const frame& f) { extremes.take(f); });
  run_csv tables(p_, watched, frames, 0, increments_file, &pairs_file);
  std::vector<observer*> watching = {watched, &judged,   &ends_, &early,  &rows,   &result,
                                     &digits, &passages, &trace, &frames, &record, &tables};
  std::erase(watching, nullptr);
  path_end end;
  try {
    end = follow(p_, structure_, engine_, *leader_, watching, limits(judged));
  } catch (const std::invalid_argument&) {  // the engine does not suit
    engine_ = "refactor";
    end = follow(p_, structure_, engine_, *leader_, watching, limits(judged));
  }
  const bool equal = compared.compared().mismatches == 0;
  require(equal, "FORTRAN and C++ are equal to the bit");
  if (end.status == path_status::not_factored) return (void)printed_.take();
  const std::string status(status_name(end.status));
  result.finish(status, end, watched, &extremes);
  tables.finish();
  const auto document = json_in(result_text, "a result");
  require(document["steps"].size() == judged.steps().size(), "a result's steps");
  require(document["status"] == status, "a result's status");
  require(document["title"] == p_.title, "a result's title");
  const bool moved = end.status != path_status::mechanism;  // one may begin as a mechanism
  require(rows_in_csv(increments_text).size() > (moved ? 1 : 0), "a table of increments");
  const std::size_t states = rows_in_csv(increments_text).size() - 1;
  require(rows_in_csv(pairs_text).size() == 1 + states * p_.pairs.size(), "a table of pairs");
  trace_reader calls(trace_text, "trace");
  (void)calls.read_header();
  recorded_call call;
  std::int64_t count = 0;
  while (calls.next(call)) ++count;
  require(watched == nullptr || count == compared.calls(), "a trace's calls");
  const auto proof = json_in(proof_json(p_, judged), "a proof");
  require(proof["steps"].size() <= judged.steps().size(), "a proof's steps");
  for (const std::string& line : rows.legend()) print_text(line + "\n");
  check_printed(printed_.take());
  const finished_run r{p_,
                       frames,
                       record,
                       judged,
                       early,
                       file_,
                       names,
                       engine_,
                       status,
                       end_words(p_, end),
                       watched != nullptr,
                       equal,
                       "compared",
                       {"contct 0"},
                       "",
                       &extremes};
  read_back_pictures(r);
  read_back_reports(end, equal);
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

void whole_run::read_back_reports(const path_end& end, bool equal) {
  check_report report{"contct run", common_facts(), {}, 0.0};
  report.facts.push_back(file_);
  report.results = {{"kernels", passed_if(equal), p_.title, ""},
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
