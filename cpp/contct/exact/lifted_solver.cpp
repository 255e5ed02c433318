#include "contct/exact/lifted_solver.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace contct {
namespace {

/// The largest primes below 2^61. If a matrix is by chance singular modulo one prime, the next one is used.
constexpr std::uint64_t two_to_61 = std::uint64_t{1} << 61U;
constexpr std::array<std::uint64_t, 6> primes = {two_to_61 - 1,   two_to_61 - 31,  two_to_61 - 45,
                                                 two_to_61 - 229, two_to_61 - 259, two_to_61 - 283};

// The innermost loops use the functions of GMP for single words, if it is available.

std::uint64_t residue_of(const integer& x, std::uint64_t p) {
  const std::uint64_t r = boost::multiprecision::integer_modulus(x, p);  // residue of |x|
  return x < 0 && r != 0 ? p - r : r;
}

/// r -= a x.
void subtract_product(integer& r, const integer& a, std::uint64_t x) {
#ifdef CONTCT_HAS_GMP
  if constexpr (sizeof(unsigned long) == sizeof x) {
    mpz_submul_ui(r.backend().data(), a.backend().data(), x);
    return;
  }
#endif
  r -= a * x;
}

/// Finds the denominator of a fraction that equals y modulo m, with numerator and denominator at most
/// `bound`; false if there is no such fraction. Uses the algorithm of Euclid, stopped halfway (Wang 1981).
bool fraction_of(const integer& y, const integer& m, const integer& bound, integer& denominator) {
  integer r0 = m;
  integer r1 = y;
  integer t0 = 0;
  integer t1 = 1;
  while (r1 > bound) {
    const integer quotient = r0 / r1;
    integer next = r0 - quotient * r1;
    r0 = std::move(r1);
    r1 = std::move(next);
    next = t0 - quotient * t1;
    t0 = std::move(t1);
    t1 = std::move(next);
  }
  denominator = abs(t1);
  return denominator <= bound;
}

}  // namespace

std::uint64_t lifted_solver::field::inverse(std::uint64_t a) const {
  std::uint64_t power = 1;  // a^(p - 2), by Fermat
  for (std::uint64_t e = p_ - 2; e != 0; e >>= 1U) {
    if ((e & 1U) != 0) power = times(power, a);
    a = times(a, a);
  }
  return power;
}

bool lifted_solver::field::take(const rational& x, std::uint64_t& residue) const {
  const std::uint64_t bottom = residue_of(denominator(x), p_);
  if (bottom == 0) return false;
  residue = residue_of(numerator(x), p_);
  if (bottom != 1) residue = times(residue, inverse(bottom));
  return true;
}

/// Solves (K + springs) x = b: finds the digits of common_ x to the base of the prime, and from them x.
class lifted_solver::lifting {
 public:
  lifting(const lifted_solver& of, const rational_vector& b) : of_(of), rest_(b.size()), sum_(b.size()) {
    for (std::size_t i = 0; i < b.size(); ++i)
      if (of_.has_pivot(i))
        common_ =
            boost::multiprecision::lcm(common_, denominator(rational(b[i] * rational(of_.whole_[i].scale))));
    for (std::size_t i = 0; i < b.size(); ++i)
      if (of_.has_pivot(i)) rest_[i] = numerator(rational(b[i] * rational(of_.whole_[i].scale * common_)));
    right_ = rest_;
  }

  rational_vector solution() {
    rational_vector x;
    for (std::size_t wanted = 4;; wanted += wanted / 2) {
      while (gathered_ + digits_.size() < wanted) next_digits();
      gather();
      if (reconstruct(x)) return x;
      if (wanted * 61 > 2 * of_.longest_)
        throw too_long("numerators of more than " + std::to_string(of_.longest_) + " bits");
    }
  }

