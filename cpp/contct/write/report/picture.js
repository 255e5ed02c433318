// Draws the structure in one state of a result: moved nodes, with pairs, supports and loads; below a beam, moments and
// shears; on a plate, a quantity in colours. The playground uses this file too.
"use strict";

// ---- words and numbers ----

const minus = (text) => text.replace(/-/g, "\u2212");
const digits = (x, count) => minus(String(Number(x.toPrecision(count))));
// Seven digits. Cells of tables have the whole number in their title and in data-value.
const short = (x) => (x === null || x === undefined ? "–" : digits(x, 7));
const rough = (x) => digits(x, 4);
const counted = (n, what) => `${n.toLocaleString("en")} ${what}${n === 1 ? "" : "s"}`;
const sentence = (text) => (/^contct /.test(text) ? text : text[0].toUpperCase() + text.slice(1)) + "."; // a command keeps its case
// The word for a displacement: "deflection" of a node, or "displacement" of a dof of a matrix.
const moves = () => (ofMatrix ? "displacement" : "deflection");
const unitOf = () => (ofMatrix ? "dof" : "node");
const placed = (name) => `${unitOf()} ${name}`;

// The unit of a quantity of the result, or else of the input, from its powers of force and length; empty if the problem
// names no units. Loads and beds of a beam are per length, not per area.
const powers = { w: [0, 1], force: [1, 0], couple: [1, 1], load: [1, -2], modulus: [1, -3], stiffness: [1, -1], EI: [1, 2], GA: [1, 0], E: [1, -2], G: [1, -2], I: [0, 4],
  W: [0, 3], A: [0, 2], As: [0, 2], weight: [1, -3] };
const ofElements = ["EI", "GA"];  // numbers of each element of a beam
const quantityOf = (key) => result.quantities.find((q) => q.key === key);
function unit(key) {
  if (!result.units) return "";
  if (quantityOf(key)) return quantityOf(key).unit.replace(/\^(\d)/g, (_, n) => "⁰¹²³⁴"[n]).replaceAll(" ", "\u00a0");
  const { length, force } = result.units;
  if (!(key in powers)) return "";
  const [f, per] = powers[key];
  const l = per + (isBeam() && ["load", "modulus"].includes(key) ? 1 : 0);
  const of = l === 0 ? "" : length + ["", "", "²", "³", "⁴"][Math.abs(l)];
  return f === 0 ? of : force + (l === 0 ? "" : l > 0 ? "\u00a0" : "/") + of;
}
const inUnit = (name, quantity) => name + (unit(quantity) ? ` [${unit(quantity)}]` : "");

// The place of an extreme value in words: a node or dof, or the x between two nodes of a beam.
function placeOf(v) {
  const name = v.name ? `${v.name}, ` : "";
  if (v.dof !== undefined) return name + placed(v.dof);
  const node = structure.nodes.find((n) => n.x === v.x && (v.y === undefined || n.y === v.y));
  const at = v.y === undefined ? `x = ${rough(v.x)}` : `(${rough(v.x)}, ${rough(v.y)})`;
  return name + (node === undefined ? at : `${placed(node.node)}, ${at}`);
}
// The one of `min` and `max` with the larger magnitude (of equal ones `max`), then the other one if their signs differ.
function toldOf({ min, max }) {
  const [first, second] = -min.value > (1 + 1e-9) * max.value ? [min, max] : [max, min];
  return second.value * first.value < -1e-9 * first.value ** 2 ? [first, second] : [first];
}
const largestOf = (range) => toldOf(range)[0];
// The largest deflection, which may be inside an element of a beam.
const mostOf = (f) => (f.extremes.w ? largestOf(f.extremes.w) : { value: 0, ...(ofMatrix ? structure.dofs[0] : structure.nodes[0]) });

const looks = { o: "separated", c: "in contact", f: "at its face" };
const lookWords = (p) => (p.look === "f" ? `at its face, ${p.closed ? "in contact" : "separated"}` : looks[p.look]);
const pairWords = (p) => `Pair ${labelled(p.pair, p.label)}, ${placed(p.name)}, face ${p.surface} at ${short(p.face)}, ${lookWords(p)}: ` +
  (p.closed ? `force ${short(p.force)}` : `gap ${short(p.gap)}`);
const supportWords = (f, s) => `Support ${labelled(`at ${placed(s.name)}`, s.label)}: ${ofMatrix ? "" : `${s.dof} `}` +
  `${s.spring === null ? "fixed" : `on a spring of ${short(s.spring)}`}; reaction ${short(f.reactions[s.number])}`;
const eventWords = (e) => `pair ${labelled(e.pair, e.name)} ${e.change === "make" ? "makes" : "breaks"} contact (${placed(nameOf(e))}, ${e.surface})`;

const allEventWords = (events, most = 8) => [...events.slice(0, most).map(eventWords), ...(events.length > most ? [`and ${events.length - most} more`] : [])].join("; ");

// A state in words. Screen readers read the words aloud when the state changes.
function stateWords(f) {
  const [open, closed, atFace] = ["o", "c", "f"].map((look) => f.pairs.filter((p) => p.look === look).length);
  const place = f.step === 0 ? "Before any load."
    : `Step ${nameOfStep(f.step)}${f.number > 0 ? `, increment ${f.number}` : ""}: ${f.snap ? "a rigid-body motion at constant load; " : ""}` +
      `load: ${minus(f.load.words)}, share ${short(f.fraction)} of the step.`;
  const end = !f.end ? "" : f.fraction < 1 ? " The path ends here." : " The step's load is applied.";
  const event = f.events.length > 0 ? ` Then ${allEventWords(f.events, 3)}.` : end;
  const fallback = f.exact ? " This state is the end of the exact path: the path in doubles could not reach it."
    : f.from_fallback ? " This state is the reference solution: the path could not reach it." : "";
  const pairs = f.pairs.length === 0 ? " There are no contact pairs."
    : ` ${counted(closed, "pair")} in contact, ${open} separated, ${atFace} at ${atFace === 1 ? "its face" : "their faces"}.`;
  return `${place}${event}${fallback}${pairs} Largest ${moves()} ${short(mostOf(f).value)} at ${placeOf(mostOf(f))}.`;
}

// ---- a selection of many things ----

