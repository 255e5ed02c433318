"""battery.py LIBRARY: makes every call of the battery to CONTCT in a shared library.

It is a separate process, because a changed copy of the listing may crash, stop or hang. Prints one line for each field
of an answer, and flushes the output after each call, so that the answers before a crash are known. The listing writes
unit 26 to fort.26 in the working folder.
"""
import ctypes
import math
import struct
import sys

APART, TOUCHING, ABOVE, BELOW = 1, -1, 1, -1
EDGE = 0.00390625  # EPSMUL: multiples of it are exact, so a tie can be exactly at EPSMUL or one bit beside it
TIE = 0.5 * (1.0 + EDGE)

# A pair is (node, D, D*, face, ISEP on entry, ISURF). Two pairs at one node must have the same D and D*.
# A separated pair above a face, which it reaches at the share `s` of its response -1; a pair in contact 1 below its face, which
# the response lifts off at the share `s`; and a pair at its face at 0.
makes_at = lambda node, s: (node, 0.0, -1.0, -s, APART, BELOW)
breaks_at = lambda node, s: (node, -1.0, 1.0 / s, 0.0, TOUCHING, BELOW)
at_face = lambda node, d_star, isep, isurf: (node, 0.0, d_star, 0.0, isep, isurf)

SINGLE_PAIRS = {  # the first call alone is possible with `DIMENSION X(1)`
    "one pair at node 1 makes": [makes_at(1, 0.5)],
    "one pair at node 1, out of reach": [makes_at(1, 2.0)],
    "no pairs": [],
    "one pair beyond node 1 makes": [makes_at(7, 0.25)],
    "one pair breaks": [breaks_at(2, 0.5)],
    "a pressed pair stays pressed": [(2, -1.0, -3.0, 0.0, TOUCHING, BELOW)],
    "a pair moves away from its face": [(2, 0.0, 1.0, -0.5, APART, BELOW)],
    "a face above makes": [(3, 0.125, 4.0, 1.0, APART, ABOVE)],
    "a face above breaks": [(3, 1.5, -4.0, 1.0, TOUCHING, ABOVE)],
    "a face exactly at full load": [makes_at(2, 1.0)],
    "a face one bit before full load": [makes_at(2, math.nextafter(1.0, 0.0))],
    "a separated pair starts beyond its face": [(2, -1.0, 4.0, 0.0, APART, BELOW)]}
SEVERAL_PAIRS = {
    "two pairs, the second makes": [makes_at(2, 0.75), makes_at(3, 0.25)],
    "two pairs, the first makes": [makes_at(2, 0.25), makes_at(3, 0.75)],
    "three pairs, none in reach": [makes_at(2, 1.5), makes_at(3, 2.5), makes_at(4, 3.5)],
    "three pairs, the last makes": [makes_at(2, 0.9), makes_at(3, 0.8), makes_at(4, 0.3)],
    "a break before a make": [makes_at(2, 0.75), breaks_at(3, 0.5)],
    "a make before a break": [makes_at(2, 0.25), breaks_at(3, 0.5)],
    "a break between two makes": [makes_at(5, 0.6), breaks_at(4, 0.3), makes_at(3, 0.4)],
    "faces above and below one node": [(4, 0.0, -2.0, 1.0, APART, ABOVE), (4, 0.0, -2.0, -1.0, APART, BELOW)],
    "only the middle of three responds": [(2, 0.0, 0.0, -0.5, APART, BELOW), makes_at(3, 0.5), (4, 0.0, 0.0, -0.25, APART, BELOW)],
    "no pair responds": [(2, 0.0, 0.0, -0.5, APART, BELOW), (3, 0.0, 0.0, 0.0, TOUCHING, BELOW)],
    "a response of minus zero": [(2, 0.0, -0.0, -0.5, APART, BELOW), makes_at(3, 0.5)],
    "an awkward quotient": [(2, 0.1, -0.7, -0.2, APART, BELOW), (3, 0.3, 1.1, 0.7, APART, ABOVE)],
    "twelve pairs": [makes_at(2, 0.9), breaks_at(3, 0.8), makes_at(4, 2.0), at_face(5, -0.5, TOUCHING, BELOW), makes_at(6, 0.31),
                     breaks_at(7, 0.7), makes_at(8, 0.5), at_face(9, 0.5, APART, BELOW), makes_at(10, 0.3), breaks_at(11, 0.3),
                     makes_at(12, 0.4), breaks_at(13, 0.301)]}
TIES = {
    "an exact tie of two makes": [makes_at(2, 0.5), makes_at(3, 0.5)],
    "an exact tie of two breaks": [breaks_at(2, 0.5), breaks_at(3, 0.5)],
    "an exact tie of a make and a break": [makes_at(2, 0.5), breaks_at(3, 0.5)],
    "a near tie one bit inside 2^-8": [makes_at(2, 0.5), makes_at(3, math.nextafter(TIE, 0.0))],
    "a near tie exactly at 2^-8": [makes_at(2, 0.5), makes_at(3, TIE)],
    "a near tie one bit outside 2^-8": [makes_at(2, 0.5), makes_at(3, math.nextafter(TIE, 1.0))],
    "the later of a near tie comes first": [makes_at(2, 0.501), makes_at(3, 0.5)],
    "of three, two tie": [makes_at(2, 0.9), makes_at(3, 0.501), breaks_at(4, 0.5)],
    "a chain of near ties": [makes_at(2, 0.5), makes_at(3, 0.5015), makes_at(4, 0.503)],
    "a make near full load takes a pair that does not respond along": [(2, 0.0, 0.0, -0.5, APART, BELOW), makes_at(3, 0.9985)],
    "a make near full load takes a quiet stationary pair along": [at_face(2, -0.5, TOUCHING, BELOW), makes_at(3, 0.9985)]}