 private:
  /// Computes the next digits x, with A x = rest modulo p, and replaces the rest by (rest - A x) / p. A: the
  /// rows in whole_.
  void next_digits() {
    const field& f = of_.field_;
    std::vector<std::uint64_t> x(rest_.size(), 0);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (of_.has_pivot(i)) x[i] = f.times(residue_of(rest_[i], f.prime()), of_.unscale_[i]);
    of_.solve_modulo(x);
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (const auto& [column, entry] : of_.whole_[i].entries) subtract_product(rest_[i], entry, x[column]);
      rest_[i] /= f.prime();  // the remainder is 0
    }
    digits_.push_back(std::move(x));
  }

  /// The number with the digits [from, to) of `dof`. Adds it up by halves: a few products of long numbers are
  /// faster than many of short ones.
  integer number(std::size_t dof, std::size_t from, std::size_t to) {
    constexpr std::size_t few = 16;
    integer n = 0;
    if (to - from <= few) {
      const integer p = of_.field_.prime();
      for (std::size_t k = to; k-- > from;) n = n * p + digits_[k][dof];
      return n;
    }
    const std::size_t middle = from + (to - from) / 2;
    return number(dof, from, middle) + number(dof, middle, to) * power(middle - from);
  }

  const integer& power(std::size_t exponent) {
    integer& known = powers_[exponent];
    if (known == 0)
      known = boost::multiprecision::pow(integer(of_.field_.prime()), static_cast<unsigned>(exponent));
    return known;
  }

  /// Adds to sum_ the digits found since the last call.
  void gather() {
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += number(i, 0, digits_.size()) * modulus_;
    modulus_ *= power(digits_.size());
    gathered_ += digits_.size();
    digits_.clear();
  }

  /// The integer nearest to 0 that equals `y` modulo p^k.
  [[nodiscard]] integer nearest(const integer& y) const {
    integer r = y % modulus_;
    if (r * 2 > modulus_) r -= modulus_;
    return r;
  }

  /// Finds the solution x with the present digits and one denominator for all numbers; false if more digits
  /// are needed.
  bool reconstruct(rational_vector& x) const {
    const integer bound = integer(1) << static_cast<unsigned>(msb(modulus_) / 2 - 1);
    integer denominator = 1;
    for (const integer& digits : sum_) {
      const integer y = nearest(digits * denominator);
      if (abs(y) <= bound) continue;
      integer factor;
      if (!fraction_of(y < 0 ? integer(y + modulus_) : y, modulus_, bound, factor)) return false;
      denominator *= factor;
      if (denominator > bound) return false;
    }
    std::vector<integer> numerators;
    for (const integer& digits : sum_) numerators.push_back(nearest(digits * denominator));
    if (!solves(numerators, denominator)) return false;
    x.clear();
    for (const integer& n : numerators) x.emplace_back(n, integer(denominator * common_));
    return true;
  }

  [[nodiscard]] bool solves(const std::vector<integer>& numerators, const integer& denominator) const {
    for (std::size_t i = 0; i < right_.size(); ++i) {
      integer sum = right_[i] * denominator;
      for (const auto& [column, entry] : of_.whole_[i].entries) sum -= entry * numerators[column];
      if (sum != 0) return false;
    }
    return true;
  }

  const lifted_solver& of_;
  integer common_ = 1;                 // a multiple of all denominators of b
  std::vector<integer> rest_, right_;  // common_ b times the scales of the rows: its remainder, all of it
  std::vector<std::vector<std::uint64_t>> digits_;  // digits since the last gather()
  std::vector<integer> sum_;                        // sum of digits times powers of the prime
  std::map<std::size_t, integer> powers_;           // powers of the prime, by exponent
  std::size_t gathered_ = 0;
  integer modulus_ = 1;  // the prime to the power gathered_
};

lifted_solver::lifted_solver(const rational_rows& k, std::span<const char> fixed, std::span<const int> place,
                             std::size_t longest)
    : k_(k),
      fixed_(fixed),
      place_(place),
      longest_(longest),
      dof_at_(place.size()),
      spring_(k.size()),
      field_(primes[0]),
      free_(k.size(), 0) {
  for (std::size_t i = 0; i < k.size(); ++i) {
    dof_at_[place[i]] = static_cast<int>(i);
    for (const auto& [j, entry] : k[i])
      band_ = std::max(band_, static_cast<std::size_t>(std::abs(place[i] - place[j])));
  }
}

void lifted_solver::factor(const std::vector<added_spring>& springs) {
  std::fill(spring_.begin(), spring_.end(), rational(0));
  beside_.clear();
  for (const added_spring& s : springs) {
    spring_[s.dof] += s.stiffness;
    if (s.other < 0) continue;
    spring_[s.other] += s.stiffness;
    beside_[{s.dof, s.other}] -= s.stiffness;
    beside_[{s.other, s.dof}] -= s.stiffness;
  }
  for (const std::uint64_t prime : primes)
    if (factor_modulo(prime) && find_free_motions()) return;
  throw std::runtime_error("the stiffness matrix is indefinite; allowed: a positive semidefinite matrix");
}

rational lifted_solver::entry(std::size_t row, int column, const rational& k) const {
  if (static_cast<int>(row) == column) return k + spring_[row];
  const auto between = beside_.find({static_cast<int>(row), column});
  return between == beside_.end() ? k : rational(k + between->second);
}

