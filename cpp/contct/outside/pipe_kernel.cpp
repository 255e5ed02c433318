// A kernel that is a command: one call as trace text in, one answer out.
#include <algorithm>
#include <utility>

#include "contct/outside/child_process.hpp"
#include "contct/trace/trace.hpp"

namespace contct::outside {
namespace {

class pipe_kernel final : public kernel_in_child {
 public:
  pipe_kernel(const std::string& command, const outside_limits& limits)
      : kernel_in_child(facts_of_pipe(command), limits), command_(command) {}

  void answer(call<double>& c) override {
    refuse_when_enough();
    if (child_) refuse_stray_answer();
    if (!child_) child_.emplace([this](int channel) { become_command(command_, channel); });
    const auto until = deadline();
    asked_.clear();
    append_inputs(++calls_, "", c, c.isep, asked_);
    // More than any answer takes: a kernel that never stops talking must not take all memory.
    const std::size_t most_answer = (std::size_t{1} << 20) + 1024 * c.ss.size();
    auto how = child_->send(asked_, until);
    answered_.clear();
    while (how == child_process::sent::whole && !answer_is_whole() && answered_.size() <= most_answer)
      how = child_->receive(answered_, until);
    if (how != child_process::sent::whole) fail_without_answer(how);
    if (answered_.size() > most_answer) fail("answered more than " + std::to_string(most_answer) + " bytes");
    read_answer(c);
  }

  std::string take_text() override { return std::exchange(text_, {}); }

 private:
  /// What comes before anything is asked would be taken for the answer.
  void refuse_stray_answer() {
    answered_.clear();
    if (child_->receive(answered_, child_process::clock::now()) == child_process::sent::whole)
      fail("answered without being called");
  }

  [[nodiscard]] bool answer_is_whole() const {
    return answered_ == "end\n" || answered_.ends_with("\nend\n");
  }

  void read_answer(call<double>& c) {
    out_.ss.resize(c.ss.size());
    out_.isep.resize(c.ss.size());
    try {
      trace_reader reader(answered_, "its answer");
      reader.read_answer(out_);
      if (reader.line() != static_cast<int>(std::count(answered_.begin(), answered_.end(), '\n')))
        throw input_error("its answer continues after \"end\"");
    } catch (const input_error& e) {
      fail(std::string("gave an invalid answer: ") + e.what());
    }
    c.smin = out_.smin;
    std::copy(out_.ss.begin(), out_.ss.end(), c.ss.begin());
    std::copy(out_.isep.begin(), out_.isep.end(), c.isep.begin());
    text_ += out_.text;
  }

  std::string command_;
  std::int64_t calls_ = 0;
  std::string asked_, answered_, text_;
  call_outputs out_;
};

}  // namespace

std::unique_ptr<kernel> make_pipe(const std::string& command, const outside_limits& limits) {
  return std::make_unique<pipe_kernel>(command, limits);
}

}  // namespace contct::outside
