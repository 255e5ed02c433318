// contct_about, contct_call and contct_replay: functions that need kernels but no problem.
#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

#include "app/serve_answer.hpp"
#include "contct/harness/compare.hpp"
#include "contct/kernel/call.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/linear/cholesky.hpp"
#include "contct/linear/engine.hpp"
#include "contct/number/probe.hpp"
#include "contct/serve/serve.h"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

std::string answer_call(const char* name, call<double> c, double* smin) {
  if (name == nullptr)
    throw std::invalid_argument(
        "call: found null for the kernel's name; allowed: a kernel that contct_about lists");
  refuse_beyond_limits(c, c.isep);
  const std::scoped_lock mine(turn());
  const std::unique_ptr<kernel> k = make_kernel(name);
  k->answer(c);
  *smin = c.smin;
  return k->take_text();
}

}  // namespace
}  // namespace contct

using namespace contct;

int contct_serve_version() {
  return CONTCT_SERVE_VERSION;
}

char* contct_about() {
  return answered([](served_answer& a) {
    json out = {{"version", CONTCT_VERSION},
                {"listing_sha256", CONTCT_LISTING_SHA256},
                {"floating_point", describe(probe_floating_point())},
                {"lapack", lapack_identity()},
                {"kernels", json::array()},
                {"engines", {"auto"}}};
    for (const std::string& name : kernel_names()) {
      const kernel_facts k = facts_of_kernel(name);
      out["kernels"].push_back({{"name", k.name},
                                {"real_bytes", k.real_bytes},
                                {"rule", name_of(k.rule)},
                                {"language", k.language},
                                {"compiler", k.compiler},
                                {"flags", k.flags}});
    }
    for (const std::string& name : engine_names()) out["engines"].push_back(name);
    a.result = json_text(out);
  });
}

char* contct_call(const char* kernel, const double dd[], const double dtest[], const double cc[], double ss[],
                  double* smin, const int id[], int isep[], const int isurf[], int nc, int indof, int ndofpn,
                  int ndof) {
  return answered([&](served_answer& a) {
    if (nc < 0 || ndof < 0 || smin == nullptr ||
        (nc > 0 &&
         (cc == nullptr || ss == nullptr || id == nullptr || isep == nullptr || isurf == nullptr)) ||
        (ndof > 0 && (dd == nullptr || dtest == nullptr)))
      throw std::invalid_argument(
          "call: found a null pointer or a negative length; allowed: arrays of the lengths nc and ndof");
    const auto pairs = static_cast<std::size_t>(nc);
    const auto dofs = static_cast<std::size_t>(ndof);
    const std::string text = answer_call(kernel,
                                         {{dd, dofs},
                                          {dtest, dofs},
                                          {cc, pairs},
                                          {ss, pairs},
                                          0.0,
                                          {id, pairs},
                                          {isep, pairs},
                                          {isurf, pairs},
                                          {indof, ndofpn}},
                                         smin);
    a.result = json_text(nlohmann::json{{"text", text}});
  });
}

char* contct_replay(const char* trace, const char* options) {
  return answered([&](served_answer& a) {
    const request r(options, {"file", "folder", "kernel"});
    if (trace == nullptr) throw std::invalid_argument("trace: found null; allowed: the text of a trace");
    trace_reader calls(trace, r.text("file", "trace"));
    const trace_header h = calls.read_header();
    const std::string name = r.text("kernel", usual_kernel(h));
    const std::scoped_lock mine(turn());
    const std::unique_ptr<kernel> k = make_kernel(name);
    if (!comparable(h, k->facts()))
      throw std::invalid_argument(fmt::format(
          "options: kernel: found {}, of {}-byte REAL and {}; allowed: a kernel of {}-byte REAL and {}, "
          "as in the trace",
          name, k->facts().real_bytes, rule_words(k->facts().rule), h.real_bytes, rule_words(h.rule)));
    follower found = follower_of(h, *k);
    const std::int64_t number = replay(calls, found);
    if (number == 0) throw std::invalid_argument("trace: found no call; allowed: one or more");
    json out = {{"kernel", name},
                {"calls", number},
                {"values_compared", found.compared.values},
                {"mismatches", found.compared.mismatches},
                {"first", nullptr}};
    if (found.first()) out["first"] = words_of(*found.first());
    a.result = json_text(out);
    a.exit = found.compared.mismatches == 0 ? exit_status::solved : exit_status::kernels_differ;
  });
}

void contct_free(char* text) {
  std::free(text);  // NOLINT: made by malloc, for callers in C
}