/// Factors K + springs = L D L' modulo `prime`. False if the prime is unsuitable for the matrix.
bool lifted_solver::factor_modulo(std::uint64_t prime) {
  const std::size_t n = k_.size();
  const std::size_t width = band_ + 1;
  field_ = field(prime);
  factor_.assign(n * width, 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (const auto& [j, k] : k_[i]) {
      const std::size_t column = j;
      if (place_[i] < place_[column] || fixed_[i] != 0 || fixed_[column] != 0) continue;
      const std::size_t at = place_[column];
      if (!field_.take(entry(i, j, k), factor_[at * width + place_[i] - at])) return false;
    }
  }
  inverse_.assign(n, 0);
  std::fill(free_.begin(), free_.end(), 0);
  for (std::size_t j = 0; j < n; ++j) {
    std::uint64_t* const column = &factor_[j * width];
    const std::size_t dof = dof_at_[j];
    if (fixed_[dof] != 0) continue;
    if (column[0] == 0) {  // in a semidefinite matrix the whole column is 0
      if (std::any_of(column, column + width, [](std::uint64_t x) { return x != 0; })) return false;
      free_[dof] = 1;
      continue;
    }
    inverse_[j] = field_.inverse(column[0]);
    for (std::size_t a = 1; a < width && j + a < n; ++a) {
      const std::uint64_t l = field_.times(column[a], inverse_[j]);
      if (l == 0) continue;
      std::uint64_t* const target = &factor_[(j + a) * width];
      for (std::size_t b = a; b < width && j + b < n; ++b)
        target[b - a] = field_.minus(target[b - a], field_.times(l, column[b]));
    }
    for (std::size_t a = 1; a < width; ++a) column[a] = field_.times(column[a], inverse_[j]);
  }
  whole_.assign(n, {});
  unscale_.assign(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    if (!has_pivot(i)) continue;
    whole_[i] = whole(i);
    const std::uint64_t scale = residue_of(whole_[i].scale, prime);
    if (scale == 0) return false;
    unscale_[i] = field_.inverse(scale);
  }
  return true;
}

lifted_solver::whole_row lifted_solver::whole(std::size_t dof) const {
  whole_row row{{}, 1};
  for (const auto& [j, k] : k_[dof])
    if (has_pivot(j)) row.scale = boost::multiprecision::lcm(row.scale, denominator(entry(dof, j, k)));
  for (const auto& [j, k] : k_[dof])
    if (has_pivot(j) && entry(dof, j, k) != 0)
      row.entries.emplace_back(j, numerator(rational(entry(dof, j, k) * rational(row.scale))));
  return row;
}

/// Solves L D L' y = x modulo the prime, in place.
void lifted_solver::solve_modulo(std::vector<std::uint64_t>& x) const {
  const std::size_t n = x.size();
  const std::size_t width = band_ + 1;
  std::vector<std::uint64_t> y(n);
  for (std::size_t j = 0; j < n; ++j) y[j] = x[dof_at_[j]];
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t a = 1; a < width && j + a < n && y[j] != 0; ++a)
      y[j + a] = field_.minus(y[j + a], field_.times(factor_[j * width + a], y[j]));
  for (std::size_t j = 0; j < n; ++j) y[j] = field_.times(y[j], inverse_[j]);
  for (std::size_t j = n; j-- > 0;)
    for (std::size_t a = 1; a < width && j + a < n; ++a)
      y[j] = field_.minus(y[j], field_.times(factor_[j * width + a], y[j + a]));
  for (std::size_t j = 0; j < n; ++j) x[dof_at_[j]] = y[j];
}

/// Finds one motion for each free dof without a pivot, which moves this dof by 1. False if K + springs
/// resists one of these motions.
bool lifted_solver::find_free_motions() {
  free_motions_.clear();
  for (std::size_t j = 0; j < free_.size(); ++j) {
    if (free_[j] == 0) continue;
    rational_vector b(free_.size());
    for (const auto& [row, k] : k_[j]) b[row] = -entry(j, row, k);
    rational_vector motion = lifting(*this, b).solution();
    motion[j] = 1;
    for (std::size_t row = 0; row < free_.size(); ++row) {
      if (free_[row] == 0) continue;
      rational force;
      for (const auto& [column, k] : k_[row]) force += entry(row, column, k) * motion[column];
      if (force != 0) return false;
    }
    free_motions_.push_back(std::move(motion));
  }
  return true;
}

rational_vector lifted_solver::solve(const rational_vector& b) const {
  return lifting(*this, b).solution();
}

}  // namespace contct