const cuts = new Set();  // sentences that tell what the page leaves out

// `count` evenly chosen numbers from 0 to `all` - 1, with the first and the last; all if there are at most `count`.
const evenly = (all, count) => Array.from({ length: Math.min(all, count) }, (_, i) => (all <= count ? i : Math.floor((i * (all - 1)) / (count - 1))));

function some(what, all, most) {
  if (all > most) cuts.add(`${most} of ${all} ${what} are drawn, evenly chosen. The largest values cover all ${what}.`);
  return evenly(all, most);
}

// ---- SVG ----

const svg = (name, attributes = {}, ...children) => filled(document.createElementNS("http://www.w3.org/2000/svg", name), attributes, children);
const line = (x1, y1, x2, y2, kind) => svg("line", { x1, y1, x2, y2, class: kind });
const label = (x, y, words, attributes = {}) => svg("text", { x, y, ...attributes }, words);
const axisWord = (x, y, words, anchor = "middle") => label(x, y, words, { "text-anchor": anchor, class: "axis-word" });
const panelTitle = (x, y, words) => label(x, y, words, { class: "panel-title" });
const shape = (d, kind, more = {}) => svg("path", { d, class: kind, ...more });
const lineTo = (points) => "M" + points.map(([x, y]) => `${x.toFixed(2)} ${y.toFixed(2)}`).join("L");
const path = (points, kind, end = "") => shape(lineTo(points) + end, kind);
// Shapes that show `words` when the pointer is over them.
const titled = (words, ...shapes) => svg("g", {}, svg("title", {}, words), ...shapes);

function canvas(holder, width, height, title) {
  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "img", "aria-label": title });
  holder.replaceChildren(root);
  return root;
}

// On paper, pictures have a fixed width, at which their words are as large as the text of the page.
let printing = false, widthOnPaper = 940;
const widthOf = (holder) => (printing ? widthOnPaper : Math.max(320, holder.clientWidth));

// The largest number not above x that is one of `leading` times a power of ten.
function roundDown(x, leading = [1, 2, 5]) {
  const power = 10 ** Math.floor(Math.log10(x));
  return Number((Math.max(...leading.filter((d) => d * power <= x * (1 + 1e-12)), 1) * power).toPrecision(3));
}
// The least number not below x that is 1, 2 or 5 times a power of ten.
const roundUp = (x, low = roundDown(x)) => (low >= x * (1 - 1e-12) ? low : roundDown(2.5 * low));
// A round magnification at which displacements up to `most` fit into `room`.
const magnificationFor = (most, room) => (most > 0 && room > 0 ? roundDown(room / most, [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8]) : 1);
const timesWords = (factor) => `× ${factor.toLocaleString("en", { maximumSignificantDigits: 3 })}`;

// About `most`, but at least three, round numbers from `from` to `to`.
function ticks(from, to, most) {
  if (!(to > from) || !isFinite(to - from)) return [];
  const multiples = (step) => {
    const list = [];
    for (let i = Math.ceil(from / step - 1e-9); i * step <= to + step * 1e-9; ++i) list.push(i * step);
    return list;
  };
  let step = roundUp((to - from) / Math.max(1, most));
  while (multiples(step).length < 3) step = roundDown(0.99 * step);
  return multiples(step);
}

// Draws grid lines with their numbers on the left (scaleUp) or at the bottom (scaleAlong).
function scaleUp(root, values, Y, left, right, away = 16) {
  for (const v of values) root.append(line(left, Y(v), right, Y(v), v === 0 ? "zero" : "grid"), axisWord(left - away, Y(v) + 4, rough(v), "end"));
}
function scaleAlong(root, values, X, bottom, top = bottom + 5) {
  for (const v of values) root.append(line(X(v), top, X(v), bottom, v === 0 || top > bottom ? "zero" : "grid"), axisWord(X(v), bottom + 19, rough(v)));
}

function arrow(x, y, dx, dy, kind) {
  const length = Math.hypot(dx, dy);
  if (length < 1) return svg("g");
  const [ux, uy] = [dx / length, dy / length];
  const head = Math.min(8, length);
  const [bx, by] = [x + dx - ux * head, y + dy - uy * head];
  return svg("g", { class: kind }, shape(`M${x} ${y}L${bx} ${by}`, "", { fill: "none" }),
    shape(`M${x + dx} ${y + dy}L${bx - uy * 4} ${by + ux * 4}L${bx + uy * 4} ${by - ux * 4}Z`, "", { "stroke-width": 0 }));
}

// Draws the mark of a pair: a ring if separated, a square if in contact; at its face a diamond, filled if in contact.
function pairMark(look, x, y, r, closed = false) {
  if (look === "o") return svg("circle", { cx: x, cy: y, r, class: "pair-open" });
  if (look === "c") return svg("rect", { x: x - r, y: y - r, width: 2 * r, height: 2 * r, class: "pair-closed" });
  const d = r * 1.3;
  return shape(`M${x} ${y - d}L${x + d} ${y}L${x} ${y + d}L${x - d} ${y}Z`, closed ? "pair-face in-contact" : "pair-face");
}

// Places around a word's own place, nearest first.
const placesNear = [[0, 0], ...Array.from({ length: 12 }, (_, r) => [[0, 1], [0, -1], [1, 0], [-1, 0], [1, 1], [-1, 1], [1, -1], [-1, -1]].map(([x, y]) => [18 * x * (r + 1), 9 * y * (r + 1)])).flat()];

// Returns a function that writes a word if its place in the picture, to the right of `left`, is free. Otherwise it writes
// the words `elsewhere`, if they are given, at the nearest free place, with a line to their own.
function wordsInFreePlaces(root, width, height, left = 2) {
  const boxes = [];
  const put = (at, y, words, kind) => {
    const half = 4.4 * words.length + 2;
    const x = Math.min(Math.max(at, left + half), width - 2 - half);
    const box = [x - half, y - 13, x + half, y + 5];
    if (box[1] < 24 || box[3] > height - 4 || !boxes.every((b) => b[0] >= box[2] || b[2] <= box[0] || b[1] >= box[3] || b[3] <= box[1])) return false;
    boxes.push(box);
    root.append(label(x, y, words, { "text-anchor": "middle", class: `${kind} halo` }));
    return true;
  };
  return (at, y, words, kind, elsewhere = null) => {
    if (put(at, y, words, kind) || elsewhere === null) return;
    const [dx, dy] = placesNear.find(([x, up]) => put(at + x, y + up, elsewhere, kind)) ?? [0, 0];
    if (Math.hypot(dx, dy) > 20) root.lastChild.before(line(at, y - 4, at + dx, y + dy - 4, "was"));
  };
}

