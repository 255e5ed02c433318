C     PB1MAIN.  A MAIN PROGRAM FOR CONTCT, IN THE MANNER OF ITS DAY.
C
C     A CANTILEVER OF TWO HERMITE ELEMENTS OVER A TIP STOP: THE PROBLEM
C     OF REFERENCE/PROBLEMS/PB01-CANTILEVER-TIP-STOP.TOML.  THE ROUTINE
C     IT CALLS IS THE LISTING, FORTRAN/CONTCT.F, AS IT STANDS.
C
C     REAL IS WHAT THE COMPILER MAKES OF IT: 4 BYTES AS PRINTED, 8 WITH
C     -FDEFAULT-REAL-8.  DEFLECTIONS AND FORCES ARE POSITIVE UP.
C
C     NAMES AS IN THE PAPER:
C       D     DEFLECTION SO FAR, W AND THETA OF EACH NODE
C       W     TEST RESPONSE, WHAT ALL OF THE LOAD LEFT WOULD ADD
C       R     RESIDUAL LOAD, WHAT IS LEFT OF THE STEP
C       C     FACE OF EACH PAIR      SK    STIFFNESS OF EACH PAIR
C       SS    SCALE FACTORS          SMIN  THE SMALLEST OF THEM
C       ISEP  +1 SEPARATED, -1 IN CONTACT
C       ISURF +1 FACE ABOVE, -1 FACE BELOW
C
      PROGRAM PB1
      PARAMETER (ND=6, NC=1, NSTEP=4, MAXINC=20)
      COMMON /DOF/ INDOF, NDOFPN
      COMMON /BEAM/ X(3), EI
      COMMON /BAND/ A(6,4)
      DIMENSION D(ND), W(ND), R(ND), C(NC), SK(NC), SS(NC)
      DIMENSION ID(NC), ISEP(NC), ISURF(NC), IOLD(NC)
      DIMENSION P(NSTEP)
      DATA C/-.004/, SK/5.E4/, ID/3/, ISEP/1/, ISURF/-1/
      DATA P/-10., -60., -30., 20./
C
C     TWO DOFS A NODE, AND THE FIRST OF THEM DEFLECTS
C
      INDOF = 1
      NDOFPN = 2
      X(1) = 0.
      X(2) = 1.
      X(3) = 2.
      EI = 1.E4
C
C     CONTCT WRITES ON UNIT 26.  KEEP IT, AND LIST IT AT THE END
C
      OPEN (UNIT=26, STATUS='SCRATCH', FORM='FORMATTED')
      WRITE (6,100)
      PLAST = 0.
      DO 10 I = 1, ND
        D(I) = 0.
   10 CONTINUE
C
C     ONE LOAD STEP AFTER THE OTHER.  THE RESIDUAL LOAD IS WHAT THE
C     STEP ADDS, FOR THE BEAM IS IN EQUILIBRIUM WHERE THE LAST ONE LEFT
C     IT
C
      DO 90 ISTEP = 1, NSTEP
        WRITE (6,110) ISTEP, P(ISTEP)
        DO 20 I = 1, ND
          R(I) = 0.
   20   CONTINUE
        R(5) = P(ISTEP) - PLAST
C
        DO 60 INC = 1, MAXINC
          CALL ASSEM (SK, ID, ISEP, NC)
          CALL FACTOR (ND)
          DO 30 I = 1, ND
            W(I) = R(I)
   30     CONTINUE
          CALL SOLVE (W, ND)
C
C     D AND R BEFORE THE CALL, AND THE STATUSES, WHICH CONTCT CHANGES
C
          DB = D(5)
          RB = R(5)
          DO 35 I = 1, NC
            IOLD(I) = ISEP(I)
   35     CONTINUE
          CALL CONTCT (D, W, C, SS, SMIN, ID, ISEP, ISURF, NC)
          DO 40 I = 1, ND
            D(I) = D(I) + SMIN * W(I)
            R(I) = (1. - SMIN) * R(I)
   40     CONTINUE
          WRITE (6,120) INC, RB, DB, C(1) - DB, W(5), SMIN, D(5), R(5)
          IF (SMIN.EQ.1.) GO TO 70
          DO 50 I = 1, NC
            IF (ISEP(I).LT.IOLD(I)) WRITE (6,130) I, ID(I)
            IF (ISEP(I).GT.IOLD(I)) WRITE (6,140) I, ID(I)
   50     CONTINUE
   60   CONTINUE
        WRITE (6,150) MAXINC
        STOP
C
C     THE STEP IS DONE: THE DEFLECTIONS, AND THE FORCE OF A PAIR, WHICH
C     IS NONE AT ITS FACE, WHERE ITS SPRING JOINED
C
   70   PLAST = P(ISTEP)
        DO 80 I = 1, NC
          FORCE = 0.
          IF (ISEP(I).EQ.-1) FORCE = -ISURF(I) * SK(I)
     &                                 * (C(I) - D(2*ID(I)-1))
          WRITE (6,160) D(3), D(5), I, FORCE
   80   CONTINUE
   90 CONTINUE
      CALL LIST26
      STOP
