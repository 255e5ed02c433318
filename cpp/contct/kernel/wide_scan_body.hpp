// The scan, for one set of instructions: wide_scan.cpp includes this once for each, in a namespace of its
// own, with CONTCT_LANES and CONTCT_TARGET, the attribute of a function that may use them. What is called
// from here has it too, and is inlined.

inline constexpr std::size_t lanes = CONTCT_LANES;
// A minimum over thousands of numbers is limited by latency: two chains of them take half of the time.
inline constexpr std::size_t chains = 2;

using reals = double __attribute__((vector_size(8 * lanes)));
using truths = std::int64_t __attribute__((vector_size(8 * lanes)));  // -1: true
using wholes = int __attribute__((vector_size(4 * lanes)));

template <class Pack, class Number>
CONTCT_PART Pack load(const Number* from) {
  Pack p;
  __builtin_memcpy(&p, from, sizeof p);
  return p;
}

CONTCT_PART void store(const reals& p, double* to) {
  __builtin_memcpy(to, &p, sizeof p);
}

/// Absolute values.
CONTCT_PART reals size_of(const reals& x) {
  constexpr std::int64_t all_but_sign = std::numeric_limits<std::int64_t>::max();
  return __builtin_bit_cast(reals, __builtin_bit_cast(truths, x) & all_but_sign);
}

/// What `of` has at the places at(0), at(1), ..
template <class At>
CONTCT_PART reals collected(const double* of, At at) {
  if constexpr (lanes == 2) return reals{of[at(0)], of[at(1)]};
  if constexpr (lanes == 4) return reals{of[at(0)], of[at(1)], of[at(2)], of[at(3)]};
  if constexpr (lanes == 8)
    return reals{of[at(0)], of[at(1)], of[at(2)], of[at(3)], of[at(4)], of[at(5)], of[at(6)], of[at(7)]};
}

/// What `of` has at the dofs of the pairs from i on.
template <placing Placed>
CONTCT_PART reals at_pairs(const double* of, const pair_arrays& a, std::size_t i) {
  if constexpr (Placed == placing::side_by_side) return load<reals>(of + a.dof_0 + a.id[0] + i);
  if constexpr (Placed == placing::evenly) {
    const std::ptrdiff_t first = a.dof_0 + (a.id[0] + static_cast<std::ptrdiff_t>(i)) * a.step;
    return collected(of + first, [&a](std::ptrdiff_t k) { return k * a.step; });
  }
  if constexpr (Placed == placing::anyhow)
    return collected(of, [&a, i](std::ptrdiff_t k) { return a.dof_0 + a.id[i + k] * a.step; });
}

/// Statuses or sides of the pairs from i on. The product of two is exact, and where it is a zero its sign has
/// no say.
CONTCT_PART reals as_reals(const int* of, std::size_t i) {
  return __builtin_convertvector(load<wholes>(of + i), reals);
}

/// The least s > 0 of each lane.
struct least_of_lanes {
  reals s = reals{} + 1.0;
  truths at = truths{} + -1;  // where: the first pair of the step

  CONTCT_PART void include(const reals& s_of_pairs, const truths& counts, std::size_t i) {
    const truths less = counts & (s_of_pairs < s);
    s = less ? s_of_pairs : s;
    at = less ? truths{} + static_cast<std::int64_t>(i) : at;
  }
};

/// The least of all lanes. Of equal ones the first.
CONTCT_PART least_s least_of(const least_of_lanes* least, std::size_t n) {
  least_s all{1.0, n};
  for (std::size_t j = 0; j < chains; ++j) {
    for (std::size_t k = 0; k < lanes; ++k) {
      if (least[j].at[k] < 0) continue;
      const least_s found{least[j].s[k], static_cast<std::size_t>(least[j].at[k]) + k};
      if (found.s < all.s || (found.s == all.s && found.pair < all.pair)) all = found;
    }
  }
  return all;
}

CONTCT_PART bool is_any(const truths& t) {
  std::int64_t any = 0;
  for (std::size_t k = 0; k < lanes; ++k) any |= t[k];
  return any != 0;
}

CONTCT_TARGET inline bool counts_up(const int* id, std::size_t n) {
  std::size_t i = 1;
  wholes off{};
  for (; i + 4 * lanes <= n; i += 4 * lanes)
    for (std::size_t j = i; j < i + 4 * lanes; j += lanes)
      off |= (load<wholes>(id + j) - load<wholes>(id + j - 1)) ^ 1;
  int any = 0;
  for (std::size_t k = 0; k < lanes; ++k) any |= off[k];
  for (; i < n; ++i) any |= (id[i] - id[i - 1]) ^ 1;
  return any == 0;
}

// --- the 1989 rule: scale_factor and the loops of contct.hpp, without a branch ---

