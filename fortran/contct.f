C     CONTCT, the 1989 subroutine, as printed in the appendix of
C     N. J. Salamon, Computers & Structures 33(2), 509-512 (1989).
C     The statements are his, with the errata of reference/ERRATA.md
C     applied and nothing else changed; the comments are not.
C     A checksum guards this file: see reference/contct.f.sha256.
C
C     DD     in   D, deflection so far          (system dofs)
C     DTEST  in   d*, what the load left adds   (system dofs)
C     CC     in   c, position of each face      (NC)
C     SS     out  s, scale factor of each pair  (NC)
C     SMIN   out  the smallest s; 1 = no event
C     ID     in   node of each pair, from 1     (NC)
C     ISEP   both +1 separated, -1 in contact   (NC)
C     ISURF  in   +1 face above, -1 face below  (NC)
C     NC     in   number of contact pairs
C     /DOF/  in   INDOF, the dof of a node that deflects, from 1;
C                 NDOFPN, dofs per node
C
      SUBROUTINE CONTCT (DD, DTEST, CC, SS, SMIN, ID, ISEP, ISURF, NC)
      COMMON /DOF/ INDOF,NDOFPN
      DIMENSION DD(*), DTEST(*), CC(*), SS(*), ID(*), ISEP(*), ISURF(*)
      DATA DELTA/1.E-20/, EPSGAP/1.E-10/, EPSMUL/.390625E-02/
C
C     the scale factor of every pair, and the smallest
C
      SMIN = 1.0
      DO 10 I = 1, NC
        NODE = ID(I)
        NDOF = (NODE-1) * NDOFPN + INDOF
        GAP = CC(I) - DD(NDOF)
        IF (DTEST(NDOF).EQ.0.) THEN
          SS(I) = 1.0
        ELSE IF (ABS(GAP).LT.EPSGAP) THEN
          SS(I) = 1.0
          SSCHK = ISEP(I) * ISURF(I) / DTEST(NDOF)
          IF (SSCHK.GT.0.) SS(I) = SSCHK * DELTA
        ELSE
          SS(I) = GAP / DTEST(NDOF)
        ENDIF
        IF (SS(I).GT.0. .AND. SS(I).LT.SMIN) SMIN=SS(I)
   10 CONTINUE
      IF (SMIN.EQ.1.) THEN
        WRITE(26,20) SMIN
   20   FORMAT(2X, 'NO EVENTS. RETURNING. SCALE FACTOR = ', E10.3)
        RETURN
      END IF
C
C     toggle the winner, and whatever comes within EPSMUL of it
C
      DO 30 I = 1, NC
        DIFF = ABS(SS(I) - SMIN) / SMIN
        IF (DIFF.LT.EPSMUL) THEN
          NODE = ID(I)
          IF (ISEP(I).EQ.1) THEN
            ISEP(I) = -1
            WRITE(26,40)
          ELSE
            ISEP(I) = 1
            WRITE(26,50)
          END IF
          WRITE(26,60) I, NODE, ISURF(I), SMIN
        END IF
   30 CONTINUE
   40 FORMAT(2X, '******* MAKING CONTACT ********')
   50 FORMAT(2X, '****** BREAKING CONTACT *******')
   60 FORMAT(3X, 'CONTACT PAIR: ',I3,' NODE: ',I3,
     &       ' SURFACE: ',I3, ' SCALE FACTOR = ',E11.4)
      RETURN
      END
