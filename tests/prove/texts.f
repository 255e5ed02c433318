C     Writes N values of SMIN to LINES as FORMAT 60 of the listing does.
      SUBROUTINE TEXTS (SMIN, N, LINES)
      REAL SMIN(N)
      CHARACTER*11 LINES(N)
      WRITE(LINES,60) SMIN
   60 FORMAT(E11.4)
      END
