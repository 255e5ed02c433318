// Statements of fortran/contct.f that an explanation cites, by their line.
#pragma once

#include <array>
#include <string_view>

namespace contct {

/// A statement of the listing, and where it stands. tests/conform/listing_lines_test.cpp looks it up.
struct listing_line {
  int number;                  ///< from 1
  std::string_view statement;  ///< without label and indentation
};

namespace listing {

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
inline constexpr listing_line no_events_return{45, "RETURN"};
inline constexpr listing_line diff{51, "DIFF = ABS(SS(I) - SMIN) / SMIN"};
inline constexpr listing_line if_within{52, "IF (DIFF.LT.EPSMUL) THEN"};
inline constexpr listing_line if_separated{54, "IF (ISEP(I).EQ.1) THEN"};
inline constexpr listing_line make{55, "ISEP(I) = -1"};
inline constexpr listing_line break_{58, "ISEP(I) = 1"};

inline constexpr std::array all = {gap,       if_no_response, no_response,  if_stationary,     stationary,
                                   moving,    check_variable, smallest,     if_check_positive, diff,
                                   if_within, if_separated,   if_no_events, no_events_return,  make,
                                   break_};

/// The statement at a line that is cited; nothing at any other.
[[nodiscard]] constexpr std::string_view statement_at(int number) {
  for (const listing_line& l : all)
    if (l.number == number) return l.statement;
  return {};
}

}  // namespace listing
}  // namespace contct
