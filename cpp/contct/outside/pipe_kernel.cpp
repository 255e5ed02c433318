// A kernel that is a command: one call as trace text in, one answer out.
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "contct/outside/child_process.hpp"
#include "contct/outside/outside.hpp"
#include "contct/text/input_text.hpp"
#include "contct/trace/trace.hpp"

namespace contct {
namespace {

/// Run `command` with the channel as its standard input and output.
void run_command(const std::string& command, int channel) {
  dup2(channel, STDIN_FILENO);
  dup2(channel, STDOUT_FILENO);
  close(channel);
  execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
  _exit(127);
}

class pipe_kernel final : public kernel {
 public:
  pipe_kernel(const std::string& command, const outside_limits& limits)
      : facts_(facts_of_pipe(command)), command_(command), limits_(limits), failures_(limits) {}

  [[nodiscard]] const kernel_facts& facts() const override { return facts_; }

  void answer(call<double>& c) override {
    failures_.refuse_when_enough();
    if (child_) refuse_stray_answer();
    if (!child_) child_.emplace([this](int channel) { run_command(command_, channel); });
    const auto deadline = child_process::clock::now() + limits_.patience;
    asked_.clear();
    append_inputs(++calls_, "", c, c.isep, asked_);
    take(child_->send(asked_, deadline), c.ss.size());
    answered_.clear();
    while (!answer_is_whole()) take(child_->receive(answered_, deadline), c.ss.size());
    read_answer(c);
  }

  std::string take_text() override { return std::exchange(text_, {}); }

 private:
  /// What comes before anything is asked would be taken for the answer.
  void refuse_stray_answer() {
    answered_.clear();
    if (child_->receive(answered_, child_process::clock::now()) != child_process::sent::whole) return;
    child_.reset();
    failures_.fail("answered without being asked");
  }

  [[nodiscard]] bool answer_is_whole() const {
    return answered_ == "end\n" ||
           (answered_.size() >= 5 && answered_.compare(answered_.size() - 5, 5, "\nend\n") == 0);
  }

  void take(child_process::sent how, std::size_t pairs) {
    // More than any answer takes: a kernel that never stops talking must not take all memory.
    const std::size_t most_answer = (std::size_t{1} << 20) + 1024 * pairs;
    if (how == child_process::sent::whole && answered_.size() <= most_answer) return;
    std::string words = child_->end();
    child_.reset();
    if (how == child_process::sent::late)
      failures_.fail_late("did not answer within " + std::to_string(limits_.patience.count()) + " ms");
    if (how == child_process::sent::whole)
      words = "answered more than " + std::to_string(most_answer) + " bytes";
    else if (words == child_process::was_stopped)
      failures_.fail_late("closed its end of the pipe");  // and stayed: it had to be waited for
    failures_.fail(words);
  }

  void read_answer(call<double>& c) {
    out_.ss.resize(c.ss.size());
    out_.isep.resize(c.ss.size());
    try {
      trace_reader reader(answered_, "its answer");
      reader.read_answer(out_);
      if (reader.line() != static_cast<int>(std::count(answered_.begin(), answered_.end(), '\n')))
        throw input_error("its answer goes on behind \"end\"");
    } catch (const input_error& e) {
      child_.reset();
      failures_.fail(std::string("answered nonsense: ") + e.what());
    }
    c.smin = out_.smin;
    std::copy(out_.ss.begin(), out_.ss.end(), c.ss.begin());
    std::copy(out_.isep.begin(), out_.isep.end(), c.isep.begin());
    text_ += out_.text;
  }

  kernel_facts facts_;
  std::string command_;
  outside_limits limits_;
  failure_count failures_;
  std::optional<child_process> child_;
  std::int64_t calls_ = 0;
  std::string asked_, answered_, text_;
  call_outputs out_;
};

}  // namespace

void failure_count::refuse_when_enough() const {
  if (failures_ < limits_.most_failures && waits_ < limits_.most_waits) return;
  throw kernel_failure("is asked no more after " + std::to_string(failures_ + waits_) +
                       " failures; the last: it " + last_);
}

void failure_count::fail(const std::string& words) {
  ++failures_;
  last_ = words;
  throw kernel_failure("it " + words);
}

void failure_count::fail_late(const std::string& words) {
  ++waits_;
  last_ = words;
  throw kernel_failure("it " + words);
}

kernel_facts facts_of_pipe(const std::string& command) {
  return {"pipe:" + command, 8, "listing", "a command", "", "", false};
}

std::unique_ptr<kernel> make_pipe(const std::string& command, const outside_limits& limits) {
  return std::make_unique<pipe_kernel>(command, limits);
}

}  // namespace contct
