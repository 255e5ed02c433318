// A scene: a beam over stops, a load that can be dragged, and the steps of the 1989 algorithm. The beam is unloaded at
// first. One step shows d*, the response to all the remaining load, and the share s at which each pair would meet its
// face. The next step applies the smallest s. The program computes every number; between two states the beam moves
// linearly, as in the paper.
"use strict";

const stillAsked = () => matchMedia("(prefers-reduced-motion: reduce)").matches;
const scenes = [];  // all scenes of the page, in order

const hermite = (h, w0, w1, t0, t1, a, b = 1 - a) => w0 * b * b * (1 + 2 * a) + w1 * a * a * (1 + 2 * b) + h * (t0 * a * b * b - t1 * a * a * b);

/** The shape of a beam: [x, w] along its elements, cubic between nodes. */
function shapeOf(nodes, u, parts = 6) {
  const points = [[nodes[0], u[0]]];
  for (let e = 0; e + 1 < nodes.length; ++e) {
    const h = nodes[e + 1] - nodes[e];
    for (let i = 1; i <= parts; ++i) points.push([nodes[e] + (h * i) / parts, hermite(h, u[2 * e], u[2 * e + 2], u[2 * e + 1], u[2 * e + 3], i / parts)]);
  }
  return points;
}

/** "stop 1", or "stops 1, 2 and 3". */
const stopsIn = (pairs) => `stop${pairs.length > 1 ? "s" : ""} ${pairs.map((p) => p.pair).join(" and ").replace(/ and (?=.* and )/g, ", ")}`;

const nearestTo = (x, xs) => xs.reduce((best, at, i) => (Math.abs(at - x) < Math.abs(xs[best] - x) ? i : best), 0);

/** A place of the page with words, a picture and controls. `kind`: the name of the element for the words. */
class Scene {
  constructor(holder, kind = "p") {
    this.words = element(kind, { class: "told", role: "status", "aria-live": "polite" });
    this.picture = element("div", { class: "picture" });
    this.holder = holder;
    holder.classList.add("scene");
    scenes.push(this);
  }

  /** Shows rows of controls, the words, the picture and other elements. The controls are first, so that they stay where
      they are when the picture grows. The picture is drawn again if its width changes. */
  showAll(rows, ...others) {
    this.holder.replaceChildren(...rows.map((row) => element("div", { class: "controls" }, ...row)), this.words, this.picture, ...others);
    const items = () => [...this.picture.querySelectorAll("[tabindex]")];
    new ResizeObserver(() => {
      const focused = items().indexOf(document.activeElement);
      this.draw();
      items()[focused]?.focus();
    }).observe(this.picture);
  }
}

class ContactScene extends Scene {
  /** `text`: a problem file with a beam. `load`: the key of the point load that is dragged; `most`: its largest size.
      `units`: the units of force and length, for labels. `beside`: equivalent code for each line of the listing. */
  constructor(holder, { text, load = "step[1].point[1]", most = 1, units = ["", ""], kernels = ["fortran", "cpp"], listing = "", beside = null, question = "" }) {
    super(holder);
    const [force, length] = units.map((unit) => (x) => `${rough(Math.abs(x))} ${unit}`.trim());
    Object.assign(this, { load, most, kernels, beside, question, inForce: force, inLength: length, grid: roundDown(most / 40) });
    this.field = element("input", { type: "number", min: "0", max: String(most), step: String(this.grid), "aria-label": `Load, from 0 to ${force(most)}` });
    this.field.addEventListener("change", () => {
      const asked = Number(this.field.value);
      this.push(this.node, -asked, false);
      this.field.value = String(Math.abs(this.force));
      this.note = asked === Math.abs(this.force) ? "" : `Allowed: a load from 0 to ${force(most)}, downwards. `;
      this.draw();
    });
    this.fieldLabel = element("label", {}, "Load ", this.field, ` ${units[0]}`);
    this.history = new TextHistory(text);
    this.listing = listing.split("\n").slice(0, -1).map((words) => element("li", {}, words));
    this.build();
    this.solve();
    this.show("end");
  }

