#include "bench/peers/exchange.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

namespace bench::peers {
namespace {

/// Numbers and words of a file, one after the other. from_chars: every digit counts, and "nan" is a number.
class words {
 public:
  explicit words(const std::string& path) : path_(path) {
    std::ifstream in(path, std::ios::binary);
    text_.assign(std::istreambuf_iterator<char>(in), {});
    if (!in || text_.empty()) throw std::runtime_error(path + " cannot be read, or is empty");
  }
  void line() { at_ = std::min(text_.find('\n', at_), text_.size()); }
  template <class Number>
  [[nodiscard]] Number next() {
    at_ = std::min(text_.find_first_not_of(" \n", at_), text_.size());
    Number value{};
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc())
      throw std::runtime_error(path_ + ": found no number at byte " + std::to_string(at_));
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

 private:
  std::string path_, text_;
  std::size_t at_ = 0;
};

/// A file that is written in full digits.
class lines {
 public:
  explicit lines(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "w")) {
    if (file_ == nullptr) throw std::runtime_error(path + " cannot be written");
  }
  lines(const lines&) = delete;
  lines& operator=(const lines&) = delete;
  ~lines() {
    if (file_ != nullptr) (void)std::fclose(file_);
  }
  template <class... Arguments>
  void add(const char* form, Arguments... arguments) {
    (void)std::fprintf(file_, form, arguments...);
  }
  void finish() {
    const bool whole = std::ferror(file_) == 0;
    if (std::fclose(std::exchange(file_, nullptr)) != 0 || !whole)
      throw std::runtime_error(path_ + " cannot be written");
  }

 private:
  std::string path_;
  std::FILE* file_;
};

std::vector<double> numbers(words& in, std::size_t count) {
  std::vector<double> list(count);
  for (double& x : list) x = in.next<double>();
  return list;
}

}  // namespace

void write_problem(const std::string& folder, const contact_problem& p) {
  lines matrix(folder + "/stiffness.mtx");
  matrix.add("%%%%MatrixMarket matrix coordinate real symmetric\n%d %d %zu\n", p.rows(), p.rows(),
             p.stiffness.values.size());
  for (int column = 0; column < p.rows(); ++column)
    for (int i = p.stiffness.starts[column]; i < p.stiffness.starts[column + 1]; ++i)
      matrix.add("%d %d %.17g\n", p.stiffness.rows[i] + 1, column + 1, p.stiffness.values[i]);
  matrix.finish();
  lines rest(folder + "/problem.txt");
  for (const double f : p.load) rest.add("%.17g\n", f);
  rest.add("%zu\n", p.springs.size());
  for (const one_sided_spring& s : p.springs)
    rest.add("%d %d %.17g %.17g\n", s.row, s.side, s.face, s.stiffness);
  rest.finish();
}

contact_problem read_problem(const std::string& folder) {
  contact_problem p;
  {
    words in(folder + "/stiffness.mtx");
    in.line();
    const int order = in.next<int>();
    (void)in.next<int>();
    const int entries = in.next<int>();
    p.stiffness.starts.assign(order + 1, 0);
    for (int i = 0; i < entries; ++i) {
      p.stiffness.rows.push_back(in.next<int>() - 1);
      ++p.stiffness.starts[in.next<int>()];
      p.stiffness.values.push_back(in.next<double>());
    }
    for (int column = 0; column < order; ++column)
      p.stiffness.starts[column + 1] += p.stiffness.starts[column];
  }
  words in(folder + "/problem.txt");
  p.load = numbers(in, p.rows());
  for (auto left = in.next<std::size_t>(); left > 0; --left) {
    one_sided_spring s{};
    s.row = in.next<int>();
    s.side = in.next<int>();
    s.face = in.next<double>();
    s.stiffness = in.next<double>();
    p.springs.push_back(s);
  }
  return p;
}

void write_answer(const std::string& folder, const answer& a) {
  lines out(folder + "/answer.txt");
  out.add("%d %.9g %.9g %d %ld %zu %zu\n", a.found ? 1 : 0, a.seconds, a.build_seconds, a.steps, a.peak_kib,
          a.u.size(), a.forces.size());
  for (const double x : a.u) out.add("%.17g\n", x);
  for (const double x : a.forces) out.add("%.17g\n", x);
  out.finish();
}

answer read_answer(const std::string& folder) {
  words in(folder + "/answer.txt");
  answer a;
  a.found = in.next<int>() != 0;
  a.seconds = in.next<double>();
  a.build_seconds = in.next<double>();
  a.steps = in.next<int>();
  a.peak_kib = in.next<long>();
  const auto rows = in.next<std::size_t>();
  const auto springs = in.next<std::size_t>();
  a.u = numbers(in, rows);
  a.forces = numbers(in, springs);
  return a;
}

std::vector<double> forces_under(const contact_problem& p, const std::vector<double>& u) {
  std::vector<double> forces;
  for (const one_sided_spring& s : p.springs)
    forces.push_back(std::max(0.0, s.stiffness * s.side * (u[s.row] - s.face)));
  return forces;
}

double process_seconds() {
  timespec t{};
  (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

long own_peak_kib() {
  // Not getrusage: that counts the process which started this one, too.
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return std::stol(line.substr(6));
  return 0;
}

int solve_as_asked(int argc, char** argv,
                   answer (*solve)(const std::string& method, const std::string& folder)) {
  if (argc != 4) {
    (void)std::fprintf(stderr, "usage: %s METHOD FOLDER ROUNDS\n", argv[0]);
    return 2;
  }
  try {
    const std::string folder = argv[2];
    std::vector<answer> rounds;
    constexpr double long_enough = 5.0;  // seconds: one run says it
    while (std::ssize(rounds) < std::stoi(argv[3]) && (rounds.empty() || rounds.back().seconds < long_enough))
      rounds.push_back(solve(argv[1], folder));
    std::sort(rounds.begin(), rounds.end(),
              [](const answer& a, const answer& b) { return a.seconds < b.seconds; });
    answer& median = rounds[rounds.size() / 2];
    if (median.peak_kib == 0) median.peak_kib = own_peak_kib();
    write_answer(folder, median);
    return 0;
  } catch (const std::exception& e) {
    (void)std::fprintf(stderr, "%s: %s\n", argv[0], e.what());
    return 1;
  }
}

}  // namespace bench::peers