/// s of each pair. What the plain loop does not compute is computed from numbers that cannot raise a flag.
CONTCT_PART reals listing_s(const reals& d, const reals& d_star, const reals& c, const reals& sign) {
  const reals one = reals{} + 1.0;
  const reals gap = c - d;
  const truths at_rest = d_star == 0.0;
  const truths at_face = size_of(gap) < constants<double>::epsgap;
  const reals q = (at_face ? sign : gap) / (at_rest ? one : d_star);         // eq. 4 and 11
  const reals s = q * (at_face ? reals{} + constants<double>::delta : one);  // eq. 12
  const reals s_if_moved = at_face ? (q > 0.0 ? s : one) : s;
  return at_rest ? one : s_if_moved;
}

template <placing Placed>
CONTCT_PART void listing_step(const pair_arrays& a, std::size_t i, least_of_lanes& least) {
  const reals s = listing_s(at_pairs<Placed>(a.d, a, i), at_pairs<Placed>(a.d_star, a, i),
                            load<reals>(a.c + i), as_reals(a.i_sep, i) * as_reals(a.i_surf, i));
  store(s, a.s + i);
  least.include(s, s > 0.0, i);
}

template <placing Placed>
CONTCT_TARGET inline least_s listing_of(const pair_arrays a) {
  least_of_lanes least[chains];
  for (std::size_t i = 0; i + chains * lanes <= a.n; i += chains * lanes) {
    listing_step<Placed>(a, i, least[0]);
    listing_step<Placed>(a, i + lanes, least[1]);
  }
  return least_of(least, a.n);
}

CONTCT_TARGET inline std::size_t near(const double* s, std::size_t from, std::size_t n, double s_min,
                                      double bound) {
  constexpr std::size_t stretch = 4 * lanes;
  std::size_t i = from;
  for (; i + stretch <= n; i += stretch) {
    truths any{};
    for (std::size_t j = i; j < i + stretch; j += lanes) {
      any |= size_of(load<reals>(s + j) - s_min) <= bound;
    }
    if (is_any(any)) break;
  }
  while (i < n && !(__builtin_fabs(s[i] - s_min) <= bound)) ++i;
  return i;
}

// --- the corrected rule: scale_factor and the loops of corrected.cpp, without a branch ---

template <placing Placed>
CONTCT_TARGET inline double largest_response_of(const pair_arrays a) {
  reals largest[chains]{};
  for (std::size_t i = 0; i + chains * lanes <= a.n; i += chains * lanes) {
    for (std::size_t j = 0; j < chains; ++j) {
      const reals d_star = at_pairs<Placed>(a.d_star, a, i + j * lanes);
      const reals size = size_of(d_star);
      largest[j] = largest[j] < size ? size : largest[j];
    }
  }
  double most = 0.0;
  for (const reals& l : largest)
    for (std::size_t k = 0; k < lanes; ++k) most = most < l[k] ? l[k] : most;
  return most;
}

CONTCT_PART reals corrected_s(const reals& d, const reals& d_star, const reals& c, const reals& sign,
                              const reals& theta) {
  const reals one = reals{} + 1.0;
  const reals sigma_v = sign * d_star;
  const reals sigma_g = sign * (c - d);
  const truths moves = sigma_v > theta;
  const reals s = (sigma_g > 0.0 ? sigma_g : reals{}) / (moves ? sigma_v : one);
  const reals within = s > 1.0 ? one : s;
  return moves ? within : one;
}

template <placing Placed>
CONTCT_PART void corrected_step(const pair_arrays& a, std::size_t i, double quiet, least_of_lanes& least) {
  const reals i_sep = as_reals(a.i_sep, i);
  const reals theta = i_sep == double{separated} ? reals{} + quiet : reals{};
  const reals s = corrected_s(at_pairs<Placed>(a.d, a, i), at_pairs<Placed>(a.d_star, a, i),
                              load<reals>(a.c + i), i_sep * as_reals(a.i_surf, i), theta);
  store(s, a.s + i);
  least.include(s, truths{} + -1, i);
}

template <placing Placed>
CONTCT_TARGET inline least_s corrected_of(const pair_arrays a, double quiet) {
  least_of_lanes least[chains];
  for (std::size_t i = 0; i + chains * lanes <= a.n; i += chains * lanes) {
    corrected_step<Placed>(a, i, quiet, least[0]);
    corrected_step<Placed>(a, i + lanes, quiet, least[1]);
  }
  return least_of(least, a.n);
}

// --- by the placing of the dofs ---

CONTCT_TARGET inline least_s listing(const pair_arrays& a) {
  if (a.placed == placing::side_by_side) return listing_of<placing::side_by_side>(a);
  if (a.placed == placing::evenly) return listing_of<placing::evenly>(a);
  return listing_of<placing::anyhow>(a);
}

CONTCT_TARGET inline double largest_response(const pair_arrays& a) {
  if (a.placed == placing::side_by_side) return largest_response_of<placing::side_by_side>(a);
  if (a.placed == placing::evenly) return largest_response_of<placing::evenly>(a);
  return largest_response_of<placing::anyhow>(a);
}

CONTCT_TARGET inline least_s corrected(const pair_arrays& a, double quiet) {
  if (a.placed == placing::side_by_side) return corrected_of<placing::side_by_side>(a, quiet);
  if (a.placed == placing::evenly) return corrected_of<placing::evenly>(a, quiet);
  return corrected_of<placing::anyhow>(a, quiet);
}