  // ---- elements of the page ----

  build() {
    const first = { start: ["From the start", () => this.start()], ignore: ["Ignore s_min", () => this.ignore()],
      undo: ["Undo", () => this.restore(this.history.undo())], redo: ["Redo", () => this.restore(this.history.redo())] };
    const steps = { step: ["Step", () => this.step()], into: ["Step into", () => this.stepInto()], pair: ["Next pair", () => this.nextPair()], back: ["Step back", () => this.stepBack()] };
    this.buttons = {};
    const row = (acts) => Object.entries(acts).map(([name, [words, act]]) => (this.buttons[name] = button(words, () => { this.finish(); act(); }, { "data-act": name })));
    this.values = element("dl", { class: "values" });
    this.lines = element("ol", { class: "listing", tabindex: "0", role: "region", "aria-label": "The listing" }, ...this.listing);
    this.inside = element("div", { class: "inside", hidden: "" }, this.values, this.lines);
    this.showAll([[this.fieldLabel, ...row(first)], row(steps)], this.inside);
    listenForUndo(this.holder, (way) => this.restore(this.history[way]()));
  }

  // ---- the program's answers ----

  /** Computes the path under the load of the text, and the explanation of each increment. */
  solve() {
    const text = this.history.text;
    this.numbers = ask("check", text, { places: true }).result.numbers;
    this.result = resultOf(text, this.kernels);
    this.told = ask("explain", text, { kernels: this.kernels }).result.increments;
    this.nodes = this.result.structure.nodes.map((n) => n.x);
    this.pairs = this.result.structure.pairs.map((p) => ({ ...p, at: p.node - 1, side: p.surface === "above" ? 1 : -1 }));
    this.frames = this.framesOf();
    this.frameOnce();
  }

  /** The unloaded beam, and the state after each increment. */
  framesOf() {
    const begun = { u: this.nodes.flatMap(() => [0, 0]), closed: this.pairs.map((p) => p.state === "contact"), force: this.pairs.map(() => 0), share: 0 };
    const behind = this.result.steps.flatMap((step) => step.increments.map((i, n) => {
      const state = i.displacement ? i : step;
      return { u: state.displacement, closed: state.pairs.map((p) => p.state === "contact"), force: state.pairs.map((p) => p.force), share: i.fraction, s: i.s, events: i.events };
    }));
    return [begun, ...behind];
  }

  /** The beam under the whole remaining load. d* is the displacement to the next state, divided by its share. */
  ghostOf(k) {
    const [now, next] = [this.frames[k], this.frames[k + 1]];
    return next && next.s > 0 ? now.u.map((w, i) => w + (next.u[i] - w) / next.s) : null;
  }

  /** The pairs whose statuses increment `k` + 1 changes. */
  toggledOf(k) { return (this.frames[k + 1]?.events ?? []).map((e) => e.pair); }

  number(name) { return this.numbers.find((n) => n.key === `${this.load}.${name}`); }
  get force() { return this.number("w").value; }
  get node() {
    const [node, x] = [this.number("node"), this.number("x")];
    return node ? node.value - 1 : nearestTo(x.value, this.nodes);
  }

  // ---- the path ----

  get last() { return this.frames.length - 1; }

  /** Shows the beam under the whole load ("end"), or state `k` of the path ("path"). */
  show(what, k = this.last) {
    this.moving = null;
    Object.assign(this, { shown: what, k, overlay: what === "path" && k < this.last, at: -1, through: null, note: "" });
    this.draw();
  }

  start() { this.show("path", 0); }

  step() {
    if (this.shown === "end" || (!this.overlay && this.k === this.last)) return this.start();
    if (this.through) return this.ignore();
    const [from, to] = [this.frames[this.k].u, this.frames[this.k + 1].u];
    this.glide(from, to, () => this.show("path", this.k + 1));
  }

