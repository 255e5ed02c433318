// The module contct_petsc: the ranks of an MPI job, with PETSc and MUMPS. Rank 0 sends a command before
// everything that all ranks do together.
#include <petscmat.h>
#include <petscsys.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "contct/distributed/petsc/file_parts.hpp"
#include "contct/distributed/petsc/matrix_file.hpp"
#include "contct/distributed/petsc/own_matrix.hpp"
#include "contct/distributed/petsc/packed_plate.hpp"
#include "contct/distributed/petsc/remote.hpp"
#include "contct/distributed/ranks.hpp"
#include "contct/text/input_text.hpp"

namespace contct::distributed::petsc {
namespace {

/// The job. What fails on a rank alone ends the job: the others wait for it.
class petsc_ranks final : public ranks, public commander {
 public:
  petsc_ranks() {
    MPI_Init(nullptr, nullptr);
    MPI_Comm_rank(MPI_COMM_WORLD, &own_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
    std::string words[] = {"contct", "-no_signal_handler", "-skip_petscrc", "-options_left", "no"};
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    int argc = static_cast<int>(pointers.size());
    pointers.push_back(nullptr);
    char** argv = pointers.data();
    together([&] {
      succeed(PetscInitialize(&argc, &argv, nullptr, nullptr));
      succeed(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
    });
  }

  [[nodiscard]] int own() const override { return own_; }
  [[nodiscard]] int count() const override { return count_; }

  void serve() override {
    for (command c = next(); c.what != verb::leave; c = next()) (void)obey(c, {});
    end();
  }

  void leave() noexcept override {
    command c{verb::leave};
    tell(c);
    end();
  }

  [[nodiscard]] std::unique_ptr<matrix::sparse_factor> distribute(const matrix::sparse_columns& a) override {
    return std::make_unique<remote_factor>(*this, new_number(), a);
  }

  [[nodiscard]] std::unique_ptr<matrix::remote_matrix> stiffness_of(const structure::plate& p) override {
    const std::vector<double> sent = packed(p);
    std::string refused;
    const int number = new_number();
    (void)command_all({verb::assemble, number}, {.doubles = sent, .refused = &refused});
    if (!refused.empty()) throw std::invalid_argument(refused);
    return std::make_unique<remote_stiffness>(*this, number, p.dofs());
  }

  [[nodiscard]] std::unique_ptr<matrix::remote_matrix> read_stiffness(const std::string& path,
                                                                      const std::string& name,
                                                                      int rows) override {
    const std::string names = path + '\0' + name;
    std::string refused;
    const int number = new_number();
    const int order = command_all({verb::read, number, 0, rows}, {.marks = names, .refused = &refused});
    if (!refused.empty()) throw text::input_error(refused);
    return std::make_unique<remote_stiffness>(*this, number, order);
  }

  [[nodiscard]] std::vector<long> peak_kib() override {
    std::vector<long> peaks(static_cast<std::size_t>(count_));
    (void)command_all({verb::measure}, {.peaks = peaks.data()});
    return peaks;
  }

  int command_all(command c, const given& g) override {
    tell(c);
    return obey(c, g);
  }
  [[nodiscard]] shared_matrix& at(int number) override { return *matrices_.at(number); }
  [[nodiscard]] int new_number() override { return made_++; }

 private:
  int obey(const command& c, const given& g) {
    int came_to = 0;
    together([&] { came_to = act(c, g); });
    return came_to;
  }

  int act(const command& c, const given& g) {
    if (c.what >= verb::make_truth && c.what <= verb::drop_truth) return act_on_truth(c, g);
    if (c.what >= verb::assemble && c.what <= verb::drop_stiffness) return act_on_stiffness(c, g);
    switch (c.what) {
      case verb::make:
        matrices_[c.matrix] = std::make_unique<shared_matrix>(MPI_COMM_WORLD, c.count, g.matrix);
        break;
      case verb::factor:
        return static_cast<int>(at(c.matrix).factor(g.vector));
      case verb::solve:
        at(c.matrix).solve(g.vector);
        break;
      case verb::watch:
        at(c.matrix).watch(g.rows != nullptr ? *g.rows : std::vector<int>(static_cast<std::size_t>(c.count)));
        break;
      case verb::solve_units:
        at(c.matrix).solve_units(std::span(c.units).first(static_cast<std::size_t>(c.count)), g.solutions);
        break;
      case verb::drop:
        matrices_.erase(c.matrix);
        break;
      case verb::measure:
        gather_peaks(g.peaks);
        break;
      default:
        break;
    }
    return 0;
  }

  int act_on_stiffness(const command& c, const given& g) {
    if (c.what == verb::assemble) return assemble(c, g);
    if (c.what == verb::read) return read(c, g);
    own_matrix& own = stiffnesses_.at(c.from);
    switch (c.what) {
      case verb::copy:
        stiffnesses_[c.matrix] = own;
        break;
      case verb::scale:
        own.scale(everywhere(g.doubles));
        break;
      case verb::diagonal:
        give(own.diagonal(), g.found);
        break;
      case verb::entries_in:
        give(own.entries_in(everywhere(g.marks)), g.entries);
        break;
      case verb::times:
        give(own.times(everywhere(g.longs)), g.found_longs);
        break;
      case verb::magnitudes:
        give(own.magnitudes(everywhere(g.doubles)), g.found);
        break;
      case verb::half_units:
        give(own.half_units(everywhere(g.doubles)), g.found);
        break;
      case verb::sums:
        give(own.sums(everywhere(g.doubles)), g.found);
        break;
      case verb::to_factor: {
        const std::vector<double> d = everywhere(g.doubles);
        share(c.matrix, static_cast<int>(d.size()), upper_of(own.rows, d), own.rigid_motions(d));
        break;
      }
      case verb::drop_stiffness:
        stiffnesses_.erase(c.from);
        break;
      default:
        break;
    }
    return 0;
  }

  int act_on_truth(const command& c, const given& g) {
    if (c.what == verb::make_truth) {
      truths_[c.matrix] = stiffnesses_.at(c.from).truth();
      return 0;
    }
    const own_truth& own = truths_.at(c.from);
    switch (c.what) {
      case verb::true_diagonal:
        give(own.diagonal(), g.found_decimals);
        break;
      case verb::true_times:
        give(own.times(everywhere(g.decimals)), g.found_decimals);
        break;
      case verb::true_sums:
        give(own.sums(everywhere(g.doubles)), g.found);
        break;
      case verb::widest_row: {
        int widest = own.widest_row();
        MPI_Allreduce(MPI_IN_PLACE, &widest, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
        return widest;
      }
      case verb::truth_to_factor: {
        const std::vector<double> d = everywhere(g.doubles);
        share(c.matrix, static_cast<int>(d.size()), upper_of(own.rows, d), {});
        break;
      }
      case verb::drop_truth:
        truths_.erase(c.from);
        break;
      default:
        break;
    }
    return 0;
  }

  /// The parts of all ranks to where rank 0 takes them.
  template <class Number>
  static void give(const std::vector<Number>& part, std::vector<Number>* found) {
    std::vector<Number> all = gathered(MPI_COMM_WORLD, std::span<const Number>(part));
    if (found != nullptr) *found = std::move(all);
  }

  template <class Number>
  [[nodiscard]] static std::vector<Number> everywhere(std::span<const Number> whole) {
    return from_rank_0(MPI_COMM_WORLD, whole);
  }

  void share(int number, int order, const upper_rows& own, const own_motions& motions) {
    matrices_[number] = std::make_unique<shared_matrix>(MPI_COMM_WORLD, order, own, motions);
  }

  /// The order.
  int read(const command& c, const given& g) {
    const std::vector<char> names = everywhere(g.marks);
    const auto end = std::find(names.begin(), names.end(), '\0');
    try {
      const own_matrix& own = stiffnesses_[c.matrix] =
          read_own(MPI_COMM_WORLD, {{names.begin(), end}, {end + 1, names.end()}, c.count});
      int order = own.rows.count();
      MPI_Allreduce(MPI_IN_PLACE, &order, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
      return order;
    } catch (const text::input_error& e) {  // on every rank, with the same words
      stiffnesses_.erase(c.matrix);
      if (g.refused != nullptr) *g.refused = e.what();
      return 0;
    }
  }

  /// A number that is not finite is refused by whichever rank finds it.
  int assemble(const command& c, const given& g) {
    const auto p = std::make_shared<const structure::plate>(unpacked(everywhere(g.doubles)));
    try {
      const own_rows own(MPI_COMM_WORLD, p->dofs());
      agree_on(MPI_COMM_WORLD, [&] { stiffnesses_[c.matrix] = own_matrix_of(p, own); });
    } catch (const text::input_error& e) {  // on every rank, with the same words
      stiffnesses_.erase(c.matrix);
      if (g.refused != nullptr) *g.refused = e.what();
    }
    return 0;
  }

  /// The agreement is on errors in what is read.
  static own_matrix own_matrix_of(const std::shared_ptr<const structure::plate>& p, const own_rows& own) {
    try {
      return matrix_of(p, own);
    } catch (const std::invalid_argument& e) {
      throw text::input_error(e.what());
    }
  }

  static void gather_peaks(long* peaks) {
    rusage used{};
    (void)getrusage(RUSAGE_SELF, &used);
    const long peak = used.ru_maxrss;  // NOLINT(cppcoreguidelines-pro-type-union-access): glibc's
    MPI_Gather(&peak, 1, MPI_LONG, peaks, 1, MPI_LONG, 0, MPI_COMM_WORLD);
  }

  /// What all ranks do, and where no rank may fail alone.
  template <class Work>
  void together(Work work) {
    try {
      work();
    } catch (const std::bad_alloc&) {
      abandon("out of memory");
    } catch (const std::exception& e) {
      abandon(e.what());
    }
  }

  [[noreturn]] void abandon(const std::string& why) const {
    const std::string line = "contct: rank " + std::to_string(own_) + ": " + why + "\n";
    (void)std::fputs(line.c_str(), stderr);
    constexpr int bad_input = 2;
    MPI_Abort(MPI_COMM_WORLD, bad_input);
    _exit(bad_input);
  }

  static void tell(command& c) {
    MPI_Request sent = MPI_REQUEST_NULL;
    MPI_Ibcast(&c, sizeof c, MPI_BYTE, 0, MPI_COMM_WORLD, &sent);
    MPI_Wait(&sent, MPI_STATUS_IGNORE);
  }

  /// Waits for rank 0, which may be long about something else: the longer, the less often this asks.
  static command next() {
    command c{verb::leave};
    MPI_Request coming = MPI_REQUEST_NULL;
    MPI_Ibcast(&c, sizeof c, MPI_BYTE, 0, MPI_COMM_WORLD, &coming);
    using clock = std::chrono::steady_clock;
    const auto begun = clock::now();
    for (int arrived = 0;;) {
      MPI_Test(&coming, &arrived,
               MPI_STATUS_IGNORE);  // NOLINT(clang-analyzer-optin.mpi.MPI-Checker): it waits
      if (arrived != 0) return c;
      const auto waited = std::chrono::duration_cast<std::chrono::microseconds>(clock::now() - begun);
      constexpr std::int64_t patience = 2000;  // microseconds
      constexpr std::int64_t longest = 1000;
      if (waited.count() > patience)
        (void)usleep(static_cast<useconds_t>(std::min(waited.count() / 64, longest)));
    }
  }

  void end() {
    matrices_.clear();
    stiffnesses_.clear();
    truths_.clear();
    (void)PetscFinalize();
    MPI_Barrier(MPI_COMM_WORLD);  // mpirun ends a job as soon as a rank ends with another status than 0
    MPI_Finalize();
  }

  int own_ = 0, count_ = 1, made_ = 0;
  std::map<int, std::unique_ptr<shared_matrix>> matrices_;
  std::map<int, own_matrix> stiffnesses_;
  std::map<int, own_truth> truths_;
};

}  // namespace
}  // namespace contct::distributed::petsc

#define CONTCT_EXPORTED extern "C" __attribute__((visibility("default")))

CONTCT_EXPORTED const char* contct_petsc_version() {
  return CONTCT_VERSION;
}

CONTCT_EXPORTED contct::distributed::ranks* contct_petsc_join() {
  return new contct::distributed::petsc::petsc_ranks();  // as long as the process
}
