#include "contct/trace/trace.hpp"

#include <algorithm>

#include "contct/numeric/bits.hpp"
#include "contct/numeric/probe.hpp"

namespace contct::trace {
namespace {

void append_line(std::string& text, std::string_view key, std::string_view value) {
  if (value.empty()) return;
  text.append(key).append(" ").append(value).append("\n");
  // A kernel's name may be a command of several lines; a line of a trace may not.
  std::replace(text.end() - static_cast<std::ptrdiff_t>(value.size()) - 1, text.end() - 1, '\n', ' ');
}

/// The dofs, from 0 and in order, that the pairs of a call address.
std::vector<std::size_t> addressed_dofs(const call<double>& c) {
  std::vector<std::size_t> dofs;
  dofs.reserve(c.id.size());
  for (const int node : c.id) dofs.push_back(c.dof.dof_of(node) - 1);
  std::sort(dofs.begin(), dofs.end());
  dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
  return dofs;
}

}  // namespace

trace_header header_for(const kernel_facts& k, const std::string& listing, const std::string& lapack) {
  trace_header h;
  h.kernel = k.name;
  h.real_bytes = k.real_bytes;
  h.rule = k.rule;
  h.listing = listing;
  h.compiler = k.compiler;
  h.flags = k.flags;
  h.lapack = lapack;
  h.floating_point = describe(probe_floating_point());
  return h;
}

void append_header(const trace_header& h, std::string& text) {
  text.append(trace_format).append("\n");
  for (const std::string& line : h.about) append_line(text, "about", line);
  for (const auto& [key, value] : trace_facts) {
    append_line(text, key, h.*value);
    if (key == "kernel") append_line(text, "real", std::to_string(h.real_bytes));
  }
}

void append_inputs(std::int64_t number, std::string_view note, const call<double>& c,
                   std::span<const int> isep, std::string& text) {
  text += "\ncall " + std::to_string(number) + "\n";
  append_line(text, "note", note);
  text += "indof " + std::to_string(c.dof.indof) + " ndofpn " + std::to_string(c.dof.ndofpn) + " dofs " +
          std::to_string(c.dd.size()) + " nc " + std::to_string(c.nc()) + "\n";
  for (const std::size_t dof : addressed_dofs(c)) {
    text += "dof " + std::to_string(dof + 1) + " dd " + hexfloat(c.dd[dof]) + " dtest " +
            hexfloat(c.dtest[dof]) + "\n";
  }
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    text += "pair " + std::to_string(i + 1) + " id " + std::to_string(c.id[i]) + " isep " +
            std::to_string(isep[i]) + " isurf " + std::to_string(c.isurf[i]) + " cc " + hexfloat(c.cc[i]) +
            "\n";
  }
  text += "ask\n";
}

void append_inputs(std::int64_t number, std::string_view note, const call_inputs<double>& in,
                   std::string& text) {
  append_inputs(number, note, {in.dd, in.dtest, in.cc, {}, 0.0, in.id, {}, in.isurf, in.dof}, in.isep, text);
}

void append_answer(double smin, std::span<const double> ss, std::span<const int> isep,
                   std::string_view unit_26, std::string& text) {
  text += "smin " + hexfloat(smin) + "\n";
  for (std::size_t i = 0; i < ss.size(); ++i) {
    text += "pair " + std::to_string(i + 1) + " ss " + hexfloat(ss[i]) + " isep " + std::to_string(isep[i]) +
            "\n";
  }
  while (!unit_26.empty()) {
    const std::size_t end = std::min(unit_26.find('\n'), unit_26.size());
    text.append("|").append(unit_26.substr(0, end)).append("\n");
    unit_26.remove_prefix(std::min(end + 1, unit_26.size()));
  }
  text += "end\n";
}

}  // namespace contct::trace
