#include "app/run_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "app/streams.hpp"
#include "contct/write/pictures.hpp"

namespace contct::app {
namespace {

namespace fs = std::filesystem;

/// "out.pairs.csv" beside "out.csv"; none beside standard output.
std::string pairs_table(const std::string& csv) {
  if (csv.empty() || csv == "-") return "";
  const fs::path path(csv);
  return (path.parent_path() / (path.stem().string() + ".pairs" + path.extension().string())).string();
}

/// "out" of "folder/out.vtu", with its folder or without.
std::string stem_of(const std::string& vtu) {
  return fs::path(vtu).stem().string();
}
std::string beside(const std::string& vtu, const std::string& name) {
  return (fs::path(vtu).parent_path() / name).string();
}
std::string collection(const std::string& vtu) {
  return vtu.empty() ? "" : beside(vtu, stem_of(vtu) + ".pvd");
}

}  // namespace

std::vector<output_option> with_pictures(std::vector<output_option> others, const picture_options& options) {
  others.push_back({"--html", options.html});
  others.push_back({"--svg", options.svg});
  others.push_back({"--csv", options.csv});
  others.push_back({"--csv (its pairs)", pairs_table(options.csv)});
  if (options.vtu.empty()) return others;
  if (fs::path(options.vtu).extension() != ".vtu")
    throw std::invalid_argument(
        fmt::format("--vtu: found \"{}\"; allowed: a file that ends in .vtu", options.vtu));
  others.push_back({"--vtu", options.vtu});
  others.push_back({"--vtu (its collection)", collection(options.vtu)});
  for (std::size_t i = 0; i < frame_limits{}.most_frames; ++i)
    others.push_back({"--vtu (its increments)", beside(options.vtu, name_of_frame(stem_of(options.vtu), i))});
  return others;
}

void check_grid_coordinates(const problem& p) {
  const auto* a = std::get_if<assembled>(&p.geometry.kind);
  if (a == nullptr) return;
  if (!a->places.known())
    throw std::invalid_argument(fmt::format(
        "--vtu: found a structure given by its matrix, {}, without coordinates; allowed: one with "
        "coordinates, "
        "by coordinates = \"FILE\" in [matrix] or CalculiX's mesh, JOB.inp beside its matrix or mesh = "
        "\"FILE\" in [calculix]. --csv and --json have all its numbers, by label",
        a->name));
  const auto lost = std::count_if(p.pairs.begin(), p.pairs.end(),
                                  [a](const contact_pair& c) { return a->places.dofs[c.node].node < 0; });
  if (lost > 0)
    complain("warning: --vtu: {} of {} pairs {} no cell: the places of their dofs are not known", lost,
             p.pairs.size(), lost == 1 ? "has" : "have");
}

run_pictures::run_pictures(const picture_options& options)
    : options_(options),
      html_(open_output({"--html", options.html})),
      svg_(open_output({"--svg", options.svg})),
      csv_(open_output({"--csv", options.csv})),
      csv_pairs_(open_output({"--csv", pairs_table(options.csv)})),
      vtu_(open_output({"--vtu", options.vtu})),
      pvd_(open_output({"--vtu", collection(options.vtu)})) {}

std::vector<observer*> run_pictures::observe(const problem& p, const linear_structure& s,
                                             const load_history& loads, const lockstep* compared,
                                             bool forces_by_law) {
  std::vector<observer*> watching;
  if (options_.wants_frames()) {
    watching.push_back(&kept_.emplace(s, loads, forces_by_law));
    watching.push_back(&record_.emplace(compared));
  }
  if (csv_) watching.push_back(&tables_.emplace(p, compared, *csv_, csv_pairs_.get()));
  return watching;
}

void run_pictures::finish(const std::function<finished_run()>& r) {
  if (tables_) tables_->finish();
  if (!wants_frames()) return;
  const finished_run run = r();
  if (html_) write_whole(html_, run_page(run));
  if (svg_) write_whole(svg_, run_svg(run));
  if (vtu_) finish_vtu(run);
}

/// The collection last: whoever sees it finds all that it names.
void run_pictures::finish_vtu(const finished_run& r) {
  const std::string stem = stem_of(options_.vtu);
  const auto& frames = r.kept.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto file = std::make_unique<output_file>(beside(options_.vtu, name_of_frame(stem, i)));
    write_whole(file, vtu_of_frame(r.what, frames[i]));
  }
  write_whole(vtu_, vtu_of_frame(r.what, frames.back()));
  write_whole(pvd_, pvd_of_frames(stem, frames.size()));
}

}  // namespace contct::app
