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
 * and which pairs do so there. The arguments are those of contct_kernel (contct/kernel/plugin.h), but for the
 * length of dd and dtest. No argument may be null unless nc is 0 (smin never). Answers are defined, and equal
 * to those of C++, where nc < 2^31 - 1 and neither isep[i] * isurf[i] nor (id[i] - 1) * ndofpn + indof leaves
 * 32 bits on the way. */

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
