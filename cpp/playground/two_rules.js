// The 1989 rule and the corrected rule on one problem: the beam at the end of each step by each rule. The larger
// deflection fills the picture, so that a small permanent deflection is visible. The program computes every number.
"use strict";

class TwoRules extends Scene {
  /** `names`: a description of each step. `kernels`: kernels of the 1989 rule. */
  constructor(holder, { text, names, kernels = ["fortran", "cpp"] }) {
    super(holder);
    [this.old, this.right] = [resultOf(text, kernels), resultOf(text, ["corrected"])];
    const { nodes, supports, pairs } = this.old.structure;
    Object.assign(this, { supports, pairs, nodes: nodes.map((n) => n.x), steps: ["no load yet", ...names], at: 0 });
    this.buttons = this.steps.map((words, k) => button(sentence(words).slice(0, -1), () => this.show(k), { "aria-pressed": "false" }));
    this.showAll(this.buttons);
    this.show(0);
  }

  show(k) {
    this.at = k;
    this.buttons.forEach((b, i) => b.setAttribute("aria-pressed", String(i === k)));
    this.draw();
  }

  endOf(of) { return this.at === 0 ? this.nodes.flatMap(() => [0, 0]) : of.steps[this.at - 1].displacement; }

  draw() {
    const [old, right] = [this.endOf(this.old), this.endOf(this.right)];
    const far = (u) => Math.max(...u.filter((_, i) => i % 2 === 0).map(Math.abs));
    const width = widthOf(this.picture);
    const [left, middle, height] = [34, 110, 230];
    const scale = (width - left - 90) / (this.nodes[this.nodes.length - 1] - this.nodes[0]);
    const times = magnificationFor(Math.max(far(old), far(right)), 84 / scale);
    const [X, Y] = [(x) => left + (x - this.nodes[0]) * scale, (w) => middle - w * times * scale];
    const root = canvas(this.picture, width, height, "The beam by the rule of 1989, and the right answer");
    root.append(line(left, middle, width - 24, middle, "was"), line(left, middle - 30, left, middle + 30, "face-line"), ...[-24, -12, 0, 12, 24].map((k) => line(left, middle + k, left - 8, middle + k + 8, "hatch")));
    for (const p of this.pairs) {
      const [x, y] = [X(this.nodes[p.node - 1]), Y(p.face)];
      if (y < height - 24) root.append(titled(`face of pair ${p.pair} at ${short(p.face)}`, line(x - 14, y, x + 14, y, "face-line")));
    }
    const drawn = (u) => shapeOf(this.nodes, u).map(([x, w]) => [X(x), Y(w)]);
    root.append(path(drawn(right), "ghost right"), path(drawn(old), "member"), label(width - 24, height - 8, `drawn ${timesWords(times)}`, { "text-anchor": "end", class: "axis-word" }));
    this.tell(old, right);
  }

  tell(old, right) {
    const tip = 2 * this.nodes.length - 2;
    const off = old[tip] - right[tip];
    this.words.replaceChildren(`${sentence(this.steps[this.at])} The tip by the rule of 1989: `, element("b", { "data-value": String(old[tip]) }, rough(old[tip])),
      "; the right answer (dashed): ", element("b", { "data-value": String(right[tip]) }, rough(right[tip])), Math.abs(off) > 1e-12 ? ". Off by " + rough(Math.abs(off)) + "." : ".");
  }
}
