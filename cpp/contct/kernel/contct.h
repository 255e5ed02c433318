/* The 1989 code, for C and C++: fortran/contct_c.f90 seen from outside.
 *
 * COMMON /DOF/ and unit 26 belong to the whole process, so calls of anything declared here must be
 * serialised by the caller. (In C++, contct/kernel/fortran.hpp does it with a lock.)
 *
 * Deflections, d* and faces are lengths in one unit, positive up. Which unit is the caller's choice, but the
 * listing takes a gap below 1e-10 of it for closed. */
#ifndef CONTCT_KERNEL_CONTCT_H
#define CONTCT_KERNEL_CONTCT_H

#ifdef __cplusplus
extern "C" {
#endif

/* One call of CONTCT: how much of the remaining load can be applied before a pair makes or breaks contact,
 * and which pairs do so there. The arguments stand in the listing's order, then COMMON /DOF/; n is the number
 * of dofs of the structure.
 *
 *   dd      in   [n]   D, the deflections so far
 *   dtest   in   [n]   d*, what the whole remaining load would add to them
 *   cc      in   [nc]  c, the position of each pair's face
 *   ss      out  [nc]  s, each pair's scale factor, a share of the remaining load (pure number)
 *   smin    out        the least positive s below 1; 1 when there is none: the whole load can be applied
 *   id      in   [nc]  each pair's node, from 1
 *   isep    both [nc]  +1 separated, -1 in contact; the pairs with an event at smin come back toggled
 *   isurf   in   [nc]  the side on which a pair's face stands: +1 above, -1 below
 *   nc      in         number of pairs
 *   indof   in         which dof of a node deflects, from 1
 *   ndofpn  in         dofs of a node
 *
 * Pair i looks at element (id[i] - 1) * ndofpn + indof - 1 of dd and dtest. Nothing checks that it is
 * there. No argument may be null unless nc is 0 (smin never), and none may overlap another. Answers are
 * defined, and equal to those of C++, where nc < 2^31 - 1 and neither isep[i] * isurf[i] nor
 * (id[i] - 1) * ndofpn + indof leaves 32 bits on the way.
 */

/* As printed: REAL is 4 bytes. */
void contct_call_r4(const float* dd, const float* dtest, const float* cc, float* ss, float* smin,
                    const int* id, int* isep, const int* isurf, int nc, int indof, int ndofpn);

/* REAL, its literals and its DATA are 8 bytes. */
void contct_call_r8(const double* dd, const double* dtest, const double* cc, double* ss, double* smin,
                    const int* id, int* isep, const int* isurf, int nc, int indof, int ndofpn);

/* The listing says on unit 26 what happened. The text goes to the null device until contct_log_open. */

/* Connect unit 26 to the existing file `path`, a name of `length` characters without a final zero, from the
 * file's beginning. Returns 0, or the error number of the Fortran run-time library. */
int contct_log_open(const char* path, int length);

/* What the listing has written so far stands in the file when this returns. */
void contct_log_flush(void);

/* The next line is written at the beginning of the file. */
void contct_log_rewind(void);

/* Take unit 26 away from its file; it leads to the null device again. */
void contct_log_close(void);

#ifdef __cplusplus
}
#endif

#endif