// ---- pairs, supports and loads ----
//
// The argument `on` tells where and how large pairs, supports and loads are drawn; p is one of them. on.spot(p): the
// point of the moved node on the page. on.along(p): the positive direction of the dof, of length 1; null if the dof has
// no direction on the page. on.pixels(p): pixels for a displacement of 1 in that direction. on.say: see
// wordsInFreePlaces. on.r: size of a mark. on.half: half the length of a face. on.limit: the largest distance at which
// a face is drawn from its undeformed node.

let drawnPairs = [], drawnSupports = [];
const pairsOf = (f) => drawnPairs.map((i) => f.pairs[i]).filter((p) => p.at >= 0);

// A node may have several pairs. The mark of the pair with the largest force is drawn last, on top.
const drawingOrder = { o: 0, f: 1, c: 2 };
const leastLoadedFirst = (pairs) => [...pairs].sort((a, b) => drawingOrder[a.look] - drawingOrder[b.look] || Math.abs(a.force) - Math.abs(b.force));

const hasForce = (p) => p.look === "c" || Math.abs(p.force) > 1e-6 * scene.force;
// The pairs whose numbers are written: all, those that are not of a bed, or those of them that have a force.
const numberedOf = (pairs, own = pairs.filter((p) => !p.bed)) => [pairs, own, own.filter(hasForce)].find((some) => some.length <= 60) ?? [];

// Inside a plate's bed in colours, only pairs at the border of the contact are drawn, small.
function bordersContact(f) {
  const looks = new Map(f.pairs.filter((p) => p.bed).map((p) => [p.at, p.look]));
  const across = structure.columns;
  return (p) => {
    const beside = [-1, 1].map((d) => p.at + d).filter((at) => Math.floor(at / across) === Math.floor(p.at / across));
    const around = [...beside, p.at - across, p.at + across].filter((at) => looks.has(at));
    return !p.bed || around.length < 3 || around.some((at) => looks.get(at) !== p.look);
  };
}

function drawPairs(root, all, on) {
  const pairs = all.filter(on.isShown);
  const marks = [];
  const numbered = new Set(numberedOf(all));
  const isDense = numbered.size < all.length;
  const few = [...numbered].filter(hasForce).length <= 12;
  for (const p of leastLoadedFirst(pairs)) {
    const [[x, y], t] = [on.spot(p), on.along(p)];
    if (p.otherAt >= 0 && p.otherAt !== p.at) root.append(line(...on.spot({ ...p, at: p.otherAt, u: p.otherU }), x, y, "thin"));
    const isSmall = (on.isSketch || field) && p.bed && !numbered.has(p);
    const [ofNumber, ofForce] = t === null || isSmall ? [[x + 13, y - 12], [x + 13, y + 6]] : drawFace(root, p, [x, y], t, on);
    const words = rough(p.force);
    if (numbered.has(p)) on.say(ofNumber[0], ofNumber[1] + 4, p.label ?? String(p.pair), isDense ? "value" : "axis-word", isDense && numbered.size <= 12 ? p.label ?? String(p.pair) : null);
    if (numbered.has(p) && hasForce(p)) on.say(ofForce[0], ofForce[1] + 4, words, "value", few ? `${p.label ?? p.pair}: ${words}` : null);
    const mark = pairMark(p.look, x, y, isSmall ? 1.6 : !p.bed && hasBed() ? Math.max(6, on.r + 2) : on.r, p.closed);
    mark.append(svg("title", {}, pairWords(p)));
    marks.push(mark);
  }
  root.append(...marks);
}

// Draws the face of a pair across the direction of its dof, at its distance from the undeformed node, hatched on the
// far side; nearer and dashed if this distance is above on.limit. A face in contact is drawn at the moved node, with a
// line for its spring from the undeformed face, and an arrow for the contact force.
function drawFace(root, p, [x, y], t, on) {
  const node = on.pixels(p) * p.w;
  const along = on.pixels(p) * p.face;
  const face = p.closed ? node : Math.max(-on.limit, Math.min(on.limit, along));
  const at = (a, across = 0) => [x + (a - node) * t[0] - across * t[1], y + (a - node) * t[1] + across * t[0]];
  const { half } = on;
  root.append(line(...at(face, -half), ...at(face, half), "face-line" + (p.closed || face === along ? "" : " far")));
  if (half >= 5) for (let k = -half + 2; k < half; k += 6) root.append(line(...at(face, k), ...at(face + p.side * 6, k - 4), "hatch"));
  if (p.closed && Math.abs(along - node) > 3) root.append(line(...at(along, -half), ...at(along, half), "spring"), line(...at(along), x, y, "spring"));
  // The arrow starts outside the hatches and the mark of the node.
  const tip = p.side > 0 ? Math.max(face + 10, node + on.r + 3) : Math.min(face - 10, node - on.r - 3);
  const length = scene.force > 0 ? (36 * Math.abs(p.force)) / scene.force : 0;
  const start = tip + p.side * length;
  if (p.force > 0) root.append(arrow(...at(start), -p.side * length * t[0], -p.side * length * t[1], "force"));
  return [at(start + p.side * 11), at(start + p.side * 30)];
}

function supportMark([x, y], t, spring) {
  const at = (along, across) => `${(x - along * t[0] + across * t[1]).toFixed(1)} ${(y - along * t[1] - across * t[0]).toFixed(1)}`;
  if (drawnSupports.length > 40) return shape(`M${at(4, 0)}L${at(spring === null ? 14 : 9, 0)}`, spring === null ? "support" : "thin");
  if (spring === null) return shape(`M${at(2, 0)}L${at(16, 8)}L${at(16, -8)}Z`, "support");
  return shape(`M${at(2, 0)}L${at(4, 5)}L${at(8, -5)}L${at(12, 5)}L${at(16, -5)}L${at(18, 0)}M${at(18, 8)}L${at(18, -8)}`, "thin");
}

