#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "contct/lab/fuzz.hpp"
#include "contct/numeric/bits.hpp"
#include "contct/text/strings.hpp"

namespace contct::lab {
namespace {

using json = nlohmann::ordered_json;

json json_of(const fuzz_follower& f) {
  return {{"kernel", f.name},
          {"values_compared", f.compared.values},
          {"mismatches", f.compared.mismatches},
          {"rung", std::string(name_of(f.highest))},
          {"most_ulps", f.most_ulps},
          {"findings", f.mismatch_reports}};
}

/// A FORTRAN assignment to an array's element, from 0; what no literal can say is computed from Z, which is
/// zero. Literals have so many digits that they are read back exactly.
std::string fortran_assignment(const char* array, std::size_t element, double x, int real_bytes) {
  const char* const sign = std::signbit(x) ? "-" : "";
  std::string value = real_bytes == 4 ? fmt::format("{:.8E}", x) : fmt::format("{:.16E}", x);
  if (std::isnan(x)) value = "Z / Z";
  if (std::isinf(x)) value = fmt::format("{}1. / Z", sign);
  if (x == 0.0) value = std::signbit(x) ? "-Z" : "0.";
  return fmt::format("      {}({}) = {}\n", array, element + 1, value);
}

/// Call `number`, from 0, of the main program.
std::string fortran_call(const found_case& c, std::size_t number) {
  const call_inputs<double>& in = c.calls[number];
  const call_outputs& expected = c.leader[number];
  std::string text = fmt::format("      INDOF = {}\n      NDOFPN = {}\n", in.dof.indof, in.dof.ndofpn);
  for (std::size_t dof = 0; dof < in.dd.size(); ++dof) {
    if (std::isnan(in.dd[dof]) && std::isnan(in.dtest[dof])) continue;
    text += fortran_assignment("DD", dof, in.dd[dof], c.real_bytes);
    text += fortran_assignment("DTEST", dof, in.dtest[dof], c.real_bytes);
  }
  for (std::size_t i = 0; i < in.pairs(); ++i) {
    text += fortran_assignment("CC", i, in.cc[i], c.real_bytes);
    text += fmt::format("      ID({0}) = {1}\n      ISEP({0}) = {2}\n      ISURF({0}) = {3}\n", i + 1,
                        in.id[i], in.isep[i], in.isurf[i]);
  }
  text += fmt::format(
      "      CALL CONTCT (DD, DTEST, CC, SS, SMIN, ID, ISEP, ISURF, {})\n"
      "      WRITE (*,*) 'SMIN', SMIN\nC     {}: {}\n",
      in.pairs(), c.what.leader, hexfloat(expected.smin));
  if (in.pairs() == 0) return text;
  text += fmt::format("      DO {0} I = 1, {1}\n {0} WRITE (*,*) I, SS(I), ISEP(I)\n", 1010 + number % 90,
                      in.pairs());
  for (std::size_t i = 0; i < in.pairs(); ++i)
    text +=
        fmt::format("C     {}: {} {} {}\n", c.what.leader, i + 1, hexfloat(expected.ss[i]), expected.isep[i]);
  return text;
}

/// Comment lines of a fixed-form program end at column 72, between words where they can.
std::string fortran_comment(const std::string& words) {
  constexpr std::size_t width = 66;
  std::string text;
  for (std::size_t from = 0; from < words.size();) {
    std::size_t to = std::min(from + width, words.size());
    const std::size_t blank = words.rfind(' ', to);
    if (to < words.size() && blank != std::string::npos && blank > from) to = blank;
    text += "C     " + words.substr(from, to - from) + "\n";
    from = std::min(words.find_first_not_of(' ', to), words.size());
  }
  return text;
}

}  // namespace

std::string fuzz_json(const fuzz_result& r) {
  json branches;
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    for (const bool outcome : {true, false})
      branches[fmt::format("{}_{}", branch_names[b], outcome)] =
          r.branches.of(static_cast<branch>(b), outcome);
  }
  json followers = json::array();
  for (const fuzz_follower& f : r.followers) followers.push_back(json_of(f));
  const json document = {
      {"format", "contct-fuzz-1"},
      {"kernels", r.request.kernels},
      {"calls", r.calls},
      {"values_compared", r.compared().values},
      {"mismatches", r.compared().mismatches},
      {"problems", r.problems},
      {"events", {{"make", r.events.make}, {"break", r.events.break_}, {"stationary", r.events.stationary}}},
      {"branches", branches},
      {"seconds", r.seconds},
      {"seed", r.request.seed},
      {"asked", {{"calls", r.request.calls}, {"problems", r.request.problems}}},
      {"shard", {{"number", r.request.shard}, {"of", r.request.shards}}},
      {"followers", followers}};
  return json_text(document, 1) + "\n";
}

std::string trace_of(const found_case& c, trace_header h) {
  for (const std::string& line : words_of(c.what)) h.about.push_back(line);
  std::string text;
  append_header(h, text);
  for (std::size_t i = 0; i < c.calls.size(); ++i) {
    append_inputs(static_cast<std::int64_t>(i) + 1, "", c.calls[i], text);
    append_answer(c.leader[i].smin, c.leader[i].ss, c.leader[i].isep, c.leader[i].text, text);
  }
  return text;
}

std::string fortran_main_of(const found_case& c) {
  std::size_t dofs = 1;
  std::size_t pairs = 1;
  for (const auto& in : c.calls) {
    dofs = std::max(dofs, in.dd.size());
    pairs = std::max(pairs, in.pairs());
  }
  std::string text;
  for (const std::string& line : words_of(c.what)) text += fortran_comment(line);
  text +=
      fortran_comment(fmt::format("gfortran -std=legacy -ffp-contract=off -fno-range-check {}this.f contct.f",
                                  c.real_bytes == 8 ? "-fdefault-real-8 " : ""));
  text += fmt::format(
      "      PROGRAM FOUND\n      COMMON /DOF/ INDOF,NDOFPN\n      DIMENSION DD({0}), DTEST({0}), CC({1}),\n"
      "     &  SS({1}), ID({1}), ISEP({1}), ISURF({1})\n      Z = 0.\n",
      dofs, pairs);
  for (std::size_t i = 0; i < c.calls.size(); ++i) text += fortran_call(c, i);
  return text + "      END\n";
}

}  // namespace contct::lab