  /** Moves to the next line of the listing in the order of execution. */
  stepInto() {
    if (this.shown === "end" || !this.overlay) return this.start();
    if (this.through) return this.ignore();
    if (this.at + 1 >= this.linesOf(this.k).length) return this.step();
    this.at += 1;
    this.draw();
  }

  /** Moves to the first line that is about another pair. */
  nextPair() {
    if (this.shown === "end" || !this.overlay || this.through) return this.stepInto();
    const lines = this.linesOf(this.k);
    const next = lines.findIndex((l, i) => i > this.at && l.pair !== lines[this.at]?.pair);
    this.at = (next < 0 ? lines.length : next) - 1;
    this.stepInto();
  }

  /** Moves to the line before, or to the increment before. */
  stepBack() {
    if (this.shown === "end") return;
    if (this.through) return this.ignore();
    if (this.at < 0) return this.show("path", Math.max(0, this.k - 1));
    this.at -= 1;
    this.draw();
  }

  linesOf(k) {
    const told = this.told[k];
    if (!told) return [];
    const of = (pair, wanted) => pair.story.filter((l) => l.line && wanted(l.line)).map((l) => ({ ...l, pair }));
    const first = told.pairs.flatMap((p) => of(p, (line) => line < 42));
    const winner = told.story.filter((l) => l.line).map((l) => ({ ...l, pair: null }));
    return [...first, ...winner, ...told.pairs.flatMap((p) => of(p, (line) => line > 48))];
  }

  /** Shows the path without s_min: all the remaining load is applied at once, and the beam passes through the stops. */
  ignore() {
    if (this.shown === "end" || !this.overlay) this.start();
    const ghost = this.ghostOf(this.k);
    if (!ghost) return;
    const now = this.frames[this.k].u;
    const [from, to] = this.through ? [ghost, now] : [now, ghost];
    const back = this.through !== null;
    this.through = ghost;
    this.glide(from, to, () => { this.through = back ? null : ghost; this.draw(); });
  }

  glide(from, to, done) {
    if (stillAsked()) return done();
    const [began, mine] = [performance.now(), (this.moving = { u: from, done })];
    const move = (now) => {
      if (this.moving !== mine) return;
      const t = Math.min(1, Math.max(0, (now - began) / 650));
      mine.u = from.map((w, i) => w + t * t * (3 - 2 * t) * (to[i] - w));
      if (t === 1) return this.finish();
      this.draw();
      requestAnimationFrame(move);
    };
    requestAnimationFrame(move);
  }

  /** Ends a movement at once, so that quick presses of a button all count. */
  finish() {
    const moving = this.moving;
    this.moving = null;
    moving?.done();
  }

  // ---- dragging ----

  restore() {
    this.solve();
    this.show("end");
  }

  /** Sets the load's node and size. If `follows`, the change is part of the same drag. */
  push(node, force, follows) {
    const place = this.number("node") ? { [`${this.load}.node`]: node + 1 } : { [`${this.load}.x`]: this.nodes[node] };
    this.history.add(withNumbers(this.history.text, this.numbers, { [`${this.load}.w`]: Math.max(-this.most, Math.min(0, force)), ...place }), follows);
    this.restore();
  }

  addHandle(root, x, top) {
    const words = `load ${rough(this.force)} at x = ${rough(this.nodes[this.node])}; arrow keys move it`;
    const range = { "aria-valuenow": String(Math.abs(this.force)), "aria-valuemin": "0", "aria-valuemax": String(this.most) };
    root.append(handle({ x: x - 24, y: top - 8, width: 48, height: 72, rx: 8 }, words, {
      class: "handle across", ...range,
      begin: () => {
        const [force, from, begun] = [this.force, this.nodes[this.node], this.history.at];
        return (dx, dy) => this.push(nearestTo(from + dx / this.page.scale, this.nodes), this.onGrid(force - (dy * this.most) / 150), this.history.at > begun);
      },
      ends: { Home: [0, -Infinity], End: [0, Infinity] },
      step: ([across, down], far) => this.push(Math.max(0, Math.min(this.nodes.length - 1, this.node + across)), this.onGrid(this.force - down * this.grid * (far ? 5 : 1)), false),
    }));
  }