// A support without a direction on the page, such as a support of a slope, is drawn as a box around its node.
function drawSupports(root, f, on) {
  for (const s of drawnSupports.filter(({ at }) => at >= 0)) {
    const [[x, y], t] = [on.spot(s), on.along(s)];
    root.append(titled(supportWords(f, s), t === null ? svg("rect", { x: x - 6, y: y - 6, width: 12, height: 12, class: "thin" }) : supportMark([x, y], t, s.spring)));
    const reaction = f.reactions[s.number];
    if (t === null || drawnSupports.length > 40 || (reaction === 0 && !s.label)) continue;
    const words = reaction === 0 ? s.label : s.label ? `${s.label}: ${rough(reaction)}` : rough(reaction);
    on.say(x - 36 * t[0], y - 36 * t[1] + 4, words, "value reaction-value");
  }
}

// Draws concentrated forces as arrows and moments as arcs; forces perpendicular to the page are rings.
function drawPoints(root, f, on) {
  const loads = pointsOf(f).filter(({ at, value }) => at >= 0 && value !== 0);
  for (const p of some("loads", loads.length, 1000).map((i) => loads[i])) {
    const [[x, y], t] = [on.spot(p), on.along(p)];
    const words = `Load ${short(p.value)} at ${p.between ? `x = ${digits(p.x, 6)}` : placed(p.name)}`;
    if (t === null) {
      const turns = p.direction > 3;
      const arc = turns ? `M${x + 13} ${y + 7}A15 15 0 1 1 ${x + 13} ${y - 7}` : `M${x - 8} ${y}a8 8 0 1 1 16 0a8 8 0 1 1 -16 0`;
      root.append(titled(words, shape(arc, "load-line", { "stroke-width": 2 })));
      on.say(x, y - 20, `${rough(p.value)}${!turns ? "" : p.value > 0 ? " ↺" : " ↻"}`, "value");
      continue;
    }
    const size = (42 * p.value) / scene.point;
    const away = size + (size > 0 ? 8 : -8);
    root.append(titled(words, arrow(x - away * t[0], y - away * t[1], size * t[0], size * t[1], "load")));
    const beyond = away + (size > 0 ? 11 : -11);
    on.say(x - beyond * t[0], y - beyond * t[1] + 4, rough(p.value), "value");
  }
}

// ---- beams ----

const isBeam = () => structure.kind === "beam";

// Places along the beam, at nodes and between nodes, as [element, share of the element].
function placesAlong() {
  const stations = scene.lines[0];
  const pieces = stations.length < structure.nodes.length ? 1 : Math.ceil(240 / stations.length);
  return [...stations.slice(0, -1).flatMap((e) => Array.from({ length: pieces }, (_, k) => [e, k / pieces])), [structure.nodes.length - 2, 1]];
}

const xAt = ([e, share], [from, to] = [structure.nodes[e].x, structure.nodes[e + 1].x]) => (share === 1 ? to : from + share * (to - from));

// Draws the distributed load above or below the beam, to scale.
function drawLineLoad(root, f, { X, Y, ends }) {
  const load = lineLoadOf(f);
  if (load === null || scene.lineLoad === 0) return;
  const spot = (e, x) => {
    const size = (25 * load(e, x)) / scene.lineLoad;
    return { x: X(x), y: Y(valueAt(f, "w", x, e)) + (size > 0 ? 8 : -8), size };
  };
  const pieces = [];
  placesAlong().forEach(([e, a], i, all) => {
    if (i + 1 === all.length) return;
    const [next, share] = all[i + 1];
    const [from, to] = [spot(e, xAt([e, a])), spot(e, xAt([e, next === e ? share : 1]))];
    if (from.size !== 0 || to.size !== 0) pieces.push(lineTo([[from.x, from.y + from.size], [to.x, to.y + to.size]]));
  });
  root.append(shape(pieces.join(""), "load-line"));
  const arrows = Math.ceil((X(ends[1]) - X(ends[0])) / 34);
  for (let i = 0; i < arrows; ++i) {
    const x = ends[0] + ((i + 0.5) / arrows) * (ends[1] - ends[0]);
    const at = spot(elementAt(x), x);
    if (Math.abs(at.size) > 3) root.append(arrow(at.x, at.y + at.size, 0, -at.size, "load"));
  }
}

// Draws scale, title and the values `told` of a strip, a diagram along the beam; returns the vertical scale.
function scaleOfStrip(root, { X, ends: [x0, x1] }, top, name, title, [low, high], told) {
  const height = 126;
  const Y = (v) => top + 24 + ((high - v) / (high - low || 1)) * (height - 34);
  scaleUp(root, [...new Set([0, ...ticks(low, high, 4)])], Y, X(x0), X(x1));
  for (const v of told) root.append(svg("circle", { cx: X(v.x), cy: Y(v.value), r: 3, class: "dot-" + name }));
  const words = told.slice(0, X(x1) < 600 ? 1 : 2).map((v) => `${digits(v.value, 5)} at x = ${digits(v.x, 5)}`);
  root.append(panelTitle(X(x0), top + 12, title), label(X(x1), top + 12, words.join("; "), { "text-anchor": "end", class: "value" }));
  return Y;
}

function drawPressure(root, f, page, top) {
  const { key: name } = result.quantities.find(({ key, on }) => on === "nodes" && f[key]);
  const at = f[name];
  const nodes = structure.nodes.map(({ x }, i) => ({ x, value: at[i] }));
  const most = largestBy(nodes, "value");
  const Y = scaleOfStrip(root, page, top, name, inUnit(page.width < 620 ? "p" : "Bed's pressure", name), spread([0, ...frames.flatMap((g) => spread(g[name]))]), most.value === 0 ? [] : [most]);
  const points = scene.lines[0].map((i) => [page.X(nodes[i].x), Y(at[i])]);
  root.append(path([[points[0][0], Y(0)], ...points, [points[points.length - 1][0], Y(0)]], `${name}-area`, "Z"), path(points, name));
}

