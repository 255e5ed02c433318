/* A kernel of your own: a shared library that exports the two functions declared here, in any language with a
 * C ABI. `contct fuzz --kernels fortran,plugin:./mine.so` says whether it is CONTCT.
 *
 * Include this header where you define them: the compiler then checks their types, and they are exported even
 * under -fvisibility=hidden. */
#ifndef CONTCT_KERNEL_PLUGIN_H
#define CONTCT_KERNEL_PLUGIN_H

/* What contct_kernel_abi returns. It changes when anything below does. */
#define CONTCT_KERNEL_ABI 1

#if defined(__GNUC__)
#define CONTCT_KERNEL_EXPORT __attribute__((visibility("default")))
#else
#define CONTCT_KERNEL_EXPORT
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Which ABI the library was written to: return CONTCT_KERNEL_ABI. */
CONTCT_KERNEL_EXPORT int contct_kernel_abi(void);

/* Answer one call of CONTCT. The arguments stand in the listing's order, then the two members of COMMON /DOF/
 * and the length of dd and dtest. Arrays are the caller's, do not overlap, and are good for this call only.
 *
 *   dd      in   [ndof]  D, the deflections so far: lengths, positive up
 *   dtest   in   [ndof]  d*, what the whole remaining load would add to them: lengths
 *   cc      in   [nc]    c, the position of each pair's face: lengths, positive up
 *   ss      out  [nc]    s, each pair's scale factor, a share of the remaining load; write every one. What it
 *                        holds on entry means nothing
 *   smin    out          the least positive s below 1; 1 when there is none. On entry it means nothing
 *   id      in   [nc]    each pair's node, from 1
 *   isep    both [nc]    +1 separated, -1 in contact; toggle the pairs that have an event
 *   isurf   in   [nc]    the side on which a pair's face stands: +1 above, -1 below; the product of
 *                        isep[i] and isurf[i] fits 32 bits
 *   nc      in           number of pairs, 0 to 10000000
 *   indof   in           INDOF: which dof of a node deflects, from 1 to ndofpn
 *   ndofpn  in           NDOFPN: dofs of a node
 *   ndof    in           length of dd and dtest; the element of pair i,
 *                        (id[i] - 1) * ndofpn + indof - 1, is below it; others may belong to no pair
 *
 * Values may be infinite, NaN, subnormal or -0.0, and are compared with the listing's to the bit (NaN equals
 * NaN), so compile without contraction and without fast-math: -ffp-contract=off.
 *
 * The answer must be a function of this call's arguments alone: nothing may be carried from one call to the
 * next, and the same arguments must give the same bits, whatever was asked before. The function may be called
 * in a child process, which may end at any moment: keep no threads, no locks and no open files. It must
 * return; no exception may leave it. */
CONTCT_KERNEL_EXPORT void contct_kernel(const double dd[], const double dtest[], const double cc[],
                                        double ss[], double* smin, const int id[], int isep[],
                                        const int isurf[], int nc, int indof, int ndofpn, int ndof);

#ifdef __cplusplus
}
#endif

#endif
