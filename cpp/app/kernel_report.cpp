#include "app/kernel_report.hpp"

#include <stdexcept>

#include "contct/kernel/registry.hpp"
#include "contct/number/probe.hpp"
#include "contct/text/input_text.hpp"
#include "contct/text/sha256.hpp"
#include "contct/text/strings.hpp"

namespace contct {

extern const std::string_view hints_toml;

namespace {

/// `text` as a JSON string, with quotation marks.
std::string quoted(std::string_view text) {
  constexpr escape marks[] = {{'"', "\\\""}, {'\\', "\\\\"}};
  return '"' + escaped(whole_line(text), marks) + '"';
}

/// The checksum of a plug-in's file as JSON; null for other kernels.
std::string file_sha256(const std::string& kernel) {
  constexpr std::string_view plugin = "plugin:";
  constexpr std::size_t most_mib = 512;
  if (!kernel.starts_with(plugin)) return "null";
  return quoted(sha256(read_input(kernel.substr(plugin.size()), "plug-in", most_mib)));
}

std::string identity(const std::string& kernel) {
  const kernel_facts f = facts_of_kernel(kernel);
  return fmt::format(
      R"({{ "name": {}, "real": {}, "rule": "{}", "language": {}, "compiler": {}, "flags": {}, "sha256": {} }})",
      quoted(f.name), f.real_bytes, f.rule == contact_rule::listing ? "listing" : "corrected",
      quoted(f.language), quoted(f.compiler), quoted(f.flags), file_sha256(kernel));
}

std::string quoted_lines(const std::vector<std::string>& lines) {
  std::vector<std::string> all;
  all.reserve(lines.size());
  for (const std::string& line : lines) all.push_back(quoted(line));
  return "[" + joined(all, ", ") + "]";
}

/// The line at fault as JSON; null if there is none.
std::string at_fault_json(const std::optional<faulty_line>& f) {
  if (!f || f->at.number == 0) return "null";
  return fmt::format(R"({{ "line": {}, "statement": {}, "explained": {}, "differ": {} }})", f->at.number,
                     quoted(f->at.statement), f->explained, f->differ);
}

/// The key `first` with the place and the values of the first difference; empty if there is none.
std::string first_json(const std::optional<mismatch_report>& m) {
  if (!m) return "";
  return fmt::format(R"(, "first": {{ "call": {}, "field": {}, "index": {}, "expected": {}, "found": {} }})",
                     m->call, quoted(m->where.field), m->where.index, quoted(m->where.leader),
                     quoted(m->where.follower));
}

std::string report_json(const kernel_report& r) {
  std::vector<std::string> traces;
  for (const compared_trace& t : r.traces)
    if (!t.sha256.empty())
      traces.push_back(
          fmt::format("\n  {{ \"name\": {}, \"sha256\": \"{}\", \"calls\": {}, \"mismatches\": {} }}",
                      quoted(t.name), t.sha256, t.calls, t.compared.mismatches));
  std::string text = "{\n \"format\": \"contct-report-1\",\n";
  text += fmt::format(" \"program\": \"contct {}\",\n \"listing_sha256\": \"{}\",\n \"vectors\": \"{}\",\n",
                      CONTCT_VERSION, CONTCT_LISTING_SHA256, CONTCT_VECTORS_VERSION);
  text += fmt::format(" \"floating_point\": {},\n \"command\": {},\n \"kernel\": {},\n",
                      quoted(describe(probe_floating_point())), quoted(r.command), identity(r.kernel));
  text +=
      fmt::format(" \"calls\": {},\n \"values_compared\": {},\n \"mismatches\": {},\n \"rung\": \"{}\",\n",
                  r.calls, r.compared.values, r.compared.mismatches, r.rung);
  return json_escaped(
      text + fmt::format(" \"traces\": [{}],\n \"first_mismatch\": {},\n \"at_fault\": {}\n}}\n",
                         joined(traces, ","), quoted_lines(r.first_mismatch), at_fault_json(r.at_fault)));
}

std::string badge_svg(const kernel_report& r) {
  const bool equal = r.rung == "bits";
  const std::string words = equal ? "equal to the bit" : "equal in " + r.rung;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"190\" height=\"20\" role=\"img\" "
      "aria-label=\"CONTCT: "
      "{0}\">\n<title>CONTCT: {0}, {2} calls</title>\n<rect width=\"190\" height=\"20\" rx=\"3\" "
      "fill=\"#444\"/>\n<rect x=\"64\" width=\"126\" height=\"20\" rx=\"3\" fill=\"{1}\"/>\n<g fill=\"#fff\" "
      "font-family=\"sans-serif\" font-size=\"12\" text-anchor=\"middle\">\n<text x=\"32\" "
      "y=\"14\">CONTCT</text>\n"
      "<text x=\"127\" y=\"14\">{0}</text>\n</g>\n</svg>\n",
      r.rung == "none" ? "not equal" : words, equal ? "#2a7d2a" : "#a33", r.calls);
}

}  // namespace

std::vector<std::string> known_faults(const fault_finder& answers) {
  std::vector<std::string> found;
  const std::string digest = fmt::format("digest = \"{:08x}\"", answers.digest());
  constexpr std::string_view says = "{ says = \"";
  for (std::size_t at = hints_toml.find(digest); at != std::string_view::npos;
       at = hints_toml.find(digest, at + 1)) {
    const std::size_t begin = hints_toml.rfind(says, at) + says.size();
    const std::string_view sentence = hints_toml.substr(begin, hints_toml.find('"', begin) - begin);
    if (!sentence.empty()) found.push_back("known fault: " + std::string(sentence));
  }
  return found;
}

std::string replay_json(const kernel_report& r, const std::vector<checked_kernel>& kernels) {
  std::vector<std::string> compared;
  for (const compared_trace& t : r.traces) {
    compared.push_back(fmt::format(
        "\n  {{ \"trace\": {}, \"kernel\": {}, \"verdict\": \"{}\", \"calls\": {}, \"values_compared\": "
        "{}, \"mismatches\": {}{}, {}: {} }}",
        quoted(t.file), quoted(t.kernel), t.verdict, t.calls, t.compared.values, t.compared.mismatches,
        first_json(t.first), quoted("findings"),
        quoted_lines(t.first ? words_of(*t.first) : std::vector<std::string>{})));
  }
  std::vector<std::string> checked;
  checked.reserve(kernels.size());
  for (const checked_kernel& k : kernels)
    checked.push_back(fmt::format("\n  {{ \"kernel\": {}, \"at_fault\": {}, {}: {} }}", quoted(k.name),
                                  at_fault_json(k.at_fault), quoted("findings"), quoted_lines(k.findings)));
  return json_escaped(fmt::format(
      "{{\n \"format\": \"contct-replay-1\",\n \"calls\": {},\n \"values_compared\": {},\n "
      "\"mismatches\": {},\n \"traces\": [{}],\n \"kernels\": [{}]\n}}\n",
      r.calls, r.compared.values, r.compared.mismatches, joined(compared, ","), joined(checked, ",")));
}

void refuse_many_reported(std::size_t kernels, const std::string& outputs) {
  if (outputs.empty() || kernels == 1) return;
  throw std::invalid_argument(
      fmt::format("--report, --badge: found {} kernels to check; allowed: one, named by --kernel (replay) or "
                  "--kernels LEADER,NAME (fuzz)",
                  kernels));
}

void write_report(const output_files& files, const kernel_report& r) {
  if (files["--report"] != nullptr) files.write("--report", report_json(r));
  files.write("--badge", badge_svg(r));
}

}  // namespace contct
