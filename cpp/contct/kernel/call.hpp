// One call of CONTCT: the listing's arguments as data.
#pragma once

#include <span>

#include "contct/rooms.hpp"

namespace contct::kernels {

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

/// ISURF: the side of the structure on which a pair's face stands.
inline constexpr int face_above = 1;
inline constexpr int face_below = -1;

/// What can happen to a pair: making contact (advancing) or breaking it (receding).
enum class change { make, break_ };

/// A contact event, as data.
struct event {
  int pair;     ///< from 0
  change what;  ///< make: ISEP became -1; break_: ISEP became +1

  friend bool operator==(const event&, const event&) = default;
};

/// Which branch of the listing's DO 10 loop gave a pair its s.
enum class way_to_s {
  no_response,       ///< d* = 0: s is 1, the mark for "no event"
  stationary,        ///< at its face, and the load keeps it as it is: s is 1, the same mark
  stationary_event,  ///< at its face, and the load changes it: eq. 12
  moving,            ///< advancing or receding: eq. 4
};

/// The arguments of CONTCT in the listing's order, and COMMON /DOF/.
/// `nc` is cc.size(); every array over pairs has that length. Every id[i] must address a dof
/// inside dd and dtest, nc must be below 2^31 - 1, and neither (id[i] - 1) * ndofpn + indof nor isep[i] *
/// isurf[i] may leave 32 bits; the listing does not check, and neither do the kernels. limits.hpp refuses
/// what is beyond that.
template <class Real>
struct call {
  std::span<const Real> dd;     ///< DD: D, accumulated deflection [system dofs]
  std::span<const Real> dtest;  ///< DTEST: d*, response to the whole residual load [system dofs]
  std::span<const Real> cc;     ///< CC: c, position of each face [nc]
  std::span<Real> ss;           ///< SS: out: s, scale factor of each pair [nc]
  Real smin;                    ///< SMIN: out: the smallest s; 1 means no event
  std::span<const int> id;      ///< ID: node of each pair, from 1 [nc]
  std::span<int> isep;          ///< ISEP: in and out: +1 separated, -1 in contact [nc]
  std::span<const int> isurf;   ///< ISURF: +1 face above, -1 face below [nc]
  dof_layout dof;               ///< COMMON /DOF/

  [[nodiscard]] int nc() const { return static_cast<int>(cc.size()); }
};

}  // namespace contct::kernels
