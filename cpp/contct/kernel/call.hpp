// One call of CONTCT: its arguments as views or as owned arrays, and its answer.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace contct {

/// COMMON /DOF/ of the listing.
struct dof_layout {
  int indof = 1;   ///< INDOF: which dof of a node deflects, from 1
  int ndofpn = 1;  ///< NDOFPN: dofs per node

  /// NDOF of the listing: the dof, from 1, of the pair at `node` (from 1).
  [[nodiscard]] constexpr int dof_of(int node) const { return (node - 1) * ndofpn + indof; }
};

/// ISEP: the status of a pair.
inline constexpr int separated = 1;
inline constexpr int in_contact = -1;

/// ISURF: the side of the structure on which a pair's face is.
inline constexpr int face_above = 1;
inline constexpr int face_below = -1;

/// A change of a pair's status: the pair makes contact (advancing) or breaks contact (receding).
enum class change { make, break_ };

struct event {
  int pair;     ///< from 0
  change what;  ///< make: ISEP became -1; break_: ISEP became +1

  friend bool operator==(const event&, const event&) = default;
};

/// The arguments of CONTCT in the listing's order, and COMMON /DOF/.
/// `nc` = cc.size() is the length of every array over pairs, and must be below 2^31 - 1. Every id[i] must
/// address a dof inside dd and dtest. The values of (id[i] - 1) * ndofpn + indof and of isep[i] * isurf[i]
/// must fit in 32 bits. refuse_beyond_limits checks these limits; the listing and the kernels do not.
template <class Real>
struct call {
  std::span<const Real> dd;     ///< DD: D, accumulated deflection [system dofs]
  std::span<const Real> dtest;  ///< DTEST: d*, response to the whole residual load [system dofs]
  std::span<const Real> cc;     ///< CC: c, position of each face [nc]
  std::span<Real> ss;           ///< SS: out: s, scale factor of each pair [nc]
  Real smin;                    ///< SMIN: out: s of the next event, or 1 without an event
  std::span<const int> id;      ///< ID: node of each pair, from 1 [nc]
  std::span<int> isep;          ///< ISEP: in and out: +1 separated, -1 in contact [nc]
  std::span<const int> isurf;   ///< ISURF: +1 face above, -1 face below [nc]
  dof_layout dof;               ///< COMMON /DOF/

  [[nodiscard]] int nc() const { return static_cast<int>(cc.size()); }
};

/// A call and its answer, for comparisons, traces and the observers of a path.
struct answered_call {
  call<double> c;                             ///< inputs and outputs; c.isep is ISEP after the call
  std::span<const int> isep_before;           ///< ISEP before the call [pairs]
  std::optional<std::string_view> text = {};  ///< unit-26 text; nothing if the kernel writes no text
  std::int64_t number = 0;                    ///< number of the call in the path or trace, from 1
};

/// The inputs of one call in owned arrays. dd and dtest may have dofs without a pair.
struct call_inputs {
  std::vector<double> dd, dtest;     ///< [dofs]
  std::vector<double> cc;            ///< [pairs]
  std::vector<int> id, isep, isurf;  ///< [pairs]
  dof_layout dof;

  [[nodiscard]] std::size_t pairs() const { return cc.size(); }
  /// The index in dd and dtest of the dof of pair `i` (from 0).
  [[nodiscard]] std::size_t dof_of_pair(std::size_t i) const { return dof.dof_of(id[i]) - 1; }
};

/// The value of SMIN and SS before a call, which every kernel must overwrite.
inline constexpr double not_an_answer = -7.0;

/// The outputs of one call in owned arrays.
struct call_outputs {
  double smin = 0.0;
  std::vector<double> ss;  ///< [pairs]
  std::vector<int> isep;   ///< [pairs]
  std::string text;        ///< unit-26 text; empty if the kernel has none

  /// Returns a call that reads `in` and writes to `ss` and `isep`. Before the call, SMIN and SS are
  /// not_an_answer, and ISEP is in.isep.
  call<double> prepare(const call_inputs& in) {
    ss.assign(in.pairs(), not_an_answer);
    isep = in.isep;
    return {in.dd, in.dtest, in.cc, ss, not_an_answer, in.id, isep, in.isurf, in.dof};
  }

  /// The same for a call that was answered by another kernel.
  call<double> prepare(const answered_call& other) {
    ss.assign(other.c.ss.size(), not_an_answer);
    isep.assign(other.isep_before.begin(), other.isep_before.end());
    call<double> c = other.c;
    c.ss = ss;
    c.isep = isep;
    c.smin = not_an_answer;
    return c;
  }

  /// Returns the call with the inputs `in` and these outputs. It has no text if `text` is empty, because a
  /// kernel that writes to unit 26 does so in every call.
  [[nodiscard]] answered_call answering(const call_inputs& in, std::int64_t number) {
    return {{in.dd, in.dtest, in.cc, ss, smin, in.id, isep, in.isurf, in.dof},
            in.isep,
            text.empty() ? std::nullopt : std::optional<std::string_view>(text),
            number};
  }
};

/// One call in owned arrays.
struct recorded_call {
  std::int64_t number = 0;
  std::string note;  ///< the purpose of the call; may be empty
  call_inputs in;
  call_outputs out;

  [[nodiscard]] answered_call answered() { return out.answering(in, number); }
};

/// Returns then(call), with the call in REAL of `real_bytes`: `c`, or a copy whose arrays and SMIN are
/// rounded to float. ID, ISEP and ISURF of the copy are those of `c`, so that `then` changes c.isep, but not
/// c.ss or c.smin.
template <class Call, class Then>
auto in_precision(Call& c, int real_bytes, Then then) {
  if (real_bytes == 8) return then(c);
  const auto rounded = [](std::span<const double> x) { return std::vector<float>(x.begin(), x.end()); };
  const std::vector<float> dd = rounded(c.dd);
  const std::vector<float> dtest = rounded(c.dtest);
  const std::vector<float> cc = rounded(c.cc);
  std::vector<float> ss = rounded(c.ss);
  call<float> narrow{dd, dtest, cc, ss, static_cast<float>(c.smin), c.id, c.isep, c.isurf, c.dof};
  return then(narrow);
}

/// Throws std::invalid_argument if a dof of `c` is outside DD or DTEST, or if NC, a product ISEP * ISURF or
/// the computation of a dof exceeds 32 bits, because an overflow is undefined in FORTRAN and in C++. `isep`
/// is ISEP before the call.
void refuse_beyond_limits(const call<double>& c, std::span<const int> isep);

}  // namespace contct
