#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>

#include "contct/lab/fuzz.hpp"
#include "contct/numeric/bits.hpp"
#include "contct/text/input_text.hpp"
#include "contct/text/strings.hpp"

namespace contct::lab {
namespace {

using json = nlohmann::ordered_json;
constexpr const char* format = "contct-fuzz-1";
constexpr const char* checkpoint_format = "contct-fuzz-checkpoint-1";

/// Puts fields into a file's object.
auto writer(json& object) {
  return [&object](const std::string& name, const auto& value) { object[json::json_pointer(name)] = value; };
}

/// Takes fields from a file's object. Throws std::range_error where whole numbers are asked for and others
/// stand.
auto reader(const json& object) {
  return [&object]<class T>(const std::string& name, T& value) {
    const json& field = object.at(json::json_pointer(name));
    const bool fractions =
        std::any_of(field.begin(), field.end(), [](const json& entry) { return entry.is_number_float(); });
    if constexpr (std::is_floating_point_v<T>) {
      field.get_to(value);
    } else {
      if (!fractions) field.get_to(value);
      if (fractions || json(value).dump() != field.dump()) throw std::range_error(name + ": " + field.dump());
    }
  };
}

/// The fields of a follower's result, in the file's order: `field(name, value)` writes or reads one.
template <class Field>
void for_each_field(fuzz_follower& f, const Field& field) {
  std::string level(name_of(f.highest));
  field("/kernel", f.name);
  field("/values_compared", f.compared.values);
  field("/mismatches", f.compared.mismatches);
  field("/rung", level);
  field("/most_ulps", f.most_ulps);
  field("/findings", f.mismatch_reports);
  f.highest = equality_level::bits;
  while (f.highest != equality_level::none && level != name_of(f.highest))
    f.highest = static_cast<equality_level>(static_cast<int>(f.highest) + 1);
}

/// The same of a result, but for its followers.
template <class Field>
void for_each_field(fuzz_result& r, const Field& field) {
  tally all = r.compared();  // written only
  std::string its_format = format;
  field("/format", its_format);
  field("/kernels", r.request.kernels);
  field("/calls", r.calls);
  field("/values_compared", all.values);
  field("/mismatches", all.mismatches);
  field("/problems", r.problems);
  field("/events/make", r.events.make);
  field("/events/break", r.events.break_);
  field("/events/stationary", r.events.stationary);
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    for (const bool outcome : {true, false})
      field(fmt::format("/branches/{}_{}", branch_names[b], outcome),
            r.branches.of(static_cast<branch>(b), outcome));
  }
  field("/seconds", r.seconds);
  field("/seed", r.request.seed);
  field("/asked/calls", r.request.calls);
  field("/asked/problems", r.request.problems);
  field("/shard/number", r.request.shard);
  field("/shard/of", r.request.shards);
}

json json_of(fuzz_result& r) {
  json document;
  for_each_field(r, writer(document));
  document["followers"] = json::array();
  for (fuzz_follower& f : r.followers) for_each_field(f, writer(document["followers"].emplace_back()));
  return document;
}

fuzz_result result_from(const json& document) {
  fuzz_result r;
  for_each_field(r, reader(document));
  for (const json& f : document.at("followers")) for_each_field(r.followers.emplace_back(), reader(f));
  return r;
}

/// What `take` makes of the JSON file, or an input_error that names it: it must have that format.
template <class Take>
auto read_document(const std::string& file, const char* what, const char* its_format, const char* from,
                   const Take& take) {
  try {
    const json document = json::parse(read_input(file, what));
    if (document.at("format") != its_format)
      throw input_error(file + ": found another format; allowed: " + its_format);
    return take(document);
  } catch (const json::exception& e) {
    constexpr std::size_t longest = 300;  // it quotes a whole text of the file
    throw input_error(fmt::format("{}: found no {}: {}; allowed: what {} wrote", file, what,
                                  text::printable(e.what(), longest), from));
  } catch (const std::range_error& e) {
    throw input_error(fmt::format("{}: found no {}: {}; allowed: whole numbers, as {} wrote them", file, what,
                                  e.what(), from));
  }
}

/// A shard, or an input_error that names the file.
fuzz_result shard_from(const std::string& file) {
  return read_document(file, "fuzz result", format, "--json", result_from);
}

/// The fields of a checkpoint that a result does not have: `field(name, value)` writes or reads one.
template <class Field>
void for_each_field(fuzz_checkpoint& c, const Field& field) {
  std::string its_format = checkpoint_format;
  field("/format", its_format);
  field("/calls_up_to", c.calls_up_to);
  field("/problems_up_to", c.problems_up_to);
  field("/differing_problems", c.differing_problems);
  for (std::size_t f = 0; f < c.firsts.size(); ++f) {
    field(fmt::format("/first/{}/problem", f), c.firsts[f].problem);
    field(fmt::format("/first/{}/call", f), c.firsts[f].call);
    field(fmt::format("/first/{}/same_events", f), c.result.followers[f].same_events);
    field(fmt::format("/first/{}/always_answered", f), c.result.followers[f].always_answered);
  }
}

/// Could a run of `c.request` have come there?
bool is_possible(const fuzz_checkpoint& c) {
  const fuzz_request& r = c.result.request;
  const auto count = [&](std::int64_t up_to) {
    return up_to < r.shard ? 0 : (up_to - r.shard) / r.shards + 1;
  };
  const auto is_mark = [&](const fuzz_checkpoint::mark& m) {
    return m.call >= 0 && m.problem >= 0 && m.problem <= c.problems_up_to &&
           (m.problem > 0 || m.call <= c.calls_up_to);
  };
  return c.calls_up_to >= 0 && c.calls_up_to <= r.calls && c.problems_up_to >= 0 &&
         c.problems_up_to <= r.problems && c.result.calls >= count(c.calls_up_to) &&
         c.result.problems == count(c.problems_up_to) && std::ranges::all_of(c.firsts, is_mark);
}

bool same_run(const fuzz_request& a, fuzz_request b) {
  b.shard = a.shard;
  return a == b;
}

void add(fuzz_result& all, const fuzz_result& shard) {
  all.add(shard);
  all.problems += shard.problems;
  all.seconds += shard.seconds;
  for (std::size_t f = 0; f < all.followers.size(); ++f) {
    fuzz_follower& mine = all.followers[f];
    const fuzz_follower& its = shard.followers[f];
    mine.compared += its.compared;
    mine.highest = std::max(mine.highest, its.highest);
    mine.most_ulps = std::max(mine.most_ulps, its.most_ulps);
    if (mine.mismatch_reports.empty()) mine.mismatch_reports = its.mismatch_reports;
  }
}

/// A number as C++ has it.
std::string cpp_number(double x) {
  const char* const sign = std::signbit(x) ? "-" : "";
  if (std::isnan(x)) return "std::numeric_limits<double>::quiet_NaN()";
  if (std::isinf(x)) return fmt::format("{}std::numeric_limits<double>::infinity()", sign);
  return hexfloat(x);
}

std::string cpp_list(const std::vector<double>& list) {
  std::vector<std::string> words(list.size());
  std::ranges::transform(list, words.begin(), cpp_number);
  return fmt::format("{{{}}}", fmt::join(words, ", "));
}

/// A name for a test: its characters must not mean anything to Catch2.
std::string test_name(std::string kernel) {
  const auto is_plain = [](unsigned char ch) { return std::isalnum(ch) != 0; };
  std::ranges::replace_if(kernel, std::not_fn(is_plain), ' ');
  return kernel;
}

std::string cpp_string(const std::string& text) {
  std::string out;
  for (const char ch : text) {
    if (ch == '"' || ch == '\\') out += '\\';
    out += ch;
  }
  return "\"" + out + "\"";
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

std::string fuzz_json(fuzz_result r) {
  return json_text(json_of(r), 1) + "\n";
}

std::string checkpoint_json(const fuzz_checkpoint& reached) {
  fuzz_checkpoint c = reached;
  json document;
  for_each_field(c, writer(document));
  document["result"] = json_of(c.result);
  return json_text(document, 1) + "\n";
}

fuzz_checkpoint checkpoint_from(const std::string& file, const fuzz_request& r) {
  return read_document(file, "checkpoint", checkpoint_format, "--checkpoint", [&](const json& document) {
    fuzz_checkpoint c;
    c.result = result_from(document.at("result"));
    if (c.result.request != r)
      throw input_error(file +
                        ": found the checkpoint of another run; allowed: one with the same kernels, "
                        "calls, problems, seed and shard");
    c.firsts.resize(c.result.followers.size());
    for_each_field(c, reader(document));
    if (c.firsts.size() + 1 != r.kernels.size() || !is_possible(c))
      throw input_error(file + ": found counts that do not fit each other; allowed: what --checkpoint wrote");
    return c;
  });
}

fuzz_result merged_fuzz(const std::vector<std::string>& files) {
  fuzz_result all;
  for (const std::string& file : files) {
    const fuzz_result shard = shard_from(file);
    if (all.merged_shards.empty()) {
      all = shard;
    } else {
      if (!same_run(all.request, shard.request) || all.followers.size() != shard.followers.size())
        throw input_error(file + ": found another run than in " + files[0] +
                          "; allowed: shards with the same kernels, calls, problems and seed");
      if (std::count(all.merged_shards.begin(), all.merged_shards.end(), shard.request.shard) > 0)
        throw input_error(
            fmt::format("{}: found shard {} once more; allowed: each once", file, shard.request.shard));
      add(all, shard);
    }
    all.merged_shards.push_back(shard.request.shard);
  }
  if (static_cast<int>(all.merged_shards.size()) != all.request.shards)
    throw input_error(fmt::format("found {} of {} shards ({}); allowed: all of them",
                                  all.merged_shards.size(), all.request.shards,
                                  fmt::join(all.merged_shards, ", ")));
  all.request.shard = 1;
  all.request.shards = 1;
  return all;
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

std::string catch_test_of(const found_case& c) {
  std::string text = fmt::format(R"(// Found by contct fuzz, and shrunk.
// {}
#include <catch2/catch.hpp>
#include <limits>
#include <vector>

#include "contct/kernel/call_inputs.hpp"
#include "contct/numeric/bits.hpp"
#include "contct/outside/registry.hpp"

TEST_CASE("{} answers as {} does") {{
  const auto kernel = contct::outside::make_kernel({});
  contct::outside::call_inputs<double> in;
  contct::outside::call_outputs out;
)",
                                 fmt::join(words_of(c.what), "\n// "), test_name(c.what.follower),
                                 test_name(c.what.leader), cpp_string(c.what.follower));
  for (std::size_t i = 0; i < c.calls.size(); ++i) {
    const call_inputs<double>& in = c.calls[i];
    text += fmt::format(R"(
  in.dd = {};
  in.dtest = {};
  in.cc = {};
  in.id = {{{}}};
  in.isep = {{{}}};
  in.isurf = {{{}}};
  in.dof = {{{}, {}}};
  {{
    contct::outside::call<double> asked = out.prepare(in);
    kernel->answer(asked);
    CHECK(contct::outside::same_bits(asked.smin, {}));
)",
                        cpp_list(in.dd), cpp_list(in.dtest), cpp_list(in.cc), fmt::join(in.id, ", "),
                        fmt::join(in.isep, ", "), fmt::join(in.isurf, ", "), in.dof.indof, in.dof.ndofpn,
                        cpp_number(c.leader[i].smin));
    for (std::size_t pair = 0; pair < in.pairs(); ++pair)
      text += fmt::format("    CHECK(contct::outside::same_bits(out.ss[{}], {}));\n", pair,
                          cpp_number(c.leader[i].ss[pair]));
    text += fmt::format("    CHECK(out.isep == std::vector<int>{{{}}});\n  }}\n",
                        fmt::join(c.leader[i].isep, ", "));
  }
  return text + "}\n";
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
