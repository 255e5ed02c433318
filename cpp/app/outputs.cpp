#include "app/outputs.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <new>
#include <stdexcept>
#include <system_error>

#include "contct/kernel/kernel.hpp"
#include "contct/number/probe.hpp"
#include "contct/text/input_text.hpp"

namespace contct {
namespace {

/// An XML attribute with a blank before it. Line ends become character references, since XML reads them as
/// blanks.
std::string attribute(std::string_view name, std::string_view value) {
  constexpr escape line_end[] = {{'\n', "&#10;"}};
  return fmt::format(" {}=\"{}\"", name, escaped(markup_text(value), line_end));
}

/// Text as one line of Markdown with all markup escaped, also for a cell of a table.
std::string markdown_text(std::string_view text) {
  constexpr std::string_view marks = "\\`*_{}[]<>#|!~&";
  std::string out;
  for (const char c : on_one_line(text)) {
    if (marks.find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

/// Lines of text as a code block in Markdown. The fence is longer than any row of backticks in the text.
std::string markdown_block(std::string_view lines) {
  std::size_t longest = 2;
  std::size_t run = 0;
  for (const char c : lines) {
    run = c == '`' ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  const std::string fence(longest + 1, '`');
  return fmt::format("{0}\n{1}\n{0}\n", fence, terminal_text(lines));
}

/// The number from 0 to `most` in a variable of the environment; `otherwise` if it is not set. Throws
/// std::invalid_argument if the variable is invalid.
template <class Number>
Number environment_number(const char* variable, Number otherwise, Number most, std::string_view allowed) {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing here sets variables
  const char* const given = std::getenv(variable);
  const auto number = given == nullptr ? otherwise : number_in<Number>(given);
  if (!number || !(*number >= 0 && *number <= most))
    throw std::invalid_argument(fmt::format("{}: found \"{}\"; allowed: {}", variable, given, allowed));
  return *number;
}

/// Overwrites the terminal's current line.
void put_line(std::string_view words) {
  const std::string line = fmt::format("\r{}\033[K", on_one_line(words));
  (void)std::fputs(line.c_str(), stderr);
}

/// Ends the process with a message and exit status 2 if memory is exhausted. Calls no destructors, which may
/// need memory.
[[noreturn]] void end_for_memory() {
  constexpr std::string_view message = "contct: not enough memory; the command is stopped\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message.data(), message.size());
  _exit(static_cast<int>(exit_status::bad_input));
}

/// Opens closed standard streams. Otherwise output files would get the descriptors of the closed streams.
void hold_standard_streams() {
  // Input is opened for writing and output for reading, so that using a closed stream fails as before.
  constexpr std::pair<int, int> held[] = {
      {STDIN_FILENO, O_WRONLY}, {STDOUT_FILENO, O_RDONLY}, {STDERR_FILENO, O_WRONLY}};
  for (const auto& [stream, flags] : held) {
    if (fcntl(stream, F_GETFD) < 0)
      (void)open("/dev/null", flags);  // gets the least free descriptor, which is `stream`
  }
}

}  // namespace

int run_program(const std::function<exit_status()>& command, const std::function<void()>& leave) {
  std::set_new_handler(end_for_memory);
  hold_standard_streams();
  (void)std::signal(SIGPIPE, SIG_IGN);
  exit_status status = exit_status::bad_input;
  bool reader_is_gone = false;
  try {
    const exit_status found = command();
    flush_standard_output();
    status = found;
  } catch (const reader_gone&) {  // "contct run .. | head" ends after writing its files
    reader_is_gone = true;
  } catch (const kernel_failure& e) {
    complain("the leading kernel gave no answer: {}", whole_line(e.what()));
    status = exit_status::kernels_differ;
  } catch (const usage_error& e) {
    complain("{}", e.what());
  } catch (const std::system_error& e) {
    complain("{}{}", std::ferror(stdout) != 0 ? "standard output: " : "", whole_line(e.what()));
  } catch (const std::bad_alloc&) {
    end_for_memory();
  } catch (const std::exception& e) {
    complain("{}", whole_line(e.what()));
  }
  leave();
  if (reader_is_gone) {
    (void)std::signal(SIGPIPE, SIG_DFL);
    (void)std::raise(SIGPIPE);
  }
  return static_cast<int>(status);
}

void print_wrapped(const terminal& t, paint p, const std::vector<std::string>& items, int indent) {
  for (const std::string& line : wrap(items, t.width - indent))
    print_text(fmt::format("{:{}}{}\n", "", indent, painted(t, p, line)));
}

void complain_of(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) complain("{}", whole_line(line));
}

std::int64_t check_report::count(outcome o) const {
  return std::ranges::count(results, o, &check_result::what);
}

std::string junit_xml(const check_report& r) {
  const std::string counts = fmt::format(R"( tests="{}" failures="{}" errors="0" time="{:.3f}")",
                                         r.results.size(), r.count(outcome::failed), r.seconds);
  std::string xml = fmt::format(  // schemas allow `skipped` for a testsuite, but not for testsuites
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites{0}>\n  <testsuite{1}{0} skipped=\"{2}\">\n"
      "    <properties>\n",
      counts, attribute("name", r.command), r.count(outcome::skipped));
  for (const std::string& fact : r.facts)
    xml += fmt::format("      <property name=\"fact\"{}/>\n", attribute("value", fact));
  xml += "    </properties>\n";
  for (const check_result& c : r.results) {
    const std::string message = attribute("message", c.summary);
    xml += fmt::format("    <testcase{}{}>\n", attribute("classname", r.command), attribute("name", c.name));
    if (c.what == outcome::failed)
      xml += fmt::format("      <failure{}>{}</failure>\n", message, markup_text(c.details));
    if (c.what == outcome::skipped) xml += fmt::format("      <skipped{}/>\n", message);
    xml += fmt::format("      <system-out>{}</system-out>\n    </testcase>\n", markup_text(c.summary));
  }
  return xml + "  </testsuite>\n</testsuites>\n";
}

std::string markdown(const check_report& r) {
  constexpr std::string_view words[] = {"passed", "**failed**", "skipped"};  // in the order of `outcome`
  const std::int64_t failed = r.count(outcome::failed);
  std::string text = fmt::format("## {}: {}\n\n{} passed, {} failed, {} skipped\n\n", r.command,
                                 failed == 0 ? "passed" : "failed", r.count(outcome::passed), failed,
                                 r.count(outcome::skipped));
  for (const std::string& fact : r.facts) text += "- " + markdown_text(fact) + "\n";
  text += "\n| what | result | |\n| --- | --- | --- |\n";
  for (const check_result& c : r.results)
    text += fmt::format("| {} | {} | {} |\n", markdown_text(c.name), words[static_cast<int>(c.what)],
                        markdown_text(c.summary));
  for (const check_result& c : r.results) {
    if (c.what == outcome::failed && !c.details.empty())
      text += fmt::format("\n### {}\n\n{}", markdown_text(c.name), markdown_block(c.details));
  }
  return text;
}

std::vector<std::string> common_facts() {
  return {"contct " CONTCT_VERSION, "listing sha256 " CONTCT_LISTING_SHA256,
          "floating point: " + describe(probe_floating_point())};
}

std::string utc_now() {
  constexpr std::int64_t most = 253'402'300'799;  // the end of the year 9999
  // A clock that was never set may show any year, so its time is clamped.
  const std::time_t time =
      environment_number("SOURCE_DATE_EPOCH", std::clamp<std::int64_t>(std::time(nullptr), 0, most), most,
                         "seconds since 1970, 0 to 253402300799");
  std::tm utc{};
  (void)gmtime_r(&time, &utc);
  return fmt::format("{}-{:02}-{:02} {:02}:{:02} UTC", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday,
                     utc.tm_hour, utc.tm_min);
}

std::vector<output_option> with_reports(std::vector<output_option> others, const report_options& options) {
  others.insert(others.end(), {{"--junit", options.junit}, {"--markdown", options.markdown}});
  return others;
}

void refuse_shared_outputs(const std::vector<output_option>& outputs,
                           const std::vector<output_option>& inputs) {
  std::vector<output_option> others = {{"standard output", "/dev/fd/1"}};
  for (const output_option& i : inputs) others.push_back({i.name, i.path == "-" ? "/dev/fd/0" : i.path});
  const char* standard = nullptr;
  for (const output_option& o : outputs) {
    if (o.path == "-") {
      if (standard != nullptr)
        throw std::invalid_argument(fmt::format("{} and {} cannot both be -", standard, o.name));
      standard = o.name;
      continue;
    }
    if (o.path.empty()) continue;
    for (const output_option& other : others) {
      if (same_file(o.path, other.path))
        throw std::invalid_argument(fmt::format("{} {}: found the same file as {}; allowed: another file",
                                                o.name, o.path, other.name));
    }
    others.push_back(o);
  }
}

bool takes_standard_output(const std::vector<output_option>& outputs) {
  return std::ranges::find(outputs, "-", &output_option::path) != outputs.end();
}

void write_file(const std::string& name, std::string_view text) {
  output_file file(name);
  file.write(text);
  file.finish();
}

output_files::output_files(const std::vector<output_option>& outputs) {
  for (const output_option& o : outputs)
    if (!o.path.empty() && !o.opens_later) files_[o.name] = std::make_unique<output_file>(o.path);
}

output_file* output_files::operator[](std::string_view name) const {
  const auto found = files_.find(name);
  return found == files_.end() ? nullptr : found->second.get();
}

void output_files::write(std::string_view name, std::string_view text) const {
  output_file* const file = (*this)[name];
  if (file == nullptr) return;
  file->write(text);
  file->finish();
}

void output_files::write(const check_report& report) const {
  write("--junit", junit_xml(report));
  write("--markdown", markdown(report));
}

progress::progress(bool quiet)
    : wanted_(!quiet && isatty(STDERR_FILENO) != 0),
      after_(environment_number("CONTCT_PROGRESS_AFTER", 1.0, std::numeric_limits<double>::infinity(),
                                "seconds, 0 or more")),
      between_(std::min(0.2, after_.count())) {}

bool progress::is_due() const {
  const auto now = clock::now();
  return wanted_ && now - begun_ >= after_ && now - last_ >= between_;
}

void progress::reached(std::int64_t done, std::int64_t all, const char* what) {
  if (is_due()) say(fmt::format("{:3} % of {} {}", 100 * done / std::max<std::int64_t>(all, 1), all, what));
}

void progress::say(std::string_view words) {
  if (!is_due()) return;
  last_ = clock::now();
  shown_ = true;
  put_line(words);
}

void progress::erase() {
  if (std::exchange(shown_, false)) put_line("");
}

}  // namespace contct
