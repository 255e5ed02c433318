"""An empty kernel in Python: reads calls and writes answers over a pipe. The stages of stages.toml complete it."""
import sys


def contct(indof, ndofpn, dofs, pairs):
    """Returns SMIN, and SS and ISEP of each pair (node, isep, isurf, face). `dofs`: {number of a dof: (d, d_star)}."""
    smin = 0.0
    ss = [0.0 for pair in pairs]
    isep = [pair[1] for pair in pairs]
    return smin, ss, isep


def main():
    for line in sys.stdin:
        words = line.split()
        key = words[0] if words else ""
        if key == "indof":  # indof I ndofpn N dofs M nc K: a call begins
            indof, ndofpn = int(words[1]), int(words[3])
            dofs, pairs = {}, []
        elif key == "dof":  # dof N dd X dtest X
            dofs[int(words[1])] = float.fromhex(words[3]), float.fromhex(words[5])
        elif key == "pair":  # pair N id N isep S isurf S cc X
            pairs.append((int(words[3]), int(words[5]), int(words[7]), float.fromhex(words[9])))
        elif key == "ask":
            smin, ss, isep = contct(indof, ndofpn, dofs, pairs)
            print("smin", smin.hex())
            for i, (s, status) in enumerate(zip(ss, isep), start=1):
                print("pair", i, "ss", s.hex(), "isep", status)
            print("end", flush=True)


if __name__ == "__main__":
    main()
