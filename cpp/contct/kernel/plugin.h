/* A kernel of your own is a shared library, in any language with a C ABI, that exports the two functions
 * declared here. `contct fuzz --kernels fortran,plugin:./mine.so` compares it with the 1989 code.
 *
 * Include this header in the source that defines these functions: the compiler then checks their types, and
 * exports them even with -fvisibility=hidden. */
#ifndef CONTCT_KERNEL_PLUGIN_H
#define CONTCT_KERNEL_PLUGIN_H

/* The version of this interface. */
#define CONTCT_KERNEL_ABI 1

#if defined(__GNUC__)
#define CONTCT_KERNEL_EXPORT __attribute__((visibility("default")))
#else
#define CONTCT_KERNEL_EXPORT
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Must return CONTCT_KERNEL_ABI. */
CONTCT_KERNEL_EXPORT int contct_kernel_abi(void);

/* Answers one call of CONTCT. The arguments are in the listing's order; then follow the two members of COMMON
 * /DOF/ and the length of dd and dtest. Arrays do not overlap, and are valid only during the call.
 *
 *   dd      in   [ndof]  D, the deflections so far: lengths, positive up
 *   dtest   in   [ndof]  d*, the response of the deflections to the whole remaining load: lengths
 *   cc      in   [nc]    c, the position of each pair's face: lengths, positive up
 *   ss      out  [nc]    s, each pair's scale factor, a share of the remaining load; all must be written
 *   smin    out          the least positive s below 1, or 1 if no s is positive and below 1
 *   id      in   [nc]    each pair's node, from 1
 *   isep    both [nc]    +1 separated, -1 in contact; the kernel toggles the pairs that have an event
 *   isurf   in   [nc]    the side of each pair's face: +1 above, -1 below the structure; the product of
 *                        isep[i] and isurf[i] fits in 32 bits
 *   nc      in           number of pairs, 0 to 10000000
 *   indof   in           INDOF: the dof of a node that deflects, from 1 to ndofpn
 *   ndofpn  in           NDOFPN: number of dofs per node
 *   ndof    in           length of dd and dtest; pair i has the index (id[i] - 1) * ndofpn + indof - 1,
 *                        which is below ndof; other elements may belong to no pair
 *
 * Values may be infinite, NaN, subnormal or -0.0. Answers are compared with the listing's to the bit (NaN
 * equals NaN), so compile with -ffp-contract=off and without -ffast-math.
 *
 * The answer may depend only on the arguments of the call, and not on earlier calls. The function may run in
 * a child process, which can end at any time: keep no threads, locks or open files. The function must return,
 * and must not throw an exception. */
CONTCT_KERNEL_EXPORT void contct_kernel(const double dd[], const double dtest[], const double cc[],
                                        double ss[], double* smin, const int id[], int isep[],
                                        const int isurf[], int nc, int indof, int ndofpn, int ndof);

#ifdef __cplusplus
}
#endif

#endif
