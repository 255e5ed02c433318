// The 1989 rule and the corrected rule on one problem: the beam at the end of each step by each rule. The larger
// deflection fills the picture, so that a small permanent deflection is visible. The program computes every number.
"use strict";

class TwoRules extends Scene {
  /** `names`: a description of each step. `kernels`: kernels of the 1989 rule. `units`: of force and length. `slide`: a
      face that a slider lowers, and by how much. `mine`: displacements at the end of each step by another kernel, `who`. */
  constructor(holder, { text, names, kernels = ["fortran", "cpp"], units = ["", ""], slide = null, mine = null, who = "the 1989 rule" }) {
    super(holder);
    Object.assign(this, { text, kernels, units, slide, mine, who, steps: ["no load yet", ...names], at: 0, seen: new Map() });
    this.solve(text);
    this.buttons = this.steps.map((words, k) => button(sentence(words).slice(0, -1), () => this.show(k), { "aria-pressed": "false" }));
    this.showAll([this.buttons], ...(slide ? this.slider() : []));
    this.show(0);
  }

  solve(text) {
    [this.listing, this.right] = [resultOf(text, this.kernels), resultOf(text, ["corrected"])];
    this.old = this.mine ? { ...this.right, steps: this.mine.map((displacement) => ({ displacement })) } : this.listing;
    this.most = Math.max(...[this.old, this.right].flatMap((of) => of.steps.flatMap(({ displacement }) => displacement.filter((_, i) => i % 2 === 0).map(Math.abs))));
    const { nodes, supports, pairs } = this.right.structure;
    Object.assign(this, { supports, pairs, nodes: nodes.map((n) => n.x) });
  }

  /** A slider for the height of a face, with a plot of what stays of the tip's deflection at each height that was tried. */
  slider() {
    const { key, from, most, start } = this.slide;
    const numbers = ask("check", this.text, { places: true }).result.numbers;
    this.plot = element("div", { class: "picture" });
    this.said = element("output", {});
    this.range = element("input", { type: "range", min: "0", max: String(most), step: "0.001", value: String(start), "aria-label": "Difference of the stops' heights in mm" });
    this.range.addEventListener("input", () => {
      this.solve(withNumbers(this.text, numbers, { [key]: String(Number((from - this.range.value / 1000).toPrecision(8))) }));
      this.show(2);
    });
    return [element("label", { class: "controls" }, "The second stop is lower by ", this.range, this.said), this.plot];
  }

  /** Plots the tip's deflection after unloading against the heights that were tried. */
  drawPlot() {
    const [width, height, left, top] = [widthOf(this.plot), 150, 60, 26];
    const [x, stays] = [Number(this.range.value), Math.abs(this.old.steps[1].displacement.at(-2)) * 1000];
    this.seen.set(x, stays);
    this.said.textContent = ` ${x.toFixed(3)} mm`;
    const root = canvas(this.plot, width, height, "What stays of the tip's deflection, against the difference of the heights");
    const [X, Y] = [(mm) => left + (mm / this.slide.most) * (width - left - 30), (mm) => height - 34 - mm * 400];
    scaleUp(root, [0, 0.1, 0.2], Y, left, width - 30, 8);
    scaleAlong(root, [0, 0.02, 0.04, 0.06, 0.08, 0.1], X, Y(0));
    root.append(axisWord(8, top - 10, "stays without load [mm]", "start"), axisWord(width - 30, top - 10, "lower by [mm]", "end"),
      ...[...this.seen].map(([mm, stay]) => svg("circle", { cx: X(mm), cy: Y(stay), r: mm === x ? 6 : 3, class: mm === x ? "dot gold" : "dot", "data-stays": String(stay) })));
  }

  show(k) {
    this.at = k;
    this.buttons.forEach((b, i) => b.setAttribute("aria-pressed", String(i === k)));
    this.draw();
  }

  /** Displacements that are only rounding, less than 1e-9 of the largest on the path, count as zero. */
  settled(u) { return u.some((w, i) => i % 2 === 0 && Math.abs(w) > 1e-9 * this.most) ? u : u.map(() => 0); }

  endOf(of) { return this.at === 0 ? this.nodes.flatMap(() => [0, 0]) : of.steps[this.at - 1].displacement; }

  draw() {
    const [old, right] = [this.endOf(this.old), this.endOf(this.right)];
    const far = (u) => Math.max(...u.filter((_, i) => i % 2 === 0).map(Math.abs));
    const width = widthOf(this.picture);
    const [left, middle, height] = [60, 110, 230];
    const scale = (width - left - 60) / (this.nodes[this.nodes.length - 1] - this.nodes[0]);
    const times = magnificationFor(Math.max(far(this.settled(old)), far(this.settled(right))) || this.most, 84 / scale);
    const [X, Y] = [(x) => left + (x - this.nodes[0]) * scale, (w) => middle - w * times * scale];
    const root = canvas(this.picture, width, height, `The beam by ${this.who}, and the right answer`);
    root.append(line(left, middle, width - 24, middle, "was"), line(left, middle - 30, left, middle + 30, "face-line"), ...[-24, -12, 0, 12, 24].map((k) => line(left, middle + k, left - 8, middle + k + 8, "hatch")));
    for (const p of this.pairs) {
      const [x, y] = [X(this.nodes[p.node - 1]), Y(p.face)];
      if (y < height - 24) root.append(titled(`face of pair ${p.pair} at ${short(p.face)}`, line(x - 14, y, x + 14, y, "face-line")));
    }
    const drawn = (u) => shapeOf(this.nodes, this.settled(u)).map(([x, w]) => [X(x), Y(w)]);
    root.append(path(drawn(right), "ghost right"), path(drawn(old), "member"), axisWord(8, 18, `vertical ${timesWords(times)}`, "start"),
      axisWord(8, height - 8, `solid: ${this.who}; dashed: right`, "start"));
    this.tell(old, right);
    if (this.slide) this.drawPlot();
  }

  tell(old, right) {
    const [tip, unit] = [2 * this.nodes.length - 2, ` ${this.units[1]}`.trimEnd()];
    const is = (a, b) => Math.abs(a - b) <= 1e-9 * this.most;
    const words = (w) => rough(is(w, 0) ? 0 : w) + unit;
    const shown = (w) => element("b", { "data-value": String(w) }, words(w));
    const listed = this.endOf(this.listing)[tip];
    const whose = !this.mine ? "" : is(old[tip], listed) ? " CONTCT gives the same: this is the listing's own fault (EPSMUL, page 9)." : ` CONTCT gives ${words(listed)}.`;
    this.words.replaceChildren(`${sentence(this.steps[this.at])} The tip by ${this.who}: `, shown(old[tip]), "; the right answer (dashed): ", shown(right[tip]), ".",
      is(old[tip], right[tip]) ? "" : ` Off by ${rough(Math.abs(old[tip] - right[tip]))}${unit}.${whose}`);
  }
}
