C     The texts of n values of SMIN, as FORMAT 60 of the listing writes them.
      SUBROUTINE TEXTS (SMIN, N, LINES)
      REAL SMIN(N)
      CHARACTER*11 LINES(N)
      WRITE(LINES,60) SMIN
   60 FORMAT(E11.4)
      END
