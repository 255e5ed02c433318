// Explains a call: which branches the listing takes for each pair, and why pairs are toggled.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "contct/harness/branches.hpp"
#include "contct/kernel/call.hpp"

namespace contct {

/// A statement of fortran/contct.f that an explanation cites.
struct listing_line {
  int number;                  ///< from 1
  std::string_view statement;  ///< the text without label and indentation

  friend bool operator==(const listing_line& a, const listing_line& b) { return a.number == b.number; }
};

namespace listing {

/// Not a line, but the mode of arithmetic.
inline constexpr listing_line flushing{
    0, "no line of the listing, but subnormals flushed to zero (FTZ or DAZ; build without -ffast-math)"};
inline constexpr listing_line arguments{19,
                                        "SUBROUTINE CONTCT (DD, DTEST, CC, SS, SMIN, ID, ISEP, ISURF, NC)"};
inline constexpr listing_line common{20, "COMMON /DOF/ INDOF,NDOFPN"};
inline constexpr listing_line smin_is_1{26, "SMIN = 1.0"};
inline constexpr listing_line do_10{27, "DO 10 I = 1, NC"};
inline constexpr listing_line node{28, "NODE = ID(I)"};
inline constexpr listing_line ndof{29, "NDOF = (NODE-1) * NDOFPN + INDOF"};
inline constexpr listing_line gap{30, "GAP = CC(I) - DD(NDOF)"};
inline constexpr listing_line if_no_response{31, "IF (DTEST(NDOF).EQ.0.) THEN"};
inline constexpr listing_line no_response{32, "SS(I) = 1.0"};
inline constexpr listing_line if_stationary{33, "ELSE IF (ABS(GAP).LT.EPSGAP) THEN"};
inline constexpr listing_line stationary{34, "SS(I) = 1.0"};
inline constexpr listing_line check_variable{35, "SSCHK = ISEP(I) * ISURF(I) / DTEST(NDOF)"};
inline constexpr listing_line if_check_positive{36, "IF (SSCHK.GT.0.) SS(I) = SSCHK * DELTA"};
inline constexpr listing_line moving{38, "SS(I) = GAP / DTEST(NDOF)"};
inline constexpr listing_line smallest{40, "IF (SS(I).GT.0. .AND. SS(I).LT.SMIN) SMIN=SS(I)"};
inline constexpr listing_line if_no_events{42, "IF (SMIN.EQ.1.) THEN"};
inline constexpr listing_line write_20{43, "WRITE(26,20) SMIN"};
inline constexpr listing_line format_20{44, "FORMAT(2X, 'NO EVENTS. RETURNING. SCALE FACTOR = ', E10.3)"};
inline constexpr listing_line no_events_return{45, "RETURN"};
inline constexpr listing_line do_30{50, "DO 30 I = 1, NC"};
inline constexpr listing_line diff{51, "DIFF = ABS(SS(I) - SMIN) / SMIN"};
inline constexpr listing_line if_within{52, "IF (DIFF.LT.EPSMUL) THEN"};
inline constexpr listing_line node_again{53, "NODE = ID(I)"};
inline constexpr listing_line if_separated{54, "IF (ISEP(I).EQ.1) THEN"};
inline constexpr listing_line make{55, "ISEP(I) = -1"};
inline constexpr listing_line write_40{56, "WRITE(26,40)"};
inline constexpr listing_line break_{58, "ISEP(I) = 1"};
inline constexpr listing_line write_50{59, "WRITE(26,50)"};
inline constexpr listing_line write_60{61, "WRITE(26,60) I, NODE, ISURF(I), SMIN"};
inline constexpr listing_line format_40{64, "FORMAT(2X, '******* MAKING CONTACT ********')"};
inline constexpr listing_line format_50{65, "FORMAT(2X, '****** BREAKING CONTACT *******')"};
inline constexpr listing_line format_60{66, "FORMAT(3X, 'CONTACT PAIR: ',I3,' NODE: ',I3,"};

}  // namespace listing

/// Why a pair was toggled.
enum class why_toggled {
  not_toggled,
  winner,       ///< SMIN is this pair's s
  same_moment,  ///< like the winner, the pair is at its face at SMIN, up to rounding
  too_early,    ///< s is within EPSMUL of SMIN, but at SMIN the pair is not yet at its face
  by_mark,      ///< the pair has no event; its s = 1, the mark for "no event", is within EPSMUL of SMIN
};

/// One pair in one call. Numbers of a 4-byte call are converted to double.
struct explained_pair {
  int pair = 0;  ///< from 0
  int node = 0;  ///< from 1
  int surface = face_below;
  int isep_before = separated;
  int isep_after = separated;
  double c = 0.0, d = 0.0, d_star = 0.0;
  double gap = 0.0;    ///< GAP, c - D; eq. 5 multiplies this by the side n
  double s_chk = 0.0;  ///< SSCHK, if it was computed
  double s = 0.0;
  listing_line set_s = listing::no_response;  ///< the line that set s: 32, 34, 36 or 38
  double smin_before = 1.0;                   ///< the SMIN with which s was compared, if s is positive
  double diff = 0.0;                          ///< DIFF, if the call has an event
  why_toggled why = why_toggled::not_toggled;
  double distance = 0.0;  ///< distance from the face at SMIN: |c - (D + SMIN d*)|
  std::array<std::optional<decision>, branch_names.size()> taken;  ///< nothing for an IF that was not reached

  [[nodiscard]] bool reached(branch b) const { return taken[index_of(b)].has_value(); }
  [[nodiscard]] bool is_true(branch b) const { return reached(b) && taken[index_of(b)]->outcome; }
  [[nodiscard]] bool toggled() const { return isep_before != isep_after; }
  [[nodiscard]] bool took_the_lead() const { return is_true(branch::s_is_smallest); }
  /// True if s is the positive scale factor of an event under the 1989 rule, not the mark for "no event".
  [[nodiscard]] bool is_candidate() const {
    return (set_s == listing::moving || set_s == listing::if_check_positive) && s > 0.0;
  }
};

struct explained_call {
  int real_bytes = 8;
  double smin = 1.0;
  std::vector<explained_pair> pairs;
  int winner = -1;                    ///< the pair (from 0) whose s is SMIN; -1: no event
  int next = -1;                      ///< the candidate with the next smallest s; -1: no other candidate
  std::uint64_t ulps_ahead = 0;       ///< distance of the s of `winner` and of `next`
  std::optional<decision> narrowest;  ///< the decision of the call with the smallest margin
};

/// The largest distance from a face that rounding can explain, as a share of the largest deflection.
[[nodiscard]] constexpr double rounding_share(int real_bytes) {
  return real_bytes == 4 ? 1e-5 : 1e-11;
}

/// Explains a call in REAL of `real_bytes`. `largest` is the largest deflection of the path so far; this
/// call's deflections update it. This function follows the listing's text and uses no code of a kernel.
[[nodiscard]] explained_call explain(const answered_call& c, int real_bytes, double& largest);

}  // namespace contct