// Draws a strip with moment or shear, which may jump at the nodes.
function drawStrip(root, f, page, top, name, title) {
  const { X, ends: [x0, x1] } = page;
  const range = f.extremes[name] || { min: { value: 0, x: x0 }, max: { value: 0, x: x0 } };
  const told = toldOf(range);
  const Y = scaleOfStrip(root, page, top, name, title, rangeOf(name), told);
  const points = placesAlong().flatMap(([e, a], i) => {
    const here = [X(xAt([e, a])), Y(valueAt(f, name, xAt([e, a]), e))];
    return i === 0 || a !== 0 ? [here] : [[here[0], Y(valueAt(f, name, structure.nodes[e].x, e - 1))], here];
  });
  // Jumps inside elements, and extremes, may be between these points.
  const jumps = besidePieces(f, name);
  const known = new Set([...structure.nodes.map((n) => n.x), ...jumps.map(([x]) => x)]);
  for (const [at, value] of [...jumps, ...[range.min, range.max].filter((v) => !known.has(v.x)).map((v) => [v.x, v.value])]) {
    const after = points.findIndex(([x]) => x > X(at));
    if (after > 0) points.splice(after, 0, [X(at), Y(value)]);
  }
  root.append(path([[X(x0), Y(0)], ...points, [X(x1), Y(0)]], name + "-area", "Z"), path(points, name));
}

const hasBed = () => places.pairs.some((p) => p.bed);

function drawBeam(root, f, page, isSketch) {
  const { X, Y, ends, bottom, width } = page;
  root.append(path(placesAlong().map((at) => [X(xAt(at)), Y(valueAt(f, "w", xAt(at), at[0]))]), "member"));
  for (const node of structure.hinges || [])
    root.append(svg("circle", { cx: X(structure.nodes[node - 1].x), cy: Y(f.u[2 * node - 2]), r: 4, class: "hinge" }));
  drawLineLoad(root, f, page);
  if (!isSketch) scaleUp(root, ticks(...page.heights.map((y) => y / scene.times), Math.min(4, (bottom - 196) / 30)), Y, X(ends[0]), X(ends[1]));
  root.append(line(X(ends[0]), bottom, X(ends[1]), bottom, "zero"));
  scaleAlong(root, ticks(...ends, Math.floor(width / 75)), X, bottom);
  if (isSketch) return;
  const titles = width < 620 ? ["M", "V"] : ["Moment, positive where it sags", "Shear, of the left part on the right part"];
  Object.keys(f.elements[0].pieces[0]).slice(2).forEach((name, i) => drawStrip(root, f, page, bottom + 36 + 140 * i, name, inUnit(titles[i], name)));
  if (hasBed()) drawPressure(root, f, page, bottom + 316);
}

// Writes the value of each constant distributed load at its middle.
function sayLineLoads(f, { X, Y }, say, { nodes } = structure) {
  for (const { value, elements, from, to } of (f.load.uniform || []).filter((part) => part.value)) {
    const has = elements && numbersIn(elements);
    const spans = !elements ? [[from, to]] : runsOf(nodes.slice(1).map((_, e) => has(e + 1))).filter(([e]) => has(e + 1)).map(([first, last]) => [nodes[first].x, nodes[last + 1].x]);
    for (const [x0, x1] of spans) say(X((x0 + x1) / 2), Y(0) + (value > 0 ? 58 : -42), inUnit(rough(value), "load"), "value");
  }
}

// ---- plates ----

let fields = [];    // the quantities of a plate that can be shown
let field = null;   // the quantity that is shown

// The quantities of a plate, with levels that are the same in all states: deflection, pressure of beds, and those of elements.
const fieldsOf = () => result.quantities.filter(({ key, on }) => on === "element_ends" || (on === "nodes" && (key === "w" || frames[0][key]))).map(({ key: name, words, unit: of }) => {
  const [low, high] = spread(frames.flatMap((f) => spread(atNodes(f, name))));
  const step = high > low ? roundDown(((high - low) / 9) * 1.3, [1, 2, 2.5, 5]) : 1;
  const base = Math.floor(low / step + 1e-9);
  return { name, words, unit: of, step, level: (i) => (base + i) * step, bands: Math.max(1, Math.ceil(high / step - 1e-9) - base) };
});

// A quantity at each node; of a quantity of elements, the mean in the elements at the node.
function atNodes(f, name) {
  if (name === "w") return structure.nodes.map((_, i) => f.u[3 * i]);
  if (f[name]) return f[name];
  const [sum, met] = [0, 0].map(() => structure.nodes.map(() => 0));
  const across = structure.columns - 1;
  f.elements.forEach((e, i) => {
    const first = Math.floor(i / across) * structure.columns + (i % across);
    [first, first + 1, first + structure.columns + 1, first + structure.columns].forEach((node, corner) => { sum[node] += e[name][corner]; ++met[node]; });
  });
  return sum.map((s, i) => (met[i] > 0 ? s / met[i] : 0));
}

// The colour of band `i`, from dark brown (lowest values) to pale. Brightness increases steadily, for grey prints.
function bandColour(i) {
  const share = field.bands > 1 ? i / (field.bands - 1) : 0.5;
  const stops = [[132, 74, 28], [186, 118, 58], [219, 165, 104], [238, 209, 163], [252, 246, 230]];
  const at = share * (stops.length - 1);
  const k = Math.min(stops.length - 2, Math.floor(at));
  return `rgb(${stops[k].map((c, j) => Math.round(c + (stops[k + 1][j] - c) * (at - k))).join(",")})`;
}

// The value at a share x and y of a cell whose corners are counter-clockwise, by bilinear interpolation.
const withinCell = ([a, b, c, d], read, x, y) => (read(a) * (1 - x) + read(b) * x) * (1 - y) + (read(d) * (1 - x) + read(c) * x) * y;

// A place of a plate on the page, between `spots` of the nodes.
function onPlate(spots, x, y) {
  const { nodes, columns } = structure;
  const cellAt = (all, v) => { const i = Math.max(0, Math.min(all.length - 2, all.findLastIndex((from) => from <= v))); return [i, (v - all[i]) / (all[i + 1] - all[i])]; };
  const [[i, a], [j, b]] = [cellAt(nodes.slice(0, columns).map((n) => n.x), x), cellAt(nodes.filter((_, k) => k % columns === 0).map((n) => n.y), y)];
  const first = j * columns + i;
  return [0, 1].map((k) => withinCell([first, first + 1, first + columns + 1, first + columns], (node) => spots[node][k], a, b));
}

