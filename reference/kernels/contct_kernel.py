#!/usr/bin/env python3
"""CONTCT in Python over a pipe, from which you can start your own kernel.

  build/release/contct fuzz --kernels 'fortran,pipe:python3 reference/kernels/contct_kernel.py'

Reads calls from standard input and writes answers to standard output in the format of reference/trace-format.md.
Messages may go to standard error. Python's floats are the listing's 8-byte REAL, and every operation rounds once.
Hexadecimal floats are exact.
"""
import sys

DELTA, EPSGAP, EPSMUL = 1e-20, 1e-10, 0.390625e-02  # the listing's DATA statement


def scale_factor(d, d_star, face, isep, isurf):
    """Returns s of one pair. If s is between 0 and 1, the pair has its event at this share of the remaining load.
    Do not negate a comparison: all comparisons with NaN are false, as in FORTRAN."""
    gap = face - d
    if d_star == 0:  # the pair does not move
        return 1.0
    if abs(gap) < EPSGAP:  # at the face: an event if the motion changes the status
        s = isep * isurf / d_star
        return s * DELTA if s > 0 else 1.0
    return gap / d_star


def contct(pairs):
    """Returns SMIN, and SS and ISEP of each pair (d, d_star, face, isep, isurf)."""
    ss = [scale_factor(*pair) for pair in pairs]
    isep = [pair[3] for pair in pairs]
    smin = min([1.0] + [s for s in ss if 0 < s < 1])
    if smin != 1:  # toggle all pairs whose SS is within EPSMUL of SMIN
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
        elif key == "dof":  # dof N dd X dtest X: only the dofs of pairs
            dofs[int(words[1])] = float.fromhex(words[3]), float.fromhex(words[5])
        elif key == "pair":  # pair N id N isep S isurf S cc X
            d, d_star = dofs[(int(words[3]) - 1) * ndofpn + indof]
            pairs.append((d, d_star, float.fromhex(words[9]), int(words[5]), int(words[7])))
        elif key == "ask":
            smin, ss, isep = contct(pairs)
            print("smin", smin.hex())
            for i, (s, status) in enumerate(zip(ss, isep), start=1):
                print("pair", i, "ss", s.hex(), "isep", status)
            print("end", flush=True)  # without the flush contct would wait for the answer


if __name__ == "__main__":
    main()