  onGrid(force) { return Number((Math.round(force / this.grid) * this.grid).toPrecision(6)); }

  // ---- the picture ----

  /** Sets the vertical scale by the beam under the largest load without stops. The scale is the same for all loads, so
      that the beam moves with the finger. */
  frameOnce() {
    if (this.deep) return;
    const largest = resultOf(withNumbers(this.history.text, this.numbers, { [`${this.load}.w`]: -this.most }), this.kernels);
    const [first] = largest.steps[0].increments;
    const reach = (first.displacement ?? largest.steps[0].displacement).map((w) => Math.abs(w) / first.s).filter((_, i) => i % 2 === 0);
    this.deep = Math.max(...this.pairs.map((p) => 1.5 * Math.abs(p.face)), ...reach);
    this.rest = Math.min(...largest.steps[0].displacement.filter((_, i) => i % 2 === 0), ...this.pairs.map((p) => p.face));
  }

  draw() {
    const width = widthOf(this.picture);
    const [left, right, top, room] = width < 480 ? [36, 48, 82, 72] : [60, 60, 124, 240];
    const [x0, x1] = [this.nodes[0], this.nodes[this.nodes.length - 1]];
    const scale = (width - left - right) / (x1 - x0);
    const times = room / this.deep;
    const frame = this.frames[this.k];
    const u = this.moving ? this.moving.u : this.through || frame.u;
    // The canvas ends below what is drawn: the stops, the beam, and the beam at D + d*.
    const lowest = Math.min(this.rest, ...[u, (this.overlay && this.ghostOf(this.k)) || u].flatMap((of) => of.filter((_, i) => i % 2 === 0)));
    const height = Math.round(top - lowest * times + (this.overlay ? (width < 480 ? 70 : 54) + 18 * this.pairs.length : 58));
    this.page = { width, left, right, top, height, scale, times, X: (x) => left + (x - x0) * scale, Y: (w) => top - w * times };
    const root = canvas(this.picture, width, height, this.question);
    root.append(line(left, top, width - right, top, "was"), axisWord(8, 18, `vertical ${timesWords(times / scale)}`, "start"));
    this.drawSupports(root);
    this.pairs.forEach((p, i) => this.drawStop(root, p, u[2 * p.at], frame.closed[i] && !this.through));
    if (this.overlay && !this.through) this.drawGhost(root, frame.u);
    root.append(path(shapeOf(this.nodes, u).map(([x, w]) => [this.page.X(x), this.page.Y(w)]), "member"));
    if (!this.moving && !this.through) this.pairs.forEach((p, i) => this.drawForce(root, p, frame.u[2 * p.at], frame.force[i]));
    if (this.overlay) this.drawShares(root);
    this.drawLoad(root, u);
    this.tell(u);
    this.showLine();
  }

  drawSupports(root) {
    const { X, Y } = this.page;
    const turned = new Set(this.result.structure.supports.filter((s) => s.dof !== "w").map((s) => s.node));
    for (const s of this.result.structure.supports.filter(({ dof }) => dof === "w")) {
      const [x, y] = [X(this.nodes[s.node - 1]), Y(0)];
      if (!turned.has(s.node)) root.append(shape(`M${x} ${y + 3}l9 15h-18z`, "support"));
      else root.append(line(x, y - 30, x, y + 30, "face-line"), ...[-24, -12, 0, 12, 24].map((k) => line(x, y + k, x - 8, y + k + 8, "hatch")));
    }
  }

