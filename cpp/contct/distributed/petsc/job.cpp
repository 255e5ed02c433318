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

#include "contct/distributed/petsc/shared_matrix.hpp"
#include "contct/distributed/ranks.hpp"

namespace contct::distributed::petsc {
namespace {

enum class verb : int { make, factor, solve, solve_units, watch, drop, measure, leave };

/// What rank 0 wants of all ranks.
struct command {
  verb what;
  int matrix = 0;  // which
  int count = 0;   // its order; rows to be watched
  std::array<int, matrix::block_width> units = {};
};

/// What rank 0 gives with a command, or takes; null on other ranks.
struct given {
  const matrix::sparse_columns* matrix = nullptr;
  double* vector = nullptr;                  // a diagonal, or a right-hand side that becomes the solution
  const std::vector<int>* rows = nullptr;    // to be watched
  std::vector<double>* solutions = nullptr;  // at these
  long* peaks = nullptr;                     // [ranks]
};

class petsc_ranks;

/// A distributed matrix in the hands of rank 0.
class remote_factor final : public matrix::sparse_factor {
 public:
  remote_factor(petsc_ranks& all, int number, const matrix::sparse_columns& a);
  ~remote_factor() override;
  [[nodiscard]] std::int64_t bytes() const override { return static_cast<std::int64_t>(bytes_); }
  [[nodiscard]] bool factor(std::span<const double> diagonal) override;
  void solve(std::span<double> b) override;
  void solve_units(std::span<const int> rows, std::vector<double>& x) override;
  [[nodiscard]] bool solve_units_at(std::span<const int> rows, std::span<const int> at,
                                    std::vector<double>& x) override;
  [[nodiscard]] bool update(int /*row*/, double /*k*/, bool /*add*/) override { return false; }
  [[nodiscard]] matrix::sparse_columns lower() const override { throw no_such(); }
  [[nodiscard]] const std::vector<int>& places() const override { throw no_such(); }
  [[nodiscard]] double flops() const override { return flops_; }

 private:
  [[nodiscard]] static std::logic_error no_such() {
    return std::logic_error("a distributed factor cannot be read");
  }
  petsc_ranks& all_;
  int number_;
  double flops_ = 0.0, bytes_ = 0.0;
};

/// The job. What fails on a rank alone ends the job: the others wait for it.
class petsc_ranks final : public ranks {
 public:
  petsc_ranks() {
    MPI_Init(nullptr, nullptr);
    MPI_Comm_rank(MPI_COMM_WORLD, &own_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
    char name[] = "contct", signals[] = "-no_signal_handler", file[] = "-skip_petscrc";
    char left[] = "-options_left", no[] = "no";
    char* words[] = {name, signals, file, left, no, nullptr};
    char** argv = words;
    int argc = 5;
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
    return std::make_unique<remote_factor>(*this, made_++, a);
  }

  [[nodiscard]] std::vector<long> peak_kib() override {
    std::vector<long> peaks(static_cast<std::size_t>(count_));
    (void)command_all({verb::measure}, {.peaks = peaks.data()});
    return peaks;
  }

  /// Rank 0: all ranks do this; returns what `obey` does. `data` is what rank 0 gives or takes.
  int command_all(command c, const given& g) {
    tell(c);
    return obey(c, g);
  }
  [[nodiscard]] shared_matrix& at(int number) { return *matrices_.at(number); }

 private:
  int obey(const command& c, const given& g) {
    int came_to = 0;
    together([&] { came_to = act(c, g); });
    return came_to;
  }

  int act(const command& c, const given& g) {
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
      case verb::leave:
        break;
    }
    return 0;
  }