// The rectangles of a distributed load on a plate, as two corners.
function rectanglesOf({ elements, from, to }) {
  if (!elements) return [[from, to]];
  const [{ nodes, columns }, has, found] = [structure, numbersIn(elements), []];
  for (let row = 0, below; (row + 1) * columns < nodes.length; ++row) {
    const loaded = nodes.slice(1, columns).map((_, i) => has(row * (columns - 1) + i + 1));
    for (const [first, last] of runsOf(loaded).filter(([i]) => loaded[i])) {
      const [a, b] = [nodes[row * columns + first], nodes[(row + 1) * columns + last + 1]].map(({ x, y }) => [x, y]);
      if ((below = found.find(([p, q]) => p[0] === a[0] && q[0] === b[0] && q[1] === a[1]))) below[1] = b;
      else found.push([a, b]);
    }
  }
  return found;
}

// Outlines the distributed loads, and the moments over areas, on a plate. The sum of the loads on a rectangle is written
// in it, or at the edge of the plate if the rectangle is the whole plate.
function drawAreaLoads(root, f, spots, say) {
  const ofMoments = (f.load.moments || []).flatMap((m) => ["wx", "wy"].filter((dof) => m[dof]).map((dof) => ({ at: [m.from, m.to], value: m[dof], dof })));
  const groups = groupsOf([...(f.load.uniform || []).flatMap((part) => rectanglesOf(part).map((at) => ({ at, value: part.value }))), ...ofMoments], ({ at, dof }) => `${at} ${dof}`);
  const plate = String(rectanglesOf({ elements: "all" })[0]);
  for (const [{ at, dof }, sum] of groups.map((parts) => [parts[0], parts.reduce((total, { value }) => total + value, 0)])) {
    const [[x0, y0], [x1, y1]] = at;
    const corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
    const outline = corners.flatMap(([x, y], k) => Array.from({ length: 24 }, (_, n) => onPlate(spots, ...[x, y].map((v, axis) => v + (corners[(k + 1) % 4][axis] - v) * (n / 24)))));
    const [isWhole, words] = [String(at) === plate, dof ? inUnit(`${dof} ${rough(sum)}`, "couple") : inUnit(rough(sum), "load")];
    const [x, y] = onPlate(spots, (x0 + x1) / 2, isWhole ? y0 : (y0 + y1) / 2);
    root.append(titled(`Load ${words}`, shape(lineTo(outline) + "Z", "load-line", { style: "stroke-width: 2.4" })));
    say(x, y + (isWhole ? 26 : 4), words, "value", groups.length <= 12 ? words : null);
  }
}

// Colours each cell of the drawn grid in small parts of one colour, by bilinear interpolation.
function drawColours(root, f, spots) {
  const [columns, rows] = scene.lines;
  const values = atNodes(f, field.name);
  const parts = Math.ceil(48 / Math.max(columns.length, rows.length));
  const bands = Array.from({ length: field.bands }, () => []);
  for (const [j, i] of rows.slice(1).flatMap((_, j) => columns.slice(1).map((_, i) => [j, i]))) {
    const cell = [[j, i], [j, i + 1], [j + 1, i + 1], [j + 1, i]].map(([y, x]) => rows[y] * structure.columns + columns[x]);
    for (let part = 0; part < parts * parts; ++part) {
      const [x, y] = [part % parts, Math.floor(part / parts)];
      const value = withinCell(cell, (node) => values[node], (x + 0.5) / parts, (y + 0.5) / parts);
      const band = Math.max(0, Math.min(field.bands - 1, Math.floor((value - field.level(0)) / field.step)));
      const corners = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]].map(([p, q]) => [0, 1].map((k) => withinCell(cell, (node) => spots[node][k], p / parts, q / parts)));
      bands[band].push(lineTo(corners) + "Z");
    }
  }
  bands.forEach((d, i) => { if (d.length > 0) root.append(svg("path", { d: d.join(""), fill: bandColour(i), stroke: bandColour(i), "stroke-width": 0.7 })); });
}

// Marks the largest value of the shown quantity, and the largest of the other sign, as tables have them.
function markLargest(root, f, spots, say) {
  const values = atNodes(f, field.name).map((value, i) => ({ value, x: structure.nodes[i].x, y: structure.nodes[i].y }));
  const range = f.extremes[field.name] ?? { min: values.reduce((a, b) => (b.value < a.value ? b : a)), max: values.reduce((a, b) => (b.value > a.value ? b : a)) };
  for (const { value, x, y } of toldOf(range)) {
    const at = onPlate(spots, x, y);
    root.append(svg("circle", { cx: at[0], cy: at[1], r: 4, class: "dot-w" }));
    say(at[0], at[1] - 10, rough(value), "value", rough(value));
  }
}

function drawScaleOfColours(root, x, y, width) {
  const { bands, name } = field;
  for (let i = 0; i < bands; ++i) root.append(svg("rect", { x: x + (width * i) / bands, y, width: width / bands + 0.5, height: 14, fill: bandColour(i) }));
  root.append(svg("rect", { x, y, width, height: 14, fill: "none", class: "zero" }), panelTitle(x, y - 6, inUnit(sentence(field.words).slice(0, -1), name)));
  const every = Math.ceil((bands * 75) / width);
  for (let i = 0; i <= bands; i += every) root.append(axisWord(x + (width * i) / bands, y + 30, rough(field.level(i))));
}

// ---- all structures ----

// Views: the unit vectors in space that point right and up on the page.
const views = [
  { words: "x to the right, y up", right: [1, 0, 0], up: [0, 1, 0] },
  { words: "x to the right, z up", right: [1, 0, 0], up: [0, 0, 1] },
  { words: "y to the right, z up", right: [0, 1, 0], up: [0, 0, 1] },
  // Seen approximately from (3, -6, 3).
  { words: "oblique, z up", right: [0.8944, 0.4472, 0], up: [-0.1826, 0.3651, 0.9129] },
];
let view = 0;
let scene = null;  // what the pictures of all states have in common; null if no position is known
let held = null;   // the frame of the scene to keep while the user of the playground drags something