  /** Draws a stop. In contact, its top is at the beam, because its spring is compressed. */
  drawStop(root, p, w, closed) {
    const { X, Y, times } = this.page;
    const [x, y, foot] = [X(this.nodes[p.at]), Y(closed ? w : p.face), Y(p.face) - p.side * 40];
    const through = this.through && p.side * (p.face - w) * times < -0.5;
    const at = (t, across) => `L${(x + across).toFixed(1)} ${(y + (foot - y) * t).toFixed(1)}`;
    const coil = Array.from({ length: 9 }, (_, i) => at(0.14 + 0.09 * i, i % 2 ? 8 : -8)).join("");
    root.append(titled(`pair ${p.pair}: face ${p.surface} at ${short(p.face)}`, shape(`M${x} ${y}${at(0.1, 0)}${coil}${at(0.9, 0)}${at(1, 0)}`, "coil"),
      line(x - 16, y, x + 16, y, `face-line${through ? " through" : ""}`), line(x - 14, foot, x + 14, foot, "face-line"),
      ...[-10, -3, 4, 11].map((k) => line(x + k, foot, x + k - 5, foot - p.side * 6, "hatch"))));
    root.append(axisWord(x + 16, foot + 2, String(p.pair), "start"));
  }

  /** Draws the contact force as an arrow whose tip is at the beam, on the left of the spring. */
  drawForce(root, p, w, force) {
    if (!(force > 1e-9 * this.most)) return; // not a rounding error
    const [x, y] = [this.page.X(this.nodes[p.at]) - 20, this.page.Y(w) - 3 * p.side];
    const length = p.side * (12 + (30 * force) / this.most);
    root.append(arrow(x, y - length, 0, length, "force"), label(x - 7, y - length / 2 + 8, this.inForce(force), { class: "value halo", "text-anchor": "end" }));
  }

  /** Draws the beam at D + d*, with a bracket for d*, and from each pair a line to its place there. A pair that would
      reach its face on the way has a mark there, in gold if the increment changes its status. */
  drawGhost(root, u) {
    const ghost = this.ghostOf(this.k);
    const { X, Y } = this.page;
    if (!ghost) return;
    root.append(path(shapeOf(this.nodes, ghost).map(([x, w]) => [X(x), Y(w)]), "ghost"));
    this.drawBracket(root, u, ghost);
    for (const p of this.told[this.k].pairs) {
      const at = this.pairs[p.pair - 1];
      const x = X(this.nodes[at.at]);
      const meets = p.s > 0 && p.s < 1;
      const chosen = this.chosen()?.pair === p.pair;
      root.append(line(x, Y(u[2 * at.at]), x, Y(ghost[2 * at.at]), `ray${meets ? " meets" : ""}${chosen ? " chosen" : ""}`));
      if (meets) root.append(svg("circle", { cx: x, cy: Y(at.face), r: 5, class: this.toggledOf(this.k).includes(p.pair) ? "dot gold" : "dot" }));
    }
  }

  /** Draws a bracket from D to D + d* at the pair that is explained, or that is next, or else at the load. */
  drawBracket(root, u, ghost) {
    const { X, Y } = this.page;
    const at = this.pairs[(this.chosen()?.pair ?? this.toggledOf(this.k)[0]) - 1]?.at ?? this.node;
    const [x, from, to] = [X(this.nodes[at]) + 28, Y(u[2 * at]), Y(ghost[2 * at])];
    if (Math.abs(to - from) < 4) return;
    root.append(titled("d*", shape(`M${x - 5} ${from}H${x}V${to}h-5`, "bracket")), label(x + 4, (from + to) / 2 + 4, "d*", { class: "value halo" }));
  }

  chosen() { return this.at < 0 ? null : this.linesOf(this.k)[this.at].pair; }

