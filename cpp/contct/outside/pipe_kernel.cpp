// Kernels in child processes: one call as trace text in, one answer out; and the one that is a command.
#include <unistd.h>

#include <algorithm>

#include "contct/outside/child_process.hpp"
#include "contct/trace/trace.hpp"

namespace contct::outside {
namespace {

bool is_whole_answer(std::string_view text) {
  return text == "end\n" || text.ends_with("\nend\n");
}

class pipe_kernel final : public kernel_in_child {
 public:
  pipe_kernel(const std::string& command, const outside_limits& limits)
      : kernel_in_child(facts_of_outside("pipe:" + command, "a command"), limits), command_(command) {}

 private:
  /// The child becomes the command, with the channel as its standard input and output.
  void start() override {
    child_.emplace([this](int channel) {
      dup2(channel, STDIN_FILENO);
      dup2(channel, STDOUT_FILENO);
      close(channel);
      execl("/bin/sh", "sh", "-c", command_.c_str(), static_cast<char*>(nullptr));
      _exit(127);
    });
  }

  std::string command_;
};

}  // namespace

kernel_in_child::kernel_in_child(kernel_facts facts, const outside_limits& limits)
    : facts_(std::move(facts)), limits_(limits) {}

void kernel_in_child::refuse_when_enough() const {
  if (failures_ < limits_.most_failures && waits_ < limits_.most_waits) return;
  throw kernel_failure("is not called again after " + std::to_string(failures_ + waits_) +
                       " failures; the last: it " + last_);
}

void kernel_in_child::fail(const std::string& words, bool waited) {
  child_.reset();
  ++(waited ? waits_ : failures_);
  last_ = words;
  throw kernel_failure("it " + words);
}

void kernel_in_child::fail_without_answer(child_process::sent how) {
  const std::string words = child_->end();
  if (how == child_process::sent::late)
    fail("did not answer within " + std::to_string(limits_.patience.count()) + " ms", true);
  if (words == child_process::was_stopped) fail("closed its end of the pipe", true);  // and went on running
  fail(words);
}

/// What comes before anything is asked would be taken for the answer.
void kernel_in_child::refuse_stray_answer() {
  answered_.clear();
  if (child_->receive(answered_, child_process::clock::now()) == child_process::sent::whole)
    fail("answered without being called");
}

void kernel_in_child::answer(call<double>& c) {
  refuse_when_enough();
  if (child_) refuse_stray_answer();
  if (!child_) start();
  const auto until = deadline();
  asked_.clear();
  append_inputs(++calls_, "", c, c.isep, asked_);
  // More than any answer takes: a kernel that never stops talking must not take all memory.
  const std::size_t most_answer = (std::size_t{1} << 20) + 1024 * c.ss.size();
  auto how = child_->send(asked_, until);
  answered_.clear();
  while (how == child_process::sent::whole && !is_whole_answer(answered_) && answered_.size() <= most_answer)
    how = child_->receive(answered_, until);
  if (how != child_process::sent::whole) fail_without_answer(how);
  if (answered_.size() > most_answer) fail("answered more than " + std::to_string(most_answer) + " bytes");
  read_answer(c);
}

void kernel_in_child::read_answer(call<double>& c) {
  if (answered_.starts_with(fault_word))  // with a fresh child next: what else it did is not known
    fail(answered_.substr(fault_word.size(), answered_.find('\n') - fault_word.size()));
  out_.ss.resize(c.ss.size());
  out_.isep.resize(c.ss.size());
  try {
    trace_reader reader(answered_, "its answer");
    reader.read_answer(out_);
    if (reader.line() != std::count(answered_.begin(), answered_.end(), '\n'))
      throw input_error("its answer continues after \"end\"");
  } catch (const input_error& e) {
    fail(std::string("gave an invalid answer: ") + e.what());
  }
  c.smin = out_.smin;
  std::copy(out_.ss.begin(), out_.ss.end(), c.ss.begin());
  std::copy(out_.isep.begin(), out_.isep.end(), c.isep.begin());
  text_ += out_.text;
}

std::unique_ptr<kernel> make_pipe(const std::string& command, const outside_limits& limits) {
  return std::make_unique<pipe_kernel>(command, limits);
}

}  // namespace contct::outside
