"""Counts how often the 1989 rule is wrong in different units of length: python3 reference/atlas.py [PROBLEMS [SEED]]

Runs random beams, which differ only in scale from unit to unit, with three kernels and with the corrected rule, whose
states are certified. Prints the shares of wrong answers and writes atlas.svg into the working folder. Needs contct.py,
and cc for a copy of kernels/contct_kernel.c with an EPSMUL of 1e-9.
"""
import random
import subprocess
import sys
import tempfile
from pathlib import Path

import contct

HERE = Path(__file__).resolve().parent
DECADES = range(-12, 13, 2)
COLOURS = {"fortran": "#0072B2", "fortran-r4": "#D55E00", "EPSMUL 1e-9": "#007F5F"}


def draw(seed, number, unit):
    """Returns a random beam over pairs with stiffnesses of eight decades. Its length is `unit`, EI is unit^2, and the
    total loads are about 1."""
    rng = random.Random(f"{seed} {number}")
    elements = rng.randint(3, 16)
    alike = rng.choice([None, None, 0.0, 0.013 * 10 ** rng.uniform(-2, 0)])  # 0.013: deflection of the beam under a total load of 1
    pairs = []
    for node in sorted(rng.sample(range(2, elements + 1), rng.randint(1, elements - 1))):
        gap = 0.013 * 10 ** rng.uniform(-2, 0.2) if alike is None else alike
        above = rng.random() < 0.2
        pairs.append({"node": node, "surface": "above" if above else "below", "face": (gap if above else -gap) * unit,
                      "stiffness": 10 ** rng.uniform(0, 8) / unit})
    loads = [(rng.uniform(-2, -0.1), rng.randint(2, elements), rng.uniform(-1, 1))]
    for _ in range(rng.randint(0, 4)):  # the previous load times 0, -1 or another factor
        factor = rng.choice([0.0, -1.0, rng.uniform(0.1, 3.0)])
        loads.append((loads[-1][0] * factor, loads[-1][1], loads[-1][2] * factor))
    return {"beam": {"length": unit, "elements": elements, "EI": unit ** 2}, "contact": pairs,
            "support": [{"node": node, "fix": ["w"]} for node in (1, elements + 1)],
            "step": [{"uniform": q / unit, "point": [{"node": node, "w": p}]} for q, node, p in loads]}


def is_wrong(found, right):
    """Returns True if the run is solved although a deflection has an error above 0.1 % of the largest deflection."""
    allowed = 1e-3 * max(abs(w) for step in right.steps for w in step.w)
    return found.status == "solved" and any(abs(a - b) > allowed for mine, its in zip(found.steps, right.steps)
                                            for a, b in zip(mine.w, its.w))


def count(problems, seed, unit, kernels):
    """Returns the number of wrong answers of each kernel."""
    wrong = dict.fromkeys(kernels, 0)
    for number in range(problems):
        problem = draw(seed, number, unit)
        right = contct.run(problem, kernels=["corrected"])
        if not right.certified:
            raise ValueError(f"problem {number} of seed {seed}: found {right!r}; allowed: certified")
        for name, kernel in kernels.items():
            wrong[name] += is_wrong(contct.run(problem, kernels=[kernel]), right)
    return wrong


def picture(shares, title):
    """Returns the picture, as SVG, of {kernel: share of wrong answers in each unit, in per cent}."""
    x, y = (lambda decade: 60 + 22 * (decade + 12)), (lambda share: 330 - 3 * share)
    text = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 620 370" font-family="sans-serif" font-size="13">'
            f'<title>{title}</title><rect width="620" height="370" fill="#fff"/><path d="M60 30v300h528" fill="none" stroke="#222"/>']
    text += [f'<text x="{x(d)}" y="350" text-anchor="middle">1e{d}</text>' for d in DECADES]
    text += [f'<text x="54" y="{y(share) + 4}" text-anchor="end">{share} %</text>' for share in range(0, 101, 20)]
    for line, (name, of_kernel) in enumerate(shares.items()):
        points = " ".join(f"{x(d)},{y(share):.1f}" for d, share in zip(DECADES, of_kernel))
        text.append(f'<polyline points="{points}" fill="none" stroke="{COLOURS[name]}" stroke-width="2"/>'
                    f'<text x="400" y="{50 + 18 * line}" fill="{COLOURS[name]}">{name}</text>')
    return "\n".join(text) + "\n</svg>\n"


def main(problems=1000, seed=1989):
    shares = {name: [] for name in COLOURS}
    with tempfile.TemporaryDirectory() as folder:
        source, library = Path(folder, "kernel.c"), Path(folder, "kernel.so")
        source.write_text((HERE / "kernels/contct_kernel.c").read_text().replace(".390625e-02", "1e-9"))
        subprocess.run(["cc", "-O2", "-ffp-contract=off", "-shared", "-fPIC", f"-I{HERE.parent}/cpp", "-o", library, source], check=True)
        kernels = {"fortran": "fortran", "fortran-r4": "fortran-r4", "EPSMUL 1e-9": f"plugin:{library}"}
        for decade in DECADES:
            for name, wrong in count(problems, seed, 10.0 ** decade, kernels).items():
                shares[name].append(100 * wrong / problems)
            print(f"| 1e{decade} | " + " | ".join(f"{of_kernel[-1]:.1f}" for of_kernel in shares.values()) + " |", flush=True)
    Path("atlas.svg").write_text(picture(shares, f"Wrong answers of {problems} random beams, seed {seed}, in per cent, by the unit of length"))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