  /** Draws the s of each pair on a line of its own from 0 to 1, in the order of the pairs. The smallest is s_min; pairs
      that are toggled are gold, as on page 12. */
  drawShares(root) {
    const { left, width, right, height } = this.page;
    const [y, told] = [height - 34, this.told[this.k]];
    const S = (s) => left + s * (width - left - right);
    const row = (pair) => y - 18 * (this.pairs.length - pair);
    for (const { pair } of this.pairs) root.append(line(S(0), row(pair), S(1), row(pair), "zero"), axisWord(S(0) - 12, row(pair) + 4, String(pair), "end"));
    root.append(...[0, 1].map((s) => line(S(s), row(1) - 5, S(s), y + 5, "zero")), axisWord(S(0), y + 22, "s = 0", "start"), axisWord(S(1), y + 22, "s = 1: all the load", "end"));
    const sorted = told.pairs.filter((p) => p.s > 0 && p.s < 1).sort((a, b) => a.s - b.s);
    const toggled = this.toggledOf(this.k);
    for (const [n, p] of sorted.entries()) {
      const [gold, smallest, at] = [toggled.includes(p.pair), p.s === told.s, row(p.pair)];
      const words = `pair ${p.pair}: s = ${p.s}${smallest ? ", the smallest: s_min" : ""}${gold ? ", toggled" : ""}`;
      const dot = svg("circle", { cx: S(p.s), cy: at, r: gold ? 8 : 6, class: gold ? "dot gold" : "dot", tabindex: "0", role: "button", "aria-label": words, "data-s": String(p.s) }, svg("title", {}, words));
      const open = () => {
        this.at = this.linesOf(this.k).findIndex((l) => l.pair?.pair === p.pair);
        this.draw();
        this.picture.querySelectorAll("[data-s]")[n]?.focus();
      };
      dot.addEventListener("click", open);
      dot.addEventListener("keydown", (event) => { if (event.key === "Enter" || event.key === " ") { event.preventDefault(); open(); } });
      const way = p.s > 0.5 ? -1 : 1;
      root.append(label(S(p.s) + 12 * way, at + 4, `${smallest ? "s_min = " : ""}${rough(p.s)}`, { class: `${gold ? "value" : "axis-word"} halo`, "text-anchor": way < 0 ? "end" : "start" }), dot);
    }
  }

  drawLoad(root, u) {
    const { X, Y } = this.page;
    const [x, tip] = [X(this.nodes[this.node]), Y(u[2 * this.node]) - 4];
    const length = (this.page.top - 32) * (0.55 + (0.45 * Math.abs(this.force)) / this.most);
    const share = this.shown === "end" ? Math.sign(-this.force) : this.through ? 1 : this.frames[this.k].share;
    const words = `${this.inForce(this.force)}${this.shown === "path" ? ` · ${rough(100 * share)} %` : ""}`;
    const half = 4 + 4.4 * words.length;
    const inside = Math.max(half, Math.min(x, this.page.width - half));
    root.append(line(x, tip - length, x, tip, "load-rest"), arrow(x, tip - share * length, 0, share * length, "load-arrow"), label(inside, tip - length - 8, words, { "text-anchor": "middle", class: "value halo" }));
    this.addHandle(root, x, tip - length);
  }

  // ---- words ----

  tell(u) {
    if (this.moving) return;
    const told = this.told[this.k];
    const frame = this.frames[this.k];
    let words;
    if (this.through) words = this.throughWords(u);
    else if (this.shown === "end") words = this.force === 0 ? this.question : this.endWords(frame);
    else if (this.overlay) {
      const meeting = told.pairs.filter((p) => p.s > 0 && p.s < 1);
      const next = this.frames[this.k + 1].events ?? [];
      const how = [...new Set(next.map((e) => (e.change === "make" ? "met" : "left")))].join(" or ");
      const after = (frame.events ?? []).map((e) => `The beam ${e.change === "make" ? "meets" : "leaves"} stop ${e.pair}. `).join("");
      words = `${after}The dashed beam is at D + d*; d* is the response to all of the remaining load. ` + (meeting.length === 0 ? `No stop is met or left before the full load: s_min = 1.${this.atFaces(this.ghostOf(this.k), " Under the full load the beam is at ")}`
        : `${sentence(stopsIn(next)).slice(0, -1)} ${next.length > 1 ? "are" : "is"} ${how} next, at ${rough(100 * told.s)} % of the remaining load: s_min = ${rough(told.s)}.`) +
        (next.length > 1 ? ` Their s differ by ${rough(Math.max(...next.map((e) => Math.abs(told.pairs[e.pair - 1].s - told.s))))}.` : "");
    } else words = `${this.endWords(frame)} This is the end of the step; Step begins again.`;
    if (this.words.textContent !== this.note + words) this.words.textContent = this.note + words;
  }

