/* Declares the functions of fortran/contct_c.f90, by which C and C++ call the 1989 code.
 *
 * COMMON /DOF/ and unit 26 belong to the whole process, so the caller must serialise all calls of these
 * functions. (In C++, contct/kernel/fortran.hpp serialises the calls with a lock.)
 *
 * Deflections, d* and faces are lengths, positive up, in one unit, which the caller chooses. The listing
 * treats a gap below 1e-10 of this unit as zero. */
#ifndef CONTCT_KERNEL_CONTCT_H
#define CONTCT_KERNEL_CONTCT_H

#ifdef __cplusplus
extern "C" {
#endif

/* One call of CONTCT computes the share of the remaining load up to the next event, and the pairs that make
 * or break contact there. The arguments are those of contct_kernel (contct/kernel/plugin.h) without ndof.
 * smin must not be null; other pointers may be null only if nc is 0. The answer is defined, and equal to the
 * answer of C++ CONTCT, if nc < 2^31 - 1 and the computation of isep[i] * isurf[i] and of
 * (id[i] - 1) * ndofpn + indof fits in 32 bits. */

/* The listing as printed, with 4-byte REAL. */
void contct_call_r4(const float* dd, const float* dtest, const float* cc, float* ss, float* smin,
                    const int* id, int* isep, const int* isurf, int nc, int indof, int ndofpn);

/* The listing with 8-byte REAL, also in its literals and DATA. */
void contct_call_r8(const double* dd, const double* dtest, const double* cc, double* ss, double* smin,
                    const int* id, int* isep, const int* isurf, int nc, int indof, int ndofpn);

/* The listing reports events on unit 26. Until contct_log_open is called, the text goes to the null device.
 */

/* Connects unit 26 to the existing file `path`, at its beginning. `path` has `length` characters and needs no
 * final zero. Returns 0, or the error number of the Fortran run-time library. */
int contct_log_open(const char* path, int length);

/* Writes all text of the listing so far to the file. */
void contct_log_flush(void);

/* Moves to the beginning of the file, where the next line is written. */
void contct_log_rewind(void);

/* Disconnects unit 26 from its file. The text goes to the null device again. */
void contct_log_close(void);

#ifdef __cplusplus
}
#endif

#endif
