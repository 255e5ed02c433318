#!/usr/bin/env python3
"""CONTCT in Python, over a pipe: start yours from here.

  build/release/contct fuzz --kernels 'fortran,pipe:python3 reference/kernels/contct_kernel.py'

Calls come on standard input and answers go to standard output, as reference/trace-format.md describes them. What is
printed to standard error is for people. Python's floats are the listing's 8-byte REAL, and every operation on them
rounds once; numbers travel as hexfloat, so nothing is lost on the way.
"""
import sys

DELTA, EPSGAP, EPSMUL = 1e-20, 1e-10, 0.390625e-02  # the listing's DATA statement


def scale_factor(d, d_star, face, isep, isurf):
    """The share of the remaining load at which one pair has its event; 1 when it has none. Every comparison is one
    that is false for NaN, as in FORTRAN: turn none of them round."""
    gap = face - d
    if d_star == 0:  # it does not move
        return 1.0
    if abs(gap) < EPSGAP:  # it touches: does it move away, or in?
        s = isep * isurf / d_star
        return s * DELTA if s > 0 else 1.0
    return gap / d_star


def contct(pairs):
    """The answer to one call: SMIN, and SS and ISEP of each pair (d, d_star, face, isep, isurf)."""
    ss = [scale_factor(*pair) for pair in pairs]
    isep = [pair[3] for pair in pairs]
    smin = min([1.0] + [s for s in ss if 0 < s < 1])
    if smin != 1:  # toggle the earliest, and whatever comes within EPSMUL of it
        for i, s in enumerate(ss):
            if abs(s - smin) / smin < EPSMUL:
                isep[i] = -1 if isep[i] == 1 else 1
    return smin, ss, isep


def main():
    for line in sys.stdin:
        words = line.split()
        key = words[0] if words else ""
        if key == "indof":  # indof I ndofpn N dofs M nc K: a call begins
            indof, ndofpn = int(words[1]), int(words[3])
            dofs, pairs = {}, []
        elif key == "dof":  # dof N dd X dtest X: only those that a pair looks at
            dofs[int(words[1])] = float.fromhex(words[3]), float.fromhex(words[5])
        elif key == "pair":  # pair N id N isep S isurf S cc X
            d, d_star = dofs[(int(words[3]) - 1) * ndofpn + indof]
            pairs.append((d, d_star, float.fromhex(words[9]), int(words[5]), int(words[7])))
        elif key == "ask":
            smin, ss, isep = contct(pairs)
            print("smin", smin.hex())
            for i, (s, status) in enumerate(zip(ss, isep), start=1):
                print("pair", i, "ss", s.hex(), "isep", status)
            print("end", flush=True)  # without the flush both sides wait for ever


if __name__ == "__main__":
    main()