  /** `words` and the stops whose faces the beam reaches without force; empty if there are none. */
  atFaces(u, words) {
    const reached = this.pairs.filter((p) => Math.abs(p.face - u[2 * p.at]) < 1e-9 * this.deep);
    return reached.length === 0 ? "" : `${words}${stopsIn(reached)}, without force.`;
  }

  endWords(frame) {
    const pressed = this.pairs.filter((_, i) => frame.force[i] > 1e-9 * this.most);
    return `Under ${this.inForce(this.force)} the beam is ${this.inLength(frame.u[2 * this.node])} down at the load; ` +
      (pressed.length > 0 ? `it presses on ${pressed.map((p) => `stop ${p.pair} with ${this.inForce(frame.force[p.pair - 1])}`).join(", ")}.`
        : this.atFaces(frame.u, "it is at ") || "it touches no stop.");
  }

  throughWords(u) {
    const beyond = this.pairs.map((p) => ({ ...p, by: -p.side * (p.face - u[2 * p.at]) })).filter(({ by }) => by > 1e-9 * this.deep);
    const deepest = [...beyond].sort((a, b) => b.by - a.by)[0];
    return deepest ? `Without s_min the beam goes through ${stopsIn(beyond)}${beyond.length > 1 ? `; it is farthest beyond the face of stop ${deepest.pair}, by` : ":"} ${this.inLength(deepest.by)}. s_min prevents this.`
      : "Without s_min nothing is different here: no stop is in the way.";
  }

  /** Shows the next line of the listing, with the values that are known before it. */
  showLine() {
    const lines = this.overlay ? this.linesOf(this.k) : [];
    const now = lines[this.at];
    this.inside.hidden = !now;
    this.holder.classList.toggle("stepping", Boolean(now));
    for (const item of this.listing) item.classList.remove("ran");
    for (const [name, made] of Object.entries(this.buttons)) made.disabled = (name === "undo" && this.history.at === 0) || (name === "redo" && this.history.at + 1 === this.history.texts.length);
    this.buttons.ignore.setAttribute("aria-pressed", String(this.through !== null));
    this.buttons.back.disabled = this.shown === "end" || (this.at < 0 && this.k === 0);
    if (document.activeElement !== this.field) this.field.value = String(Math.abs(this.force));
    if (!now) return;
    const item = this.listing[now.line - 1];
    item.classList.add("ran");
    this.lines.scrollTop = item.offsetTop - 80;
    const { pair } = now;
    const setBy = pair?.s_chk !== undefined ? 36 : pair?.d_star === 0 ? 32 : 38; // the line that sets the final SS
    const known = pair ? [["GAP", pair.gap, 30], ["DTEST", pair.d_star, 31], ["SSCHK", pair.s_chk, 35], ["SS", pair.s, setBy], ["DIFF", pair.diff, 51]].filter(([, value, from]) => value !== undefined && value !== null && now.line >= from) : [];
    const smin = now.line >= 42 ? [["SMIN", this.told[this.k].s, 42]] : [];
    const here = [...known, ...smin].find(([, , from]) => from === now.line);
    item.dataset.value = here ? `${here[0]} = ${digits(here[1], 6)}` : "";
    const code = this.beside?.[now.line];
    this.values.replaceChildren(element("dt", {}, pair ? `I = ${pair.pair}` : ""), element("dd", {}, `Line ${now.line}: ${now.words}`),
      ...[...known, ...smin].flatMap(([name, value]) => [element("dt", {}, name), element("dd", { "data-value": String(value), title: String(value) }, digits(value, 6))]),
      ...(code ? [element("dt", {}, "In C++"), element("dd", {}, element("code", {}, code))] : []));
  }
}