STATIONARY_PAIRS = {
    "stationary and separated, toward the face": [at_face(2, -0.01, APART, BELOW)],
    "stationary and separated, away from the face": [at_face(2, 0.01, APART, BELOW)],
    "stationary and closed, lifted": [at_face(2, 0.01, TOUCHING, BELOW)],
    "stationary and closed, pressed": [at_face(2, -0.01, TOUCHING, BELOW)],
    "stationary and closed under a face above, opens": [at_face(2, -0.01, TOUCHING, ABOVE)],
    "of two stationary, the second responds more": [at_face(2, -0.01, APART, BELOW), at_face(3, -0.04, APART, BELOW)],
    "of two stationary, the first responds more": [at_face(2, 0.04, TOUCHING, BELOW), at_face(3, 0.01, TOUCHING, BELOW)],
    "of two stationary, only the first is quiet": [at_face(2, -0.04, TOUCHING, BELOW), at_face(3, 0.01, TOUCHING, BELOW)],
    "two stationary within 2^-8": [at_face(2, 1.0, TOUCHING, BELOW), at_face(3, 1.001, TOUCHING, BELOW)],
    "stationary before a make": [makes_at(2, 0.01), at_face(3, 0.01, TOUCHING, BELOW)],
    "a quiet stationary pair and a make": [makes_at(2, 0.5), at_face(3, -0.01, TOUCHING, BELOW)],
    "three stationary, all quiet": [at_face(2, 0.3, APART, BELOW), at_face(3, 0.2, APART, BELOW), at_face(4, -0.1, TOUCHING, BELOW)],
    "a gap just under EPSGAP": [(2, 0.0, -1.0, -0.999e-10, APART, BELOW)],
    "a gap of EPSGAP": [(2, 0.0, -1.0, -1.0e-10, APART, BELOW)],
    "overshot by less than EPSGAP": [(2, -0.999e-10, -1.0, 0.0, APART, BELOW)],
    "a stationary factor with an exponent of three digits": [at_face(2, -1.0e100, APART, BELOW)]}
LAYOUTS = {  # (pairs, INDOF, NDOFPN)
    "two dofs a node, the second deflects": ([makes_at(2, 0.5), breaks_at(5, 0.25)], 2, 2),
    "two dofs a node, the first deflects": ([makes_at(2, 0.5), breaks_at(5, 0.25)], 1, 2),
    "three dofs a node, the third deflects": ([makes_at(1, 0.5), makes_at(6, 0.75)], 3, 3),
    "three dofs a node, stationary": ([at_face(6, -0.5, APART, BELOW), makes_at(1, 0.5)], 1, 3),
    "nodes in falling order": ([makes_at(9, 0.5), makes_at(8, 0.25), breaks_at(2, 0.75)], 1, 1),
    "node 999 makes": ([makes_at(1, 0.75), makes_at(999, 0.5)], 1, 1),
    "node 1000 overflows its field": ([makes_at(1, 0.75), makes_at(1000, 0.5)], 1, 1),
    "node 1000 of three dofs breaks": ([breaks_at(1000, 0.5)], 2, 3)}
BATTERY = {name: (pairs, 1, 1) for name, pairs in {**SINGLE_PAIRS, **SEVERAL_PAIRS, **TIES, **STATIONARY_PAIRS}.items()} | LAYOUTS

FOREIGN, UNSET = 77.0, -5.0  # D and D* of dofs without pairs; SS and SMIN on entry


def ask(contct, common, pairs, indof, ndofpn):
    """Returns the answer to one call as a list of (field, value), with real numbers as the digits of their bits."""
    dofs = [(pair[0] - 1) * ndofpn + indof - 1 for pair in pairs]
    size, count = max(dofs, default=-1) + 1, len(pairs)
    dd, dtest = (ctypes.c_double * size)(*[FOREIGN] * size), (ctypes.c_double * size)(*[-FOREIGN] * size)
    for dof, (_, d, d_star, *_) in zip(dofs, pairs):
        dd[dof], dtest[dof] = d, d_star
    cc, ss = (ctypes.c_double * count)(*[p[3] for p in pairs]), (ctypes.c_double * count)(*[UNSET] * count)
    nodes, isep, isurf = ((ctypes.c_int * count)(*[p[i] for p in pairs]) for i in (0, 4, 5))
    smin, common[0], common[1] = ctypes.c_double(UNSET), indof, ndofpn
    contct(dd, dtest, cc, ss, ctypes.byref(smin), nodes, isep, isurf, ctypes.byref(ctypes.c_int(count)))
    reals = [("SMIN", smin.value), *[(f"SS({i + 1})", s) for i, s in enumerate(ss)]]
    return [(field, struct.pack(">d", x).hex()) for field, x in reals] + [(f"ISEP({i + 1})", k) for i, k in enumerate(isep)]


if __name__ == "__main__":
    library = ctypes.CDLL(sys.argv[1])
    for call, (of_call, indof_of_call, ndofpn_of_call) in BATTERY.items():
        answer = ask(library.contct_, (ctypes.c_int * 2).in_dll(library, "dof_"), of_call, indof_of_call, ndofpn_of_call)
        print("\n".join(f"{call}|{field}|{value}" for field, value in answer), flush=True)