C
  100 FORMAT (1X, 'PB1  CANTILEVER WITH A TIP STOP')
  110 FORMAT (/ 1X, 'STEP', I3, 5X, 'TIP LOAD TO BE REACHED', F8.2)
  120 FORMAT (/ 3X, 'INCREMENT', I3, 7X, 'LOAD LEFT  R', E21.12
     &        / 22X, 'D BEFORE    ', E21.12
     &        / 22X, 'GAP    C - D', E21.12
     &        / 22X, 'TEST      D*', E21.12
     &        / 22X, 'SMIN        ', E21.12
     &        / 22X, 'D AFTER     ', E21.12
     &        / 22X, 'LOAD LEFT  R', E21.12)
  130 FORMAT (3X, 'PAIR', I3, ' AT NODE', I3, ' MAKES CONTACT')
  140 FORMAT (3X, 'PAIR', I3, ' AT NODE', I3, ' BREAKS CONTACT')
  150 FORMAT (1X, 'NO END AFTER', I4, ' INCREMENTS')
  160 FORMAT (/ 3X, 'END OF STEP', 8X, 'W AT NODE 2 ', E21.12
     &        / 22X, 'W AT NODE 3 ', E21.12
     &        / 22X, 'FORCE ', I3, '   ', E21.12)
      END
C
C     THE STIFFNESS OF THE BEAM AND OF THE SPRINGS NOW IN CONTACT, LOWER
C     BAND: A(I,J) IS ROW I, COLUMN I-4+J, THE DIAGONAL IS A(I,4)
C
      SUBROUTINE ASSEM (SK, ID, ISEP, NC)
      COMMON /DOF/ INDOF, NDOFPN
      COMMON /BEAM/ X(3), EI
      COMMON /BAND/ A(6,4)
      DIMENSION SK(*), ID(*), ISEP(*), E(4,4)
      DO 10 I = 1, 6
        DO 10 J = 1, 4
          A(I,J) = 0.
   10 CONTINUE
      DO 30 N = 1, 2
        CALL HERMIT (EI, X(N+1) - X(N), E)
        DO 20 I = 1, 4
          DO 20 J = 1, I
            IROW = 2*N - 2 + I
            A(IROW,4+J-I) = A(IROW,4+J-I) + E(I,J)
   20   CONTINUE
   30 CONTINUE
C
C     THE SPRING OF A PAIR, ON THE DIAGONAL, WHILE IT IS IN CONTACT
C
      DO 40 I = 1, NC
        NDOF = (ID(I)-1) * NDOFPN + INDOF
        IF (ISEP(I).EQ.-1) A(NDOF,4) = A(NDOF,4) + SK(I)
   40 CONTINUE
C
C     NODE 1 IS CLAMPED: ITS TWO ROWS AND COLUMNS ARE STRUCK OUT
C
      DO 60 K = 1, 2
        DO 50 I = 1, 6
          J = K - I + 4
          IF (J.GE.1 .AND. J.LE.4) A(I,J) = 0.
   50   CONTINUE
        DO 55 J = 1, 3
          A(K,J) = 0.
   55   CONTINUE
        A(K,4) = 1.
   60 CONTINUE
      RETURN
      END
C
C     A HERMITE ELEMENT: W, THETA LEFT; W, THETA RIGHT
C
      SUBROUTINE HERMIT (EI, H, E)
      DIMENSION E(4,4)
      F = EI / (H*H*H)
      E(1,1) = 12. * F
      E(2,1) = 6. * F * H
      E(2,2) = 4. * F * H * H
      E(3,1) = -12. * F
      E(3,2) = -6. * F * H
      E(3,3) = 12. * F
      E(4,1) = 6. * F * H
      E(4,2) = 2. * F * H * H
      E(4,3) = -6. * F * H
      E(4,4) = 4. * F * H * H
      RETURN
      END
C
C     CHOLESKY, IN PLACE: A = L * L TRANSPOSED
C
      SUBROUTINE FACTOR (ND)
      COMMON /BAND/ A(6,4)
      DO 30 I = 1, ND
        DO 20 J = MAX0(1,I-3), I
          SUM = A(I,4+J-I)
          DO 10 K = MAX0(1,I-3), J-1
            SUM = SUM - A(I,4+K-I) * A(J,4+K-J)
   10     CONTINUE
          IF (J.LT.I) A(I,4+J-I) = SUM / A(J,4)
          IF (J.EQ.I) A(I,4) = SQRT(SUM)
   20   CONTINUE
   30 CONTINUE
      RETURN
      END
C
C     FORWARD AND BACK, B IN AND OUT
C
      SUBROUTINE SOLVE (B, ND)
      COMMON /BAND/ A(6,4)
      DIMENSION B(*)
      DO 20 I = 1, ND
        DO 10 K = MAX0(1,I-3), I-1
          B(I) = B(I) - A(I,4+K-I) * B(K)
   10   CONTINUE
        B(I) = B(I) / A(I,4)
   20 CONTINUE
      DO 40 I = ND, 1, -1
        DO 30 K = I+1, MIN0(ND,I+3)
          B(I) = B(I) - A(K,4+I-K) * B(K)
   30   CONTINUE
        B(I) = B(I) / A(I,4)
   40 CONTINUE
      RETURN
      END
C
C     WHAT CONTCT WROTE
C
      SUBROUTINE LIST26
      CHARACTER*80 LINE
      WRITE (6,20)
      REWIND 26
   10 READ (26,30,END=40) LINE
      LENGTH = 80
   15 IF (LINE(LENGTH:LENGTH).NE.' ' .OR. LENGTH.EQ.1) GO TO 18
      LENGTH = LENGTH - 1
      GO TO 15
   18 WRITE (6,30) LINE(1:LENGTH)
      GO TO 10
   20 FORMAT (/ 1X, 'UNIT 26')
   30 FORMAT (A)
   40 RETURN
      END
