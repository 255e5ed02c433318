"""Writes a picture of each job of the cookbook, NAME.svg, from its result. In this folder:
    PYTHONPATH=../../build/release python3 pictures.py

A picture shows the state at the end of the step that cookbook.md discusses, by the corrected rule: deflections
magnified, the unloaded structure in grey, pairs filled if in contact and hollow if separated, the largest force in kN.
"""
from pathlib import Path

import contct

STEPS = {"crane": 1, "slab": 2, "base-plate": 2, "racks": 2, "rail": 2, "rail-joint": 2, "deep-beam": 2, "bed": 2, "matrix": 2}
WIDTH, HEIGHT, SIDE = 640, 220, 40


def project(place, flat):
    """Returns a point's place in the picture: beams are seen from the side, other structures from above at an angle."""
    x, y, z = place
    return (x, z) if flat else (x + 0.45 * y, 0.36 * y + z)


def drawing(result, step):
    """Returns the SVG elements of the picture, and the magnification of deflections."""
    shape, end = result.to_dict()["structure"], result.to_dict()["steps"][step - 1]
    flat = shape["kind"] == "beam"
    nodes = [(n["x"], n.get("y") or 0.0, 0.0) for n in shape["nodes"]]
    if shape["kind"] == "matrix":
        rise = [0.0] * len(nodes)
        for dof, value in zip(shape["dofs"], end["displacement"]):
            if dof["direction"] == 3:
                rise[dof["at"] - 1] = value
        edges = [edge[:2] for edge in shape["edges"]]
        at = {dof["dof"]: dof["at"] - 1 for dof in shape["dofs"]}
    else:
        rise = end["w"]
        columns = len(nodes) if flat else shape["columns"]
        count = range(1, len(nodes) + 1)
        edges = [(n, n + 1) for n in count if n % columns] + [(n, n + columns) for n in count if n + columns <= len(nodes)]
        at = {n["node"]: n["node"] - 1 for n in shape["nodes"]}
    seen = [project(place, flat) for place in nodes]
    left, right = min(x for x, _ in seen), max(x for x, _ in seen)
    scale = (WIDTH - 2 * SIDE) / (right - left)
    magnified = 50 / max(abs(w) for w in rise)
    low, high = min(y for _, y in seen) * scale, max(y for _, y in seen) * scale
    lowest = max(-y * scale - w * magnified for (_, y), w in zip(seen, rise))
    drop = min(HEIGHT / 2 + (low + high) / 2 + (10 if shape["kind"] != "matrix" else -10), HEIGHT - 8 - lowest)

    def spot(node, w=0.0):
        x, y = seen[node]
        return f"{SIDE + (x - left) * scale:.1f}", f"{drop - y * scale - w * magnified:.1f}"

    def lines(of, style):
        path = "".join(f"M{' '.join(of(a - 1))}L{' '.join(of(b - 1))}" for a, b in edges)
        return f'<path d="{path}" {style}/>'

    parts = [lines(spot, 'class="unloaded"'), lines(lambda n: spot(n, rise[n]), 'class="loaded"')]
    for support in (s for s in shape["supports"] if s.get("dof") not in ("wx", "wy")):
        node = at[support["node"] if "node" in support else support["dof"]]
        x, y = spot(node, rise[node])
        parts.append(f'<path class="support" d="M{x} {y}l-6 10h12z"/>')
    largest = max((pair["force"] for pair in end["pairs"]), default=0.0)
    for pair in end["pairs"]:
        node = at[pair["node"] if "node" in pair else pair["dof"]]
        x, y = spot(node, rise[node])
        down = 5 if pair["surface"] == "below" else -5
        parts.append(f'<circle class="{pair["state"]}" cx="{x}" cy="{float(y) + down:.1f}" r="3"/>')
        if pair["force"] > 0.999999 * largest > 0:
            parts.append(f'<text x="{x}" y="{float(y) + 4 * down + (4 if down > 0 else 8):.1f}">{pair["force"]:{".1f" if largest >= 1 else ".2g"}}</text>')
    return parts, magnified / scale


def svg(file, step):
    result = contct.run(file, kernels="corrected", states=True)
    parts, magnified = drawing(result, step)
    name = result.steps[step - 1].name
    words = f"{result.title}: {name}" if name and len(result.title) < 60 else result.title
    digits = ".0f" if magnified >= 10 else ".2g"
    head = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img"><title>{words}</title>'
            "<style>path{fill:none;stroke-width:1.5}.unloaded{stroke:#aaa}.loaded{stroke:#1560bd;stroke-width:2}"
            ".support{fill:#666;stroke:none}.contact{fill:#c2410c}.separated{fill:none;stroke:#c2410c}"
            "text{font:12px sans-serif;text-anchor:middle;fill:#7c2d12}.words{text-anchor:start;fill:#333}</style>"
            f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>')
    foot = f'<text class="words" x="10" y="18">{words}; deflections times {magnified:{digits}}</text></svg>'
    return "\n".join([head, *parts, foot]) + "\n"


def main():
    here = Path(__file__).resolve().parent
    for name, step in STEPS.items():
        (here / f"{name}.svg").write_text(svg(here / f"{name}.toml", step))


if __name__ == "__main__":
    main()