  static void gather_peaks(long* peaks) {
    rusage used{};
    (void)getrusage(RUSAGE_SELF, &used);
    MPI_Gather(&used.ru_maxrss, 1, MPI_LONG, peaks, 1, MPI_LONG, 0, MPI_COMM_WORLD);
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

  [[noreturn]] void abandon(const std::string& why) {
    const std::string line = "contct: rank " + std::to_string(own_) + ": " + why + "\n";
    (void)std::fputs(line.c_str(), stderr);
    constexpr int bad_input = 2;
    MPI_Abort(MPI_COMM_WORLD, bad_input);
    _exit(bad_input);
  }

  void tell(command& c) {
    MPI_Request sent = MPI_REQUEST_NULL;
    MPI_Ibcast(&c, sizeof c, MPI_BYTE, 0, MPI_COMM_WORLD, &sent);
    MPI_Wait(&sent, MPI_STATUS_IGNORE);
  }

  /// Waits for rank 0, which may be long about something else: the longer, the less often this asks.
  command next() {
    command c{verb::leave};
    MPI_Request coming = MPI_REQUEST_NULL;
    MPI_Ibcast(&c, sizeof c, MPI_BYTE, 0, MPI_COMM_WORLD, &coming);
    using clock = std::chrono::steady_clock;
    const auto begun = clock::now();
    for (int arrived = 0;;) {
      MPI_Test(&coming, &arrived, MPI_STATUS_IGNORE);
      if (arrived != 0) return c;
      const auto waited = std::chrono::duration_cast<std::chrono::microseconds>(clock::now() - begun);
      constexpr std::int64_t patience = 2000, longest = 1000;  // microseconds
      if (waited.count() > patience)
        (void)usleep(static_cast<useconds_t>(std::min(waited.count() / 64, longest)));
    }
  }

  void end() {
    matrices_.clear();
    (void)PetscFinalize();
    MPI_Barrier(MPI_COMM_WORLD);  // mpirun ends a job as soon as a rank ends with another status than 0
    MPI_Finalize();
  }

  int own_ = 0, count_ = 1, made_ = 0;
  std::map<int, std::unique_ptr<shared_matrix>> matrices_;
};

remote_factor::remote_factor(petsc_ranks& all, int number, const matrix::sparse_columns& a)
    : all_(all), number_(number) {
  (void)all_.command_all({verb::make, number_, a.order()}, {.matrix = &a});
  flops_ = all_.at(number_).own().flops();
  bytes_ = all_.at(number_).own().bytes();
}

remote_factor::~remote_factor() {
  (void)all_.command_all({verb::drop, number_}, {});
}

bool remote_factor::factor(std::span<const double> diagonal) {
  std::vector<double> copy(diagonal.begin(), diagonal.end());
  const auto found =
      static_cast<factored>(all_.command_all({verb::factor, number_}, {.vector = copy.data()}));
  if (found == factored::no_memory) throw std::bad_alloc();
  if (found != factored::failed) return found == factored::yes;
  const auto [code, detail] = all_.at(number_).own().mumps_said();
  throw std::runtime_error("MUMPS cannot factor the stiffness: INFOG(1) = " + std::to_string(code) +
                           ", INFOG(2) = " + std::to_string(detail));
}

void remote_factor::solve(std::span<double> b) {
  (void)all_.command_all({verb::solve, number_}, {.vector = b.data()});
}

bool remote_factor::solve_units_at(std::span<const int> rows, std::span<const int> at,
                                   std::vector<double>& x) {
  if (!all_.at(number_).watches(at)) {
    std::vector<int> watched(at.begin(), at.end());
    (void)all_.command_all({verb::watch, number_, static_cast<int>(watched.size())}, {.rows = &watched});
  }
  command c{verb::solve_units, number_, static_cast<int>(rows.size())};
  std::copy(rows.begin(), rows.end(), c.units.begin());
  (void)all_.command_all(c, {.solutions = &x});
  return true;
}

void remote_factor::solve_units(std::span<const int> rows, std::vector<double>& x) {
  std::vector<int> all(static_cast<std::size_t>(all_.at(number_).order()));
  std::iota(all.begin(), all.end(), 0);
  (void)solve_units_at(rows, all, x);
}

}  // namespace
}  // namespace contct::distributed::petsc

#define CONTCT_EXPORTED extern "C" __attribute__((visibility("default")))

CONTCT_EXPORTED const char* contct_petsc_version() {
  return CONTCT_VERSION;
}

CONTCT_EXPORTED contct::distributed::ranks* contct_petsc_join() {
  return new contct::distributed::petsc::petsc_ranks();  // as long as the process
}