function sceneOf() {
  const at = structure.nodes.map(({ x, y = 0, z = 0 }) => [x, y, z]);
  const along = at.map(() => [-1, -1, -1]);  // [node][axis] the dof along that axis; -1: none
  places.dofs.forEach((d, u) => { if (d.at >= 0 && d.direction >= 1 && d.direction <= 3) along[d.at][d.direction - 1] = u; });
  const met = new Set(places.dofs.map((d) => d.at));
  const lines = linesOf();
  const edges = lines ? edgesBetween(lines) : drawnEdges();
  return {
    at, along, lines, edges,
    drawn: edges.length > 0 ? [...at.keys()] : some("nodes", at.length, 20_000),
    still: [...at.keys()].filter((i) => !met.has(i)),
    force: largest((f) => f.pairs.map((p) => Math.max(0, p.force))),
    point: largest((f) => pointsOf(f).filter((p) => p.direction <= 3).map((p) => p.value)),
    lineLoad: isBeam() ? largest((f) => { const q = lineLoadOf(f); return q ? [...structure.nodes.slice(1).flatMap((n, e) => [q(e, structure.nodes[e].x), q(e, n.x)]), ...f.load.uniform.flatMap(({ elements, from, to }) => (elements ? [] : [from, to].map((x) => q(elementAt(x), x))))] : []; }) : 0,
  };
}

// The drawn nodes of a beam, or columns and rows of a plate; null for a matrix.
function linesOf() {
  const { kind, nodes, columns } = structure;
  if (isBeam()) return [some("nodes", nodes.length, 1000), [0]];
  return kind !== "plate" ? null : [some("grid lines along y", columns, 40), some("grid lines along x", nodes.length / columns, 40)];
}

function edgesBetween([columns, rows]) {
  const node = (j, i) => rows[j] * (structure.columns || 0) + columns[i] + 1;
  return rows.flatMap((_, j) => columns.flatMap((_, i) => [
    ...(i > 0 ? [[node(j, i - 1), node(j, i)]] : []), ...(j > 0 ? [[node(j - 1, i), node(j, i)]] : [])]));
}

// The edges to draw: at most `most`, those of the fewest elements, which are the outer edges of a solid.
function drawnEdges(most = 20_000) {
  const { edges } = structure;
  if (edges.length <= most) return edges;
  cuts.add(`${most} of ${edges.length} edges are drawn: the edges of the fewest elements, which are the outer edges of a solid; among equals, evenly chosen.`);
  const spreadOut = (i) => (i * 0.6180339887498949) % 1;
  const order = edges.map((e, i) => [e, e[2] + spreadOut(i)]).sort((a, b) => a[1] - b[1]);
  return order.slice(0, most).map(([e]) => e);
}

// The view along an axis on which all nodes have the same coordinate and no dof; otherwise the oblique view.
function fittingView() {
  const flat = [2, 1, 0].findIndex((axis) => scene.at.every((at, i) => scene.along[i][axis] < 0 && at[axis] === scene.at[0][axis]));
  return flat < 0 ? 3 : flat;
}

// Projects a point in space onto the page. Returns its coordinates to the right and up, in units of length.
const projected = (at) => [views[view].right, views[view].up].map((to) => to[0] * at[0] + to[1] * at[1] + to[2] * at[2]);

const movedTo = (f, i, times) => scene.at[i].map((x, axis) => x + (scene.along[i][axis] < 0 ? 0 : times * f.u[scene.along[i][axis]]));
const faceAt = (p, times) => scene.at[p.at].map((x, axis) => x + (axis === p.direction - 1 ? times * p.face : 0));

// Finds the magnification of displacements and the box around the structure in all states. Faces much farther away than
// the structure moves are outside the box. `kept`: the magnification to keep during a drag.
function frameScene(kept) {
  const was = scene.drawn.map((i) => projected(scene.at[i]));
  const size = Math.max(...[0, 1].map((k) => { const [low, high] = spread(was.map((at) => at[k])); return high - low; }));
  const reach = largest((f) => scene.drawn.map((i) => Math.hypot(...scene.along[i].map((u) => (u < 0 ? 0 : f.u[u])))));
  const near = places.pairs.filter((p) => p.at >= 0 && p.direction >= 1 && p.direction <= 3 && (reach === 0 || Math.abs(p.face) <= (kept ? 6 : 2.5) * reach));
  const most = near.reduce((far, p) => Math.max(far, Math.abs(p.face)), reach);
  const times = kept ?? magnificationFor(most, (isBeam() ? 0.21 : 0.13) * size);
  const box = [Infinity, -Infinity, Infinity, -Infinity];
  const take = ([x, y]) => [Math.min(box[0], x), Math.max(box[1], x), Math.min(box[2], y), Math.max(box[3], y)].forEach((v, k) => { box[k] = v; });
  was.forEach(take);
  for (const p of near) take(projected(faceAt(p, times)));
  const undeformed = [...box];
  for (const f of frames) for (const i of scene.drawn) take(projected(movedTo(f, i, times)));
  return { times, size, most, box, undeformed };
}

// The scales of a picture, with room for numbers beside the structure, and for loads and forces above and below.
function pageOf(width, [x0, x1, y0, y1] = scene.box) {
  const { times } = scene;
  const [left, right, top] = [74, 30, 100];
  const scale = Math.min((width - left - right) / (x1 - x0 || 1), y1 > y0 ? 420 / (y1 - y0) : Infinity);
  const begin = left + (width - left - right - (x1 - x0) * scale) / 2;
  const X = (x) => begin + (x - x0) * scale;
  const height = (y) => top + (y1 - y) * scale;
  return { width, scale, X, Y: (w) => height(times * w), height, ends: [x0, x1], heights: [y0, y1], bottom: height(y0) + (isBeam() ? 96 : 124), spot: ([x, y]) => [X(x), height(y)] };
}

// The projection of an axis, as a vector of length 1, and its length; null for rotations and normals of the page.
function onPage(direction) {
  if (direction < 1 || direction > 3) return null;
  const { right, up } = views[view];
  const [x, y] = [right[direction - 1], -up[direction - 1]];
  const length = Math.hypot(x, y);
  return length < 0.1 ? null : { t: [x / length, y / length], length };
}

// Equal small marks at many nodes, as one SVG element.
const marksAt = (numbers, spots, mark, kind) => shape(numbers.map((i) => `M${spots[i][0].toFixed(1)} ${spots[i][1].toFixed(1)}${mark}`).join(""), kind);

function drawEdges(root, spots, kind) {
  const at = (node) => spots[node - 1].map((v) => v.toFixed(1)).join(" ");
  root.append(scene.edges.length === 0 ? marksAt(scene.drawn, spots, "h0", `${kind} dots`)
    : shape(scene.edges.map(([from, to]) => `M${at(from)}L${at(to)}`).join(""), scene.edges.length > 400 || field ? `${kind} many` : kind));
}

// Draws the directions of the axes and a scale of length.
function drawAxes(root, { width, bottom, scale }) {
  const [x, y] = [40, bottom - 8];
  const { right, up } = views[view];
  ["x", "y", "z"].forEach((name, axis) => {
    const [dx, dy] = [26 * right[axis], -26 * up[axis]];
    if (Math.hypot(dx, dy) > 3) root.append(line(x, y, x + dx, y + dy, "thin"), axisWord(x + dx * 1.45, y + dy * 1.45 + 4, name));
  });
  if (!(scene.size > 0)) return;
  const length = roundUp(scene.size / 8);
  const [to, bar] = [width - 30, length * scale];
  root.append(path([[to - bar, y - 4], [to - bar, y], [to, y], [to, y - 4]], "thin"), axisWord(to, y + 18, `length ${rough(length)}`, "end"));
}

// The object `on` of drawPairs, described above. Marks are smaller if there are many.
function marksOn(words, page, spots, f, isSketch) {
  const count = places.pairs.length;
  const apart = (scene.size * page.scale) / (isBeam() ? count : Math.sqrt(count));
  return {
    isSketch, isShown: !isSketch && field && hasBed() ? bordersContact(f) : () => true, spot: ({ at, x, between }) => (between ? [page.X(x), page.Y(valueAt(f, "w", x))] : spots[at]), along: ({ direction }) => onPage(direction)?.t ?? null,
    pixels: ({ direction }) => scene.times * page.scale * (onPage(direction)?.length ?? 0),
    limit: scene.times * scene.most * page.scale + 40, r: Math.max(1.6, Math.min(5, apart * 0.3)), half: Math.max(1, Math.min(14, apart * 0.36)),
    say: wordsInFreePlaces(words, page.width, page.bottom - (isBeam() ? 0 : 30), isBeam() ? 62 : 2),
  };
}

let page = null;  // the scales of the last picture (see pageOf)

// Draws state `f`. A sketch shows only the structure with supports, pairs and loads, without diagrams and colours.
function drawPicture(f, holder, isSketch = false) {
  if (scene === null) return;
  page = pageOf(widthOf(holder), isSketch ? scene.undeformed : scene.box);
  const { width, bottom } = page;
  const colours = isSketch ? undefined : field;
  const was = scene.at.map((at) => page.spot(projected(at)));
  const spots = scene.at.map((_, i) => page.spot(projected(movedTo(f, i, scene.times))));
  const below = isSketch ? 40 : isBeam() ? (hasBed() ? 450 : 310) : field ? 80 : 30;
  const root = canvas(holder, width, bottom + below, isSketch ? "Sketch of the system" : stateWords(f));
  const title = isSketch ? "The system; distances of faces are" : isBeam() ? `${inUnit("Deflection", "w")},` : "Displacement,";
  root.classList.toggle("on-colours", colours !== undefined);
  root.append(panelTitle(16, 18, `${title} drawn ${timesWords(scene.times)}${isBeam() || width < 520 ? "" : `; ${views[view].words}`}`));
  drawEdges(root, was, "was");
  if (colours) drawColours(root, f, spots);
  if (isBeam()) drawBeam(root, f, page, isSketch);
  else drawEdges(root, spots, "member");
  root.append(marksAt(scene.still, was, "m-3 -3l6 6m-6 0l6 -6", "thin still"));
  const words = svg("g");  // on top of all marks
  page.on = marksOn(words, page, spots, f, isSketch);
  if (printing && colours) markLargest(root, f, spots, page.on.say);  // loads would cover the colours
  else drawPoints(root, f, page.on);
  drawPairs(root, pairsOf(f), page.on);
  drawSupports(root, f, page.on);
  if (structure.kind === "plate" && !(printing && colours)) drawAreaLoads(root, f, spots, page.on.say);
  if (isSketch && isBeam()) sayLineLoads(f, page, page.on.say);
  root.append(words);
  if (!isBeam()) drawAxes(root, page);
  if (colours) drawScaleOfColours(root, 62, bottom + 40, width - 98);
}

// A picture as the text of an SVG file, with the style rules of pictures and the light colours. CSS variables are
// replaced by their values, because not every SVG program supports variables.
function fileOf(picture) {
  const copy = picture.cloneNode(true);
  const [root, ...rules] = [...document.styleSheets].flatMap((s) => [...s.cssRules]).filter((r) => /^(:root|svg)/.test(r.selectorText));
  const text = [...rules.map((r) => r.cssText), 'svg { background: var(--panel); font-family: "DejaVu Sans", Arial, sans-serif; }'].join("\n");
  copy.prepend(svg("style", {}, text.replace(/var\((--\w+)\)/g, (_, name) => root.style.getPropertyValue(name).trim())));
  return new XMLSerializer().serializeToString(copy);
}

function savePicture() {
  const link = element("a", { href: URL.createObjectURL(new Blob([fileOf(byId("picture").firstChild)], { type: "image/svg+xml" })), download: "picture.svg" });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

// Prepares what the pictures of all states have in common. Needs read() before.
function preparePicture() {
  cuts.clear();
  drawnPairs = some("pairs", places.pairs.length, isBeam() ? 300 : 1000);
  drawnSupports = some("supports", places.supports.length, 300).map((i) => places.supports[i]);
  if (places.pairs.length > 60) cuts.add(`The numbers of ${hasBed() ? "beds' pairs" : "many pairs"} are not written beside their marks.`);
  fields = structure.kind === "plate" ? fieldsOf() : [];
  field = fields.find((f) => field && f.name === field.name) || fields[0];
  scene = structure.nodes.length > 0 ? sceneOf() : null;
  view = scene ? fittingView() : 0;
  if (scene) Object.assign(scene, frameScene(held?.times));
}
