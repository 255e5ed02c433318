// Draws a run from the result beside it, contct-result-1 with its structure and states (result.js reads it). Nothing is
// computed here but where to put numbers on the page, and the colours between a plate's nodes.
"use strict";

const result = JSON.parse(document.getElementById("data").textContent);
const { structure } = result;
const places = placesOf(result);
const frames = framesOf(result, places);
const increments = result.steps.flatMap((s) => s.increments.map((i) => ({ ...i, step: s.step, number: i.increment })));
const calm = matchMedia("(prefers-reduced-motion: reduce)");

// ---- words and numbers ----

const byId = (id) => document.getElementById(id);
const minus = (text) => text.replace(/-/g, "\u2212");
// Seven digits for people; the whole number stands in the title and in data-value.
const short = (x) => (x === null || x === undefined ? "–" : minus(String(Number(x.toPrecision(7)))));
const five = (x) => minus(String(Number(x.toPrecision(5))));
const rough = (x) => minus(String(Number(x.toPrecision(4))));
const counted = (n, what) => `${n.toLocaleString("en")} ${what}${n === 1 ? "" : "s"}`;
const known = { fortran: "FORTRAN", cpp: "C++", "fortran-r4": "FORTRAN (4-byte REAL)", "cpp-r4": "C++ (4-byte REAL)" };
const kernels = result.kernels.map((name) => known[name] || name);
const sentence = (text) => text[0].toUpperCase() + text.slice(1) + ".";
const where = (f) => (f.step === 0 ? "Start" : f.number === 0 ? `${f.step}, end` : `${f.step}.${f.number}`);
const ofMatrix = structure.kind === "matrix";
// What moves and how it is named: "deflection w of node 3", "displacement of dof 6.y".
const moves = ofMatrix ? "displacement" : "deflection";
const unitOf = ofMatrix ? "dof" : "node";
const placed = (name) => `${unitOf} ${name}`;
// A unit, by its powers of force and length; none where the problem names none. A plate's moments are per length.
const powers = { w: [0, 1], force: [1, 0], moment: [1, 1], shear: [1, 0], pressure: [1, -2], modulus: [1, -3], stiffness: [1, -1], EI: [1, 2] };
function unit(quantity) {
  if (!result.units || !(quantity in powers || /^m[xy]/.test(quantity))) return "";
  const { length, force } = result.units;
  const [f, l] = powers[quantity] || [1, 0];
  if (!(quantity in powers)) return `${force} ${length}/${length}`;
  const of = l === 0 ? "" : length + ["", "", "²", "³"][Math.abs(l)];
  return f === 0 ? of : force + (l === 0 ? "" : l > 0 ? " " : "/") + of;
}
const inUnit = (name, quantity) => name + (unit(quantity) ? ` [${unit(quantity)}]` : "");
// Where a value of the extremes is: at a node, or between two of a beam's.
const nodesAt = new Map(ofMatrix ? [] : structure.nodes.map((n) => [`${n.x},${n.y}`, n.node]));
function placeOf(v) {
  if (v.dof !== undefined) return placed(v.dof);
  const node = nodesAt.get(`${v.x},${v.y}`);
  return node === undefined ? `x = ${rough(v.x)}` : placed(node);
}
const largestOf = (range) => (-range.min.value > range.max.value ? range.min : range.max);
const looks = { o: "separated", c: "in contact", f: "at its face" };

// `count` numbers from 0 to `all` - 1, evenly, the first and the last among them; all where there are no more.
const evenly = (all, count) => Array.from({ length: Math.min(all, count) }, (_, i) => (all <= count ? i : Math.floor((i * (all - 1)) / (count - 1))));

function cell(value, attributes = {}) {
  if (typeof value !== "number") return element("td", { class: "words", ...attributes }, value);
  return element("td", { "data-value": String(value), title: String(value), ...attributes }, short(value));
}

function eventWords(e) {
  return `pair ${e.pair} ${e.change === "make" ? "makes" : "breaks"} contact (${placed(nameOf(e))}, ${e.surface})`;
}

// What the page cuts, for its last section.
const cuts = new Set();

function allEventWords(events, most = 8) {
  if (events.length > most) cuts.add(`Where more than ${most} events come together, the first ${most} are named and the others counted.`);
  const named = events.slice(0, most).map(eventWords);
  if (events.length > named.length) named.push(`and ${events.length - named.length} more`);
  return named.join("; ");
}

// Of very many pairs, supports, nodes or grid lines some are drawn, evenly chosen.
function some(what, all, most) {
  if (all > most) cuts.add(`${most} of ${all} ${what} are drawn, evenly chosen. The largest values are those of all.`);
  return evenly(all, most);
}
const drawnPairs = some("pairs", places.pairs.length, structure.kind === "beam" ? 300 : 1000);
const drawnSupports = some(`${unitOf}s with supports`, places.supports.length, 300).map((i) => places.supports[i]);
const pairsOf = (frame) => drawnPairs.map((i) => frame.pairs[i]);
const lookWords = (p) => (p.look === "f" ? `at its face, ${p.closed ? "in contact" : "separated"}` : looks[p.look]);

// Several pairs may stand at one node: their marks are drawn one over another, the one that carries most last.
const drawingOrder = { o: 0, f: 1, c: 2 };
const leastLoadedFirst = (pairs) =>
  [...pairs].sort((a, b) => drawingOrder[a.look] - drawingOrder[b.look] || Math.abs(a.force) - Math.abs(b.force));

// ---- SVG ----

const line = (x1, y1, x2, y2, kind) => svg("line", { x1, y1, x2, y2, class: kind });
const label = (x, y, words, attributes = {}) => svg("text", { x, y, ...attributes }, words);
const path = (points, kind, end = "") =>
  svg("path", { d: "M" + points.map(([x, y]) => `${x.toFixed(2)} ${y.toFixed(2)}`).join("L") + end, class: kind });

function canvas(holder, width, height, title) {
  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "img", "aria-label": title });
  holder.replaceChildren(root);
  return root;
}

// One of these digits times a power of ten, not above x.
function roundDown(x, digits = [1, 2, 5]) {
  const power = 10 ** Math.floor(Math.log10(x));
  return Number((Math.max(...digits.filter((d) => d * power <= x * (1 + 1e-12)), 1) * power).toPrecision(3));
}

// On paper pictures have a width of their own, at which their words are as large as the text around.
let printing = false;
const widthOf = (holder) => (printing ? 940 : Math.max(320, holder.clientWidth));

// 1, 2 or 5 times a power of ten, not below x.
function roundUp(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return Number(([1, 2, 5, 10].find((d) => d * power >= x * (1 - 1e-12)) * power).toPrecision(3));
}

// Round numbers from one to the other: at most so many and one, but never fewer than three.
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

function spread(values) {
  let low = Infinity;
  let high = -Infinity;
  for (const v of values) {
    if (v === null || !isFinite(v)) continue;
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return low > high ? [0, 0] : [low, high];
}

function arrow(x, y, dx, dy, kind) {
  const length = Math.hypot(dx, dy);
  if (length < 1) return svg("g");
  const [ux, uy] = [dx / length, dy / length];
  const head = Math.min(8, length);
  const [bx, by] = [x + dx - ux * head, y + dy - uy * head];
  return svg("g", { class: kind },
    svg("path", { d: `M${x} ${y}L${bx} ${by}`, fill: "none" }),
    svg("path", { d: `M${x + dx} ${y + dy}L${bx - uy * 4} ${by + ux * 4}L${bx + uy * 4} ${by - ux * 4}Z`, "stroke-width": 0 }));
}

// The looks differ in shape: open is a ring, closed a square, at its face a diamond, full when in contact.
function pairMark(look, x, y, r, closed = false) {
  if (look === "o") return svg("circle", { cx: x, cy: y, r, class: "pair-open" });
  if (look === "c") return svg("rect", { x: x - r, y: y - r, width: 2 * r, height: 2 * r, class: "pair-closed" });
  const d = r * 1.3;
  return svg("path", { d: `M${x} ${y - d}L${x + d} ${y}L${x} ${y + d}L${x - d} ${y}Z`, class: closed ? "pair-face in-contact" : "pair-face" });
}

// A word where no other stands, and inside the picture; otherwise none.
function wordsInFreePlaces(root, width, height) {
  const boxes = [];
  return (x, y, words, kind) => {
    const half = 4.4 * words.length + 2;
    const box = [x - half, y - 13, x + half, y + 5];
    const free = box[0] >= 2 && box[2] <= width - 2 && box[1] >= 24 && box[3] <= height - 4 &&
      boxes.every((b) => b[0] >= box[2] || b[2] <= box[0] || b[1] >= box[3] || b[3] <= box[1]);
    if (!free) return false;
    boxes.push(box);
    root.append(label(x, y, words, { "text-anchor": "middle", class: `${kind} halo` }));
    return true;
  };
}

// ---- the beam ----

const margin = { left: 74, right: 26 };
let magnification = null;  // as chosen; null: as fits
let part = [0, 1];         // of the beam's length that is drawn

// Draw more or less of the beam: its middle stays, but for the beam's ends.
function zoom(times) {
  const middle = (part[0] + part[1]) / 2;
  const length = Math.min(1, Math.max(1e-3, (part[1] - part[0]) * times));
  move(middle - length / 2 - part[0], length);
}

function move(by, length = part[1] - part[0]) {
  const from = Math.min(1 - length, Math.max(0, part[0] + by));
  part = [from, from + length];
  for (const id of ["whole", "zoom-out", "left", "right"]) byId(id).disabled = length === 1;
  draw(frames[current]);
}

const largest = (values) => frames.reduce((most, f) => values(f).reduce((m, x) => Math.max(m, Math.abs(x)), most), 0);
const pointsOf = (f) => (f.load.point || []).map((p) => {
  const name = Object.keys(p).find((key) => key !== "node" && key !== "dof");
  return { node: nameOf(p), dof: name, value: p[name] };
});

// What the pictures of a beam have in common, once.
const beam = structure.kind !== "beam" ? null : (() => {
  const xs = structure.nodes.map((n) => n.x);
  const [low, high] = rangeOf("w");
  const reach = Math.max(Math.abs(low), Math.abs(high));
  const near = places.pairs.filter((p) => reach === 0 || Math.abs(p.face) <= 2.5 * reach).map((p) => p.face);
  const [l, h] = spread([low, high, 0, ...near]);
  return {
    xs, low: l, high: h, from: xs[0], to: xs[xs.length - 1],
    stations: some("nodes", xs.length, 1000),
    point: largest((f) => pointsOf(f).filter((p) => p.dof === "w").map((p) => p.value)),
    spread: largest((f) => spreadLoads(f).flatMap((p) => p.q)),
    force: largest((f) => f.pairs.map((p) => p.force)),
    strips: { moment: rangeOf("moment"), shear: rangeOf("shear") },
  };
})();

// The least and the largest value of a quantity in all states, 0 among them.
function rangeOf(name) {
  return spread([0, ...frames.flatMap((f) => (name in f.extremes ? [f.extremes[name].min.value, f.extremes[name].max.value] : []))]);
}

// Distributed loads, in pieces along which they have no jump: from where to where, and their size at places between.
function spreadLoads(f) {
  const parts = (f.load.uniform || []).map((part) => ({ ...part, has: numbersIn(part.elements) }));
  const xs = structure.nodes.map((n) => n.x);
  const pieces = [];
  for (let e = 0; e + 1 < xs.length && parts.length > 0; ++e) {
    const here = parts.filter((part) => part.has(e + 1));
    const before = pieces[pieces.length - 1];
    if (before && before.last === e && before.here.length === here.length && here.every((part, i) => part === before.here[i])) before.last = e + 1;
    else if (here.length > 0) pieces.push({ first: e, last: e + 1, here });
  }
  return pieces.map(({ first, last, here }) => {
    const [from, to] = [xs[first], xs[last]];
    const count = here.some((part) => part.polynomial && part.polynomial.length > 2) ? 13 : 2;
    const at = (x) => here.reduce((sum, { value, polynomial = [value] }) => sum + polynomial.reduceRight((y, a) => y * x + a, 0), 0);
    return { from, to, q: Array.from({ length: count }, (_, i) => at(from + ((to - from) * i) / (count - 1))) };
  });
}

// "all", "2..9", or a list.
function numbersIn(elements) {
  if (elements === "all") return () => true;
  if (Array.isArray(elements)) return (e) => elements.includes(e);
  const [first, last] = elements.split("..").map(Number);
  return (e) => e >= first && e <= last;
}

function fittingMagnification(width, height) {
  const range = beam.high - beam.low;
  const scale = (width - margin.left - margin.right) / (beam.to - beam.from);
  return range > 0 ? roundDown(height / (range * scale), [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8]) : 1;
}

// Places along the part of the beam that is drawn, nodes and places between: [element, share].
function placesAlong() {
  const { xs, stations } = beam;
  const pieces = stations.length < xs.length ? 1 : Math.ceil(240 / xs.length);
  return [...stations.slice(0, -1).flatMap((e) => Array.from({ length: pieces }, (_, k) => [e, k / pieces])), [xs.length - 2, 1]];
}
const xAt = ([e, share]) => (share === 1 ? beam.xs[e + 1] : beam.xs[e] + share * (beam.xs[e + 1] - beam.xs[e]));
const wAt = (f, x) => deflectionAt(structure, f, x);

// Moment or shear: the polynomials through what the ends of an element have. The shear is the moment's slope.
function forceAt(f, name, [e, a]) {
  const { moment: [m0, m1], shear: [v0, v1] } = f.elements[e];
  const h = beam.xs[e + 1] - beam.xs[e];
  if (name === "moment") return hermite(h, m0, m1, v0, v1, a);
  return a === 0 ? v0 : a === 1 ? v1 : (6 * a * (1 - a) * (m1 - m0)) / h + v0 * (1 - 4 * a + 3 * a * a) + v1 * (3 * a * a - 2 * a);
}

function drawSupport(s, f, reaction, X, Y, say) {
  const fixed = s.dofs.some(([dof, spring]) => dof === "w" && spring === null);
  const held = s.dofs.some(([dof]) => dof === "w");
  const turns = s.dofs.some(([dof, spring]) => dof === "theta" && spring === null);
  const [x, y] = [X(s.x), Y(wAt(f, s.x))];
  const g = svg("g", {}, svg("title", {}, `Support at node ${s.name}: ${supportWords(s)}${reactionWords(reaction)}`));
  if (drawnSupports.length > 40 && !(fixed && turns)) {  // a crowd: a stroke each
    g.append(line(x, y + 4, x, y + (fixed ? 14 : 9), fixed ? "support" : "thin"));
    return g;
  }
  if (held && reaction) {
    const words = rough(reaction);
    const half = 4.4 * words.length + 4;  // beside the axis' numbers, inside the picture
    say(Math.min(Math.max(x, margin.left - 10 + half), X(beam.to) + margin.right - half), y + 40, words, "value reaction-value");
  }
  if (fixed && turns) {
    const out = s.x - beam.from < beam.to - s.x ? -1 : 1;
    g.append(svg("path", { d: `M${x} ${y - 20}V${y + 20}`, class: "support", "stroke-width": 3 }));
    for (let k = -16; k <= 20; k += 8) g.append(line(x, y + k, x + out * 8, y + k - 8, "hatch"));
  } else if (fixed) {
    g.append(svg("path", { d: `M${x} ${y + 3}l9 15h-18Z`, class: "support" }), line(x - 13, y + 22, x + 13, y + 22, "thin"));
  } else if (held) {
    g.append(svg("path", { d: `M${x} ${y + 2}v3l6 3l-12 5l12 5l-12 5l6 3v3`, class: "thin" }), line(x - 10, y + 29, x + 10, y + 29, "thin"));
  } else {
    g.append(svg("rect", { x: x - 6, y: y - 6, width: 12, height: 12, class: "support", "fill-opacity": 0 }));
  }
  return g;
}

// The face of a pair, hatched on the side away from the beam; a dashed one stands beyond the picture.
function drawFace(p, x, half, Y, top, bottom) {
  const y = Math.min(bottom - 8, Math.max(top + 8, Y(p.face)));
  const far = y !== Y(p.face);
  const g = svg("g", {}, svg("title", {}, `Pair ${p.pair}, node ${p.name}: face ${p.surface} at ${short(p.face)}${far ? ", beyond the picture" : ""}`));
  g.append(line(x - half, y, x + half, y, "face-line" + (far ? " far" : "")));
  if (half >= 5) {
    for (let k = -half + 2; k < half; k += 6) g.append(line(x + k, y, x + k - p.side * 4, y - p.side * 6, "hatch"));
  }
  return [g, y];
}

function drawPairs(root, f, X, Y, top, bottom, say, [from, to]) {
  const pairs = pairsOf(f).filter((p) => p.x >= from && p.x <= to);
  if (pairs.length === 0) return;
  const xs = pairs.map((p) => X(p.x)).sort((a, b) => a - b);
  const gaps = xs.slice(1).map((x, i) => x - xs[i]).filter((d) => d > 0.01);
  const room = gaps.length > 0 ? Math.min(...gaps) : 60;
  const half = Math.max(1, Math.min(16, room * 0.36));  // of a face
  const r = Math.max(1.6, Math.min(5, room * 0.3));
  const numbered = pairs.length <= 60;
  for (const p of pairs) {
    const x = X(p.x);
    const [face, y] = drawFace(p, x, half, Y, top, bottom);
    root.append(face);
    const out = -p.side;  // downwards on the page for a face below
    const length = beam.force > 0 ? 36 * Math.abs(p.force) / beam.force : 0;
    // Beyond the face's hatches and the node, which has pressed the spring past its face.
    const tip = out > 0 ? Math.max(y + 10, Y(p.w) + r + 3) : Math.min(y - 10, Y(p.w) - r - 3);
    const start = tip + out * length;
    if (p.closed && Math.abs(y - Y(p.w)) > 8) root.append(line(x, y, x, Y(p.w), "spring"));
    if (p.force > 0 && length >= 1) root.append(arrow(x, start, 0, -out * length, "force"));
    if (numbered) {
      const words = `${p.pair}`;
      const at = start + out * (out > 0 ? 14 : 6);
      const force = p.look === "c" && room >= 60 ? rough(p.force) : "";
      if (say(x, at, words, "axis-word") && force !== "") say(x, at + out * 18, force, "value");
    }
  }
  for (const p of leastLoadedFirst(pairs)) {
    const mark = pairMark(p.look, X(p.x), Y(p.w), r, p.closed);
    mark.append(svg("title", {}, `Pair ${p.pair}, node ${p.name}, ${lookWords(p)}: ` +
      (p.closed ? `force ${short(p.force)}` : `gap ${short(p.gap)}`)));
    root.append(mark);
  }
}

// A piece of a distributed load, without a jump: its size above or below the beam, between its own ends.
function drawSpreadLoad(root, f, { from, to, q }, X, Y) {
  const size = (share) => {
    const i = Math.min(q.length - 2, Math.floor(share * (q.length - 1)));
    const between = share * (q.length - 1) - i;
    return (25 * (q[i] + between * (q[i + 1] - q[i]))) / beam.spread;
  };
  const at = (share, away) => {
    const x = from + share * (to - from);
    return [X(x), Y(wAt(f, x)) + away];
  };
  const arrows = Math.max(1, Math.round((X(to) - X(from)) / 34));
  const places = Math.max(q.length - 1, Math.min(80, Math.ceil((X(to) - X(from)) / 10)));  // as the beam bends
  const side = (share) => (size(share) > 0 || (size(share) === 0 && Math.max(...q) > 0) ? 8 : -8);
  const line = [at(0, side(0))];
  for (let i = 0; i <= places; ++i) line.push(at(i / places, side(i / places) + size(i / places)));
  line.push(at(1, side(1)));
  if (q.some((v) => v !== 0)) root.append(path(line, "load-line"));
  for (let i = 0; i < arrows; ++i) {
    const share = (i + 0.5) / arrows;
    const [x, y] = at(share, side(share));
    if (Math.abs(size(share)) > 3) root.append(arrow(x, y + size(share), 0, -size(share), "load"));
  }
}

function drawLoads(root, f, X, Y, say, [from, to]) {
  const longest = 34;
  if (beam.spread > 0) for (const piece of spreadLoads(f)) drawSpreadLoad(root, f, piece, X, Y);
  for (const { node, dof, value } of pointsOf(f)) {
    const x = beam.xs[node - 1];
    if (x < from || x > to) continue;
    const y = Y(wAt(f, x));
    if (dof === "w" && beam.point > 0) {
      const size = (longest * 1.3 * value) / beam.point;
      const start = y + (size > 0 ? 8 : -8) + size;
      const g = arrow(X(x), start, 0, -size, "load");
      g.append(svg("title", {}, `Load ${short(value)} at node ${node}`));
      if (value !== 0) {
        root.append(g);
        say(X(x), start + (size > 0 ? 15 : -6), rough(value), "value");
      }
    } else if (dof === "theta" && value !== 0) {
      const turn = value > 0 ? 0 : 1;
      root.append(svg("path", { d: `M${X(x) + 13} ${y + 7}A15 15 0 1 ${turn ? 0 : 0} ${X(x) + 13} ${y - 7}`, class: "load-line", "stroke-width": 2 }),
        svg("title", {}, `Moment ${short(value)} at node ${node}`));
      say(X(x), y - 20, `${rough(value)} ${value > 0 ? "↺" : "↻"}`, "value");
    }
  }
}

function drawBeamAxis(root, X, bottom, width, [from, to]) {
  for (const x of ticks(from, to, Math.floor(width / 75))) {
    root.append(line(X(x), bottom, X(x), bottom + 5, "zero"));
    root.append(label(X(x), bottom + 19, rough(x), { "text-anchor": "middle", class: "axis-word" }));
  }
  root.append(line(X(from), bottom, X(to), bottom, "zero"));
}

// A strip under the beam with a quantity that may jump at the nodes.
function drawStrip(root, f, X, top, height, name, title, [from, to]) {
  const range = f.extremes[name] || { min: { value: 0, x: beam.from }, max: { value: 0, x: beam.from } };
  const narrow = X(to) - X(from) < 520;
  const [low, high] = beam.strips[name];
  const Y = (v) => top + 24 + ((high - v) / (high - low || 1)) * (height - 34);
  for (const v of ticks(low, high, 4)) {
    if (v !== 0) root.append(line(margin.left, Y(v), X(to), Y(v), "grid"));
    root.append(label(margin.left - 16, Y(v) + 4, rough(v), { "text-anchor": "end", class: "axis-word" }));
  }
  root.append(line(margin.left, Y(0), X(to), Y(0), "zero"));
  const along = placesAlong();
  const points = along.flatMap(([e, a], i) => {
    const here = [X(xAt([e, a])), Y(forceAt(f, name, [e, a]))];
    if (i === 0 || a !== 0) return [here];
    const before = forceAt(f, name, [e - 1, 1]);
    return before === forceAt(f, name, [e, 0]) ? [here] : [[here[0], Y(before)], here];
  });
  // The least and the largest value may be between these places.
  const ends = [range.max, range.min].sort((a, b) => Math.abs(b.value) - Math.abs(a.value));
  for (const v of ends) {
    const after = points.findIndex(([x]) => x > X(v.x));
    if (after > 0 && !beam.xs.includes(v.x)) points.splice(after, 0, [X(v.x), Y(v.value)]);
  }
  const inside = svg("g", { "clip-path": "url(#part)" },
    path([[X(beam.from), Y(0)], ...points, [X(beam.to), Y(0)]], name + "-area", "Z"), path(points, name));
  root.append(inside);
  root.append(label(margin.left, top + 12, title, { class: "panel-title" }));
  const told = ends.filter((v, i) => i === 0 || v.value * ends[0].value < -1e-9 * ends[0].value ** 2);
  for (const v of told) inside.append(svg("circle", { cx: X(v.x), cy: Y(v.value), r: 3, class: "dot-" + name }));
  const words = told.slice(0, narrow ? 1 : 2).map((v) => `${five(v.value)} at x = ${five(v.x)}`);
  root.append(label(X(to), top + 12, words.join("; "), { "text-anchor": "end", class: "value" }));
}

function drawBeam(f) {
  const holder = byId("picture");
  const width = widthOf(holder);
  const room = width < 520 ? 150 : 190;  // for deflections
  const upper = places.pairs.some((p) => p.side > 0);
  const lower = places.pairs.some((p) => p.side < 0);
  const [above, below] = [upper ? 92 : 74, lower ? 84 : 52];  // for loads and pairs' forces
  const fitting = fittingMagnification(width, room);
  const factor = magnification || fitting;
  const whole = (width - margin.left - margin.right) / (beam.to - beam.from);  // pixels a length, of all of it
  const drawn = part.map((share) => beam.from + share * (beam.to - beam.from));
  const [from, to] = drawn;
  const scale = (width - margin.left - margin.right) / (to - from);
  const X = (x) => margin.left + (x - from) * scale;
  const middle = (beam.high + beam.low) / 2;
  const Y = (w) => above + room / 2 - (w - middle) * factor * whole;
  const bottom = above + room + below;
  const strip = 126;
  const wide = width >= 620;
  const height = bottom + 30 + 2 * (strip + 14);
  const root = canvas(holder, width, height, stateWords(f));
  const times = (factor * whole) / scale;
  root.append(label(margin.left, 16, `${inUnit("Deflection", "w")}, drawn × ${times.toLocaleString("en", { maximumSignificantDigits: 3 })}`, { class: "panel-title" }));
  const reach = room / 2 / (factor * whole);
  for (const w of ticks(middle - reach, middle + reach, 4)) {
    root.append(line(margin.left, Y(w), X(to), Y(w), w === 0 ? "zero" : "grid"));
    root.append(label(margin.left - 16, Y(w) + 4, rough(w), { "text-anchor": "end", class: "axis-word" }));
  }
  // What is beside the part that is drawn is cut off; at the beam's own ends marks have room.
  const [left, right] = [part[0] === 0 ? 0 : margin.left, part[1] === 1 ? width : X(to)];
  const inside = svg("g", { "clip-path": "url(#part)" });
  root.append(svg("clipPath", { id: "part" }, svg("rect", { x: left, y: 0, width: right - left, height })), inside);
  const say = wordsInFreePlaces(root, width, bottom);
  inside.append(line(X(from), Y(0), X(to), Y(0), "undeformed"));
  inside.append(path(placesAlong().map((at) => [X(xAt(at)), Y(deflectionAt(structure, f, xAt(at), at[0]))]), "beam"));
  drawLoads(inside, f, X, Y, say, drawn);
  drawPairs(inside, f, X, Y, 20, bottom, say, drawn);
  for (const s of drawnSupports) if (s.x >= from && s.x <= to) inside.append(drawSupport(s, f, reactionAt(f, s), X, Y, say));
  drawBeamAxis(root, X, bottom, width, drawn);
  drawStrip(root, f, X, bottom + 36, strip, "moment", inUnit(wide ? "Moment, positive where it sags" : "M", "moment"), drawn);
  drawStrip(root, f, X, bottom + 36 + strip + 14, strip, "shear", inUnit(wide ? "Shear, of the left part on the right" : "V", "shear"), drawn);
  offerMagnifications(fitting);
}

function offerMagnifications(fitting) {
  const select = byId("magnification");
  if (Number(select.dataset.fitting) === fitting) return;
  select.dataset.fitting = String(fitting);
  select.replaceChildren(element("option", { value: "" }, `× ${rough(fitting)} (fits)`));
  for (const times of [0.1, 0.5, 2, 5]) {
    select.append(element("option", { value: String(fitting * times) }, `× ${rough(fitting * times)}`));
  }
  if (fitting !== 1) select.append(element("option", { value: "1" }, "× 1 (true to scale)"));
  select.value = magnification === null ? "" : String(magnification);
}

// ---- the plate ----

// The force on the structure by a support; null where it holds no deflection.
function reactionAt(f, s) {
  const held = s.dofs.filter(([dof]) => dof === "w");
  return held.length === 0 ? null : held.reduce((sum, [, , i]) => sum + f.reactions[i], 0);
}

// Grid lines that contours go through, and the nodes where they cross, row by row.
const plate = structure.kind !== "plate" ? null : (() => {
  const count = structure.columns;
  const [columns, rows] = [some("grid lines along y", count, 40), some("grid lines along x", structure.nodes.length / count, 40)];
  return {
    columns, rows, x: columns.map((i) => structure.nodes[i].x), y: rows.map((j) => structure.nodes[j * count].y),
    crossings: rows.flatMap((j) => columns.map((i) => j * count + i)),
    force: largest((f) => f.pairs.map((p) => Math.max(0, p.force))),
    reaction: largest((f) => places.supports.map((s) => reactionAt(f, s) || 0)),
  };
})();

// Of all elements at a node the mean of what they have there, by name; nodes from 0.
function meansAtNodes(f, name) {
  const [sum, met] = [0, 0].map(() => new Array(structure.nodes.length).fill(0));
  const across = structure.columns - 1;
  f.elements.forEach((e, i) => {
    const first = Math.floor(i / across) * structure.columns + (i % across);
    [first, first + 1, first + structure.columns + 1, first + structure.columns].forEach((node, corner) => {
      sum[node] += e[name][corner];
      ++met[node];
    });
  });
  return sum.map((s, i) => (met[i] > 0 ? s / met[i] : 0));
}

// What beds press on the plate by, at each node.
function pressureAtNodes(f) {
  const at = new Array(structure.nodes.length).fill(0);
  for (const p of f.pairs) if (p.bed) at[p.u / 3] += p.force / p.bed;
  return at;
}

function atCrossings(f, name) {
  f.fields = f.fields || {};
  const all = () => (name === "w" ? structure.nodes.map((_, i) => f.u[3 * i]) : name === "pressure" ? pressureAtNodes(f) : meansAtNodes(f, name));
  return (f.fields[name] = f.fields[name] || (() => { const values = all(); return plate.crossings.map((i) => values[i]); })());
}

// What can be shown of a plate, with levels that are the same in all states. A bed's pressure has kinks.
const fields = !plate ? [] : [["w", "deflection w"], ["mx", "moment mx"], ["my", "moment my"], ["mxy", "twisting moment mxy"], ["pressure", "foundation pressure"]]
  .filter(([name]) => name !== "pressure" || structure.pairs.some((p) => p.bed)).map(([name, words]) => {
    const [low, high] = spread(frames.flatMap((f) => spread(atCrossings(f, name))));
    const step = high > low ? roundDown(((high - low) / 9) * 1.3, [1, 2, 2.5, 5]) : 1;
    const base = Math.floor(low / step + 1e-9);
    return { name, words, step, level: (i) => (base + i) * step, bands: Math.max(1, Math.ceil(high / step - 1e-9) - base), smooth: name !== "pressure" };
  });
let field = fields[0];

// From deep blue, the lowest, to pale, the highest; light changes all along, so that grey prints tell too.
function bandColour(i) {
  const share = field.bands > 1 ? i / (field.bands - 1) : 0.5;
  const stops = [[22, 52, 98], [38, 104, 160], [104, 165, 200], [178, 210, 222], [250, 244, 228]];
  const at = share * (stops.length - 1);
  const k = Math.min(stops.length - 2, Math.floor(at));
  const mix = stops[k].map((c, j) => Math.round(c + (stops[k + 1][j] - c) * (at - k)));
  return `rgb(${mix.join(",")})`;
}

// The part of a triangle whose values lie between two levels.
function clipped(corners, least, most) {
  const half = (list, keep, level) => {
    const out = [];
    list.forEach((a, i) => {
      const b = list[(i + 1) % list.length];
      const [inA, inB] = [keep(a[2]), keep(b[2])];
      if (inA) out.push(a);
      if (inA !== inB) {
        const t = (level - a[2]) / (b[2] - a[2]);
        out.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), level]);
      }
    });
    return out;
  };
  const upper = half(corners, (v) => v >= least, least);
  return upper.length < 3 ? [] : half(upper, (v) => v <= most, most);
}

// A line of values at `parts` times as many places: the cubic with the slopes of parabolas through neighbours.
function finer(at, values, parts) {
  const n = at.length;
  const steep = values.slice(1).map((v, i) => (v - values[i]) / (at[i + 1] - at[i]));
  const slope = (i) => {
    if (i === 0 || i === n - 1 || n < 3) return n < 3 ? steep[0] : i === 0 ? 2 * steep[0] - slope(1) : 2 * steep[n - 2] - slope(n - 2);
    const [before, after] = [at[i] - at[i - 1], at[i + 1] - at[i]];
    return (steep[i - 1] * after + steep[i] * before) / (before + after);
  };
  const slopes = at.map((_, i) => slope(i));
  const out = [values[0]];
  for (let i = 0; i + 1 < n; ++i)
    for (let k = 1; k <= parts; ++k) out.push(hermite(at[i + 1] - at[i], values[i], values[i + 1], slopes[i], slopes[i + 1], k / parts));
  return out;
}

// The field on a grid that is fine enough for smooth contours, row by row.
function fineGrid(f) {
  const { x, y } = plate;
  const values = atCrossings(f, field.name);
  const parts = field.smooth ? Math.max(1, Math.ceil(32 / Math.max(x.length, y.length))) : 1;
  const along = y.map((_, j) => finer(x, values.slice(j * x.length, (j + 1) * x.length), parts));
  const columns = along[0].map((_, i) => finer(y, along.map((r) => r[i]), parts));
  return { x: finer(x, x, parts), y: finer(y, y, parts), at: (i, j) => columns[i][j] };
}

function contourPaths(f, X, Y) {
  const grid = fineGrid(f);
  const [nx, ny] = [grid.x.length, grid.y.length];
  const bandOf = (w) => Math.max(0, Math.min(field.bands - 1, Math.floor((w - field.level(0)) / field.step)));
  const paths = Array.from({ length: field.bands }, () => []);
  const corner = (i, j) => [X(grid.x[i]), Y(grid.y[j]), grid.at(i, j)];
  for (let j = 0; j + 1 < ny; ++j) {
    for (let i = 0; i + 1 < nx; ++i) {
      const [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
      const m = [0, 1, 2].map((k) => (a[k] + b[k] + c[k] + d[k]) / 4);
      for (const triangle of [[a, b, m], [b, c, m], [c, d, m], [d, a, m]]) {
        const values = triangle.map((p) => p[2]);
        const to = bandOf(Math.max(...values));
        for (let band = bandOf(Math.min(...values)); band <= to; ++band) {
          const least = band === 0 ? -Infinity : field.level(band);
          const most = band === field.bands - 1 ? Infinity : field.level(band + 1);
          const part = clipped(triangle, least, most);
          if (part.length > 2) paths[band].push("M" + part.map((p) => `${p[0].toFixed(1)} ${p[1].toFixed(1)}`).join("L") + "Z");
        }
      }
    }
  }
  return paths;
}

function drawPlate(f) {
  const holder = byId("picture");
  const width = widthOf(holder);
  const [x0, x1] = [plate.x[0], plate.x[plate.x.length - 1]];
  const [y0, y1] = [plate.y[0], plate.y[plate.y.length - 1]];
  const narrow = width < 560;
  const room = { left: 62, right: narrow ? 22 : 150, top: 34, bottom: narrow ? 92 : 46 };
  const scale = Math.min((width - room.left - room.right) / (x1 - x0), 520 / (y1 - y0));
  const height = room.top + room.bottom + (y1 - y0) * scale;
  const left = room.left + Math.max(0, (width - room.left - room.right - (x1 - x0) * scale) / 2);
  const X = (x) => left + (x - x0) * scale;
  const Y = (y) => room.top + (y1 - y) * scale;
  const root = canvas(holder, width, height, stateWords(f));
  root.append(label(left, 18, `${sentence(field.words).slice(0, -1)}${narrow ? "" : " from above"}, and the pairs`, { class: "panel-title" }));
  const map = svg("g");
  contourPaths(f, X, Y).forEach((d, i) => {
    if (d.length > 0) map.append(svg("path", { d: d.join(""), fill: bandColour(i), stroke: bandColour(i), "stroke-width": 0.7 }));
  });
  root.append(map, svg("rect", { x: X(x0), y: Y(y1), width: X(x1) - X(x0), height: Y(y0) - Y(y1), class: "edge" }));
  for (const x of ticks(x0, x1, 6)) {
    root.append(line(X(x), Y(y0), X(x), Y(y0) + 5, "zero"), label(X(x), Y(y0) + 19, rough(x), { "text-anchor": "middle", class: "axis-word" }));
  }
  for (const y of ticks(y0, y1, 6)) {
    root.append(line(X(x0) - 5, Y(y), X(x0), Y(y), "zero"), label(X(x0) - 9, Y(y) + 4, rough(y), { "text-anchor": "end", class: "axis-word" }));
  }
  root.append(label(X(x1), Y(y0) + 36, "x", { "text-anchor": "end", class: "axis-word" }), label(X(x0) - 9, Y(y1) - 14, "y", { "text-anchor": "end", class: "axis-word" }));
  const over = svg("g", { class: "on-map" });
  root.append(over);
  drawPlateSupports(over, f, X, Y);
  drawPlatePairs(over, f, X, Y);
  drawPlateLoads(over, f, X, Y);
  if (narrow) drawScaleAcross(root, room.left, height - 44, width - room.left - room.right);
  else drawScaleDown(root, X(x1) + 26, room.top + 8, Math.min(300, Y(y0) - Y(y1) - 8));
}

const supportWords = (s) => s.dofs.map(([dof, spring]) => (spring === null ? `${dof} fixed` : `${dof} on a spring of ${short(spring)}`)).join(", ");
const reactionWords = (r) => (r === null || r === undefined ? "" : `; reaction ${short(r)}`);

// With a ring whose area goes with the reaction.
function drawPlateSupports(root, f, X, Y) {
  for (const s of drawnSupports) {
    const reaction = reactionAt(f, s);
    const [x, y] = [X(s.x), Y(s.y)];
    const g = svg("g", {}, svg("title", {}, `Support at node ${s.name}: ${supportWords(s)}${reactionWords(reaction)}`));
    const size = plate.reaction > 0 ? 14 * Math.sqrt(Math.abs(reaction || 0) / plate.reaction) : 0;
    if (size > 2) g.append(svg("circle", { cx: x, cy: y, r: size, class: reaction > 0 ? "reaction" : "reaction down" }));
    if (s.dofs.some(([dof]) => dof === "w")) g.append(svg("path", { d: `M${x} ${y - 5}l5 9h-10Z`, class: "support" }));
    else g.append(svg("path", { d: `M${x - 3} ${y - 3}l6 6m-6 0l6 -6`, class: "thin" }));
    root.append(g);
  }
}

function offerFields() {
  const select = byId("field");
  byId("field-label").hidden = select.hidden = !plate;
  select.replaceChildren(...fields.map((f) => element("option", { value: f.name }, f.words)));
  select.addEventListener("change", () => { field = fields.find((f) => f.name === select.value); draw(frames[current]); });
}

function drawPlatePairs(root, f, X, Y) {
  const pairs = pairsOf(f);
  const xs = [...new Set(pairs.map((p) => X(p.x)))].sort((a, b) => a - b);
  const room = xs.length > 1 ? Math.min(...xs.slice(1).map((x, i) => x - xs[i])) : 40;
  const most = Math.max(1.6, Math.min(9, room * 0.38));
  for (const p of leastLoadedFirst(pairs)) {
    const grown = p.look === "c" && plate.force > 0 ? 0.35 + 0.65 * Math.sqrt(Math.max(0, p.force) / plate.force) : 0.5;
    const [x, y] = [X(p.x), Y(p.y)];
    const r = Math.max(1.5, most * grown);
    const mark = pairMark(p.look, x, y, r, p.closed);
    mark.append(svg("title", {}, `Pair ${p.pair}, node ${p.name}, face ${p.surface}, ${lookWords(p)}: ` +
      (p.closed ? `force ${short(p.force)}` : `gap ${short(p.gap)}`)));
    root.append(mark);
    if (p.side > 0 && most > 3) root.append(svg("path", { d: `M${x - r - 1} ${y - r - 3}h${2 * r + 2}`, class: "face-line" }));
  }
}

function drawPlateLoads(root, f, X, Y) {
  for (const { node, dof, value } of pointsOf(f)) {
    if (dof !== "w" || value === 0) continue;
    const { x, y } = structure.nodes[node - 1];
    const g = svg("g", { class: "load" }, svg("title", {}, `Load ${short(value)} at node ${node}`));
    g.append(svg("circle", { cx: X(x), cy: Y(y), r: 8, "fill-opacity": 0, "stroke-width": 2.5 }));
    if (value < 0) g.append(svg("path", { d: `M${X(x) - 5} ${Y(y) - 5}l10 10m-10 0l10 -10`, "stroke-width": 2 }));
    else g.append(svg("circle", { cx: X(x), cy: Y(y), r: 2.5 }));
    root.append(g);
  }
}

function drawScaleDown(root, x, y, height) {
  const bands = field.bands;
  root.append(label(x, y - 12, inUnit(field.name === "pressure" ? "p" : field.name, field.name), { class: "panel-title" }));
  for (let i = 0; i < bands; ++i) {
    root.append(svg("rect", { x, y: y + (height * (bands - 1 - i)) / bands, width: 20, height: height / bands + 0.5, fill: bandColour(i) }));
  }
  root.append(svg("rect", { x, y, width: 20, height, fill: "none", class: "zero" }));
  for (let i = 0; i <= bands; i += bands > 12 ? 2 : 1) {
    root.append(label(x + 28, y + (height * (bands - i)) / bands + 4, rough(field.level(i)), { class: "axis-word" }));
  }
}

function drawScaleAcross(root, x, y, width) {
  const bands = field.bands;
  for (let i = 0; i < bands; ++i) {
    root.append(svg("rect", { x: x + (width * i) / bands, y, width: width / bands + 0.5, height: 14, fill: bandColour(i) }));
  }
  root.append(svg("rect", { x, y, width, height: 14, fill: "none", class: "zero" }));
  root.append(label(x, y - 6, inUnit(field.name, field.name), { class: "panel-title" }));
  for (const [i, anchor] of [[0, "start"], [Math.round(bands / 2), "middle"], [bands, "end"]]) {
    root.append(label(x + (width * i) / bands, y + 30, rough(field.level(i)), { "text-anchor": anchor, class: "axis-word" }));
  }
}

// ---- a structure from elsewhere, where its nodes have places ----

// Directions of view: unit vectors in space that point right and up on the page.
const views = [
  { words: "x to the right, y up", right: [1, 0, 0], up: [0, 1, 0] },
  { words: "x to the right, z up", right: [1, 0, 0], up: [0, 0, 1] },
  { words: "y to the right, z up", right: [0, 1, 0], up: [0, 0, 1] },
  // The eye is at (3, -6, 3), nearly: right and up are at right angles, and of length 1.
  { words: "oblique, z up", right: [0.8944, 0.4472, 0], up: [-0.1826, 0.3651, 0.9129] },
];

const dofNumbers = new Map((structure.dofs || []).map((d, i) => [d.dof, i]));
const mesh = !ofMatrix || structure.nodes.length === 0 ? null : (() => {
  const { nodes, dofs } = structure;
  const along = nodes.map(() => [-1, -1, -1]);  // the dof of a node along each axis
  const held = nodes.map(() => false);
  dofs.forEach((d, i) => {
    if (d.at === null) return;
    held[d.at - 1] = true;
    if (d.direction <= 3) along[d.at - 1][d.direction - 1] = i;
  });
  const [edges, drawn] = drawnEdges();
  const moved = (f) => drawn.map((i) => Math.hypot(...along[i].map((dof) => (dof < 0 ? 0 : f.u[dof]))));
  return {
    along, edges, drawn, at: nodes.map((n) => [n.x, n.y, n.z]),
    axes: [0, 1, 2].filter((axis) => along.some((of) => of[axis] >= 0)),
    still: drawn.filter((i) => !held[i]),
    reach: largest(moved),
    force: largest((f) => f.pairs.map((p) => Math.max(0, p.force))),
    point: largest((f) => meshPoints(f).filter((p) => p.direction <= 3).map((p) => p.value)),
  };
})();

// Edges, and the nodes at them. Of very many edges those of the fewest elements, which are the outer ones of a solid.
function drawnEdges(most = 20_000) {
  const nodes = structure.nodes.length;
  if (structure.edges.length === 0) return [[], some("nodes", nodes, most)];
  if (structure.edges.length <= most) return [structure.edges, evenly(nodes, nodes)];
  cuts.add(`${most} of ${structure.edges.length} edges are drawn: those of the fewest elements, which are the outer ones of a solid, and evenly chosen among equals.`);
  const spreadOut = (i) => (i * 0.6180339887498949) % 1;
  const order = structure.edges.map((e, i) => [e, e[2] + spreadOut(i)]).sort((a, b) => a[1] - b[1]);
  return [order.slice(0, most).map(([e]) => e), evenly(nodes, nodes)];
}

function meshPoints(f) {
  return pointsOf(f).map((p) => ({ ...p, ...structure.dofs[dofNumbers.get(p.node)] })).filter((p) => p.at !== null && p.value !== 0);
}

// Straight on where one coordinate is the same for all nodes and none of them can leave that plane, else oblique.
function fittingView() {
  const flat = (axis) => !mesh.axes.includes(axis) && mesh.at.every((at) => at[axis] === mesh.at[0][axis]);
  const found = [2, 1, 0].findIndex(flat);
  return found < 0 ? 3 : found;
}

let view = mesh ? fittingView() : 0;

// Right and up on the page, in units of length: two numbers a node.
function projected(f, times) {
  const { right, up } = views[view];
  const out = new Float64Array(2 * mesh.at.length);
  mesh.at.forEach((was, i) => {
    const at = was.map((x, axis) => x + (mesh.along[i][axis] < 0 ? 0 : times * f.u[mesh.along[i][axis]]));
    out[2 * i] = right[0] * at[0] + right[1] * at[1] + right[2] * at[2];
    out[2 * i + 1] = up[0] * at[0] + up[1] * at[1] + up[2] * at[2];
  });
  return out;
}

// Room for the structure as it was, and around it for the largest displacement: the same in all states.
function meshLayout(width) {
  const was = projected(frames[0], 0);
  const [x0, x1] = spread(was.filter((_, i) => i % 2 === 0));
  const [y0, y1] = spread(was.filter((_, i) => i % 2 === 1));
  const size = Math.max(x1 - x0, y1 - y0);
  const fitting = mesh.reach > 0 && size > 0 ? roundDown((0.12 * size) / mesh.reach, [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8]) : 1;
  const factor = magnification || fitting;
  const room = Math.max(factor * mesh.reach, 0.02 * size);
  const [wide, high] = [x1 - x0 + 2 * room || 1, y1 - y0 + 2 * room || 1];
  const edge = { side: width < 520 ? 46 : 66, top: 76, bottom: 100 };
  const scale = Math.min((width - 2 * edge.side) / wide, 440 / high);
  const left = (width - wide * scale) / 2;
  return {
    fitting, factor, scale, size,
    height: edge.top + high * scale + edge.bottom,
    X: (x) => left + (x - x0 + room) * scale,
    Y: (y) => edge.top + (y1 + room - y) * scale,
  };
}

// A direction on the page, of length 1; nothing where it points at the eye.
function onPage(direction) {
  if (direction < 1 || direction > 3) return null;
  const { right, up } = views[view];
  const [x, y] = [right[direction - 1], -up[direction - 1]];
  const length = Math.hypot(x, y);
  return length < 0.1 ? null : [x / length, y / length];
}

function edgePath(spots, kind) {
  const d = [];
  for (const [from, to] of mesh.edges) {
    const [a, b] = [2 * from - 2, 2 * to - 2];
    d.push(`M${spots[a].toFixed(1)} ${spots[a + 1].toFixed(1)}L${spots[b].toFixed(1)} ${spots[b + 1].toFixed(1)}`);
  }
  return svg("path", { d: d.join(""), class: kind });
}

// Small marks of one kind at many nodes, as one path.
const marksAt = (numbers, spots, mark, kind) =>
  svg("path", { d: numbers.map((i) => `M${spots[2 * i].toFixed(1)} ${spots[2 * i + 1].toFixed(1)}${mark}`).join(""), class: kind });

function drawMeshSupports(root, spots) {
  for (const s of drawnSupports) {
    if (s.at === null) continue;
    const [x, y] = [spots[2 * s.at], spots[2 * s.at + 1]];
    const spring = s.dofs[s.dofs.length - 1][1];
    const t = onPage(s.direction);
    const g = svg("g", {}, svg("title", {}, `Support of dof ${s.name}: ${spring === null ? "fixed" : `on a spring of ${short(spring)}`}`));
    if (t === null) g.append(svg("path", { d: `M${x - 5} ${y - 5}h10v10h-10Z`, class: "support", "fill-opacity": 0 }));
    else {
      const at = (along, across) => `${(x - along * t[0] + across * t[1]).toFixed(1)} ${(y - along * t[1] - across * t[0]).toFixed(1)}`;
      if (spring === null) g.append(svg("path", { d: `M${at(2, 0)}L${at(14, 7)}L${at(14, -7)}Z`, class: "support" }));
      else g.append(svg("path", { d: `M${at(2, 0)}L${at(4, 5)}L${at(8, -5)}L${at(12, 5)}L${at(16, -5)}L${at(18, 0)}M${at(18, 8)}L${at(18, -8)}`, class: "thin" }));
    }
    root.append(g);
  }
}

function drawMeshLoads(root, f, spots, say) {
  for (const { at, direction, value, node: name } of meshPoints(f)) {
    const t = onPage(direction);
    const [x, y] = [spots[2 * at - 2], spots[2 * at - 1]];
    const title = svg("title", {}, `Load ${short(value)} at dof ${name}`);
    if (t === null) {
      root.append(svg("g", {}, title, svg("path", { d: `M${x + 13} ${y + 7}A15 15 0 1 ${value > 0 ? 0 : 1} ${x + 13} ${y - 7}`, class: "load-line", "stroke-width": 2 })));
      continue;
    }
    const size = (40 * Math.abs(value)) / mesh.point;
    const sign = Math.sign(value);
    const from = [x - sign * (9 + size) * t[0], y - sign * (9 + size) * t[1]];
    const g = arrow(from[0], from[1], sign * size * t[0], sign * size * t[1], "load");
    g.append(title);
    root.append(g);
    if (size >= 8) say(from[0] - sign * 12 * t[0], from[1] - sign * 12 * t[1] + 4, rough(value), "value");
  }
}

// The face stands across the pair's direction, as far from where the node was as c is; beside the node, along
// which it has no end. Hatched on the far side.
function drawMeshFace(root, p, t, [x, y], pixels) {
  const far = 90;
  const along = pixels * p.face;
  const cut = Math.max(-far, Math.min(far, along));
  const at = (a, across) => [x + (a - pixels * p.w) * t[0] - across * t[1], y + (a - pixels * p.w) * t[1] + across * t[0]];
  const half = 13;
  const g = svg("g", {}, svg("title", {}, `Pair ${p.pair}, dof ${p.name}: face ${p.surface} at ${short(p.face)}${cut === along ? "" : ", farther than drawn"}`));
  g.append(line(...at(cut, -half), ...at(cut, half), "face-line" + (cut === along ? "" : " far")));
  for (let k = -half + 2; k < half; k += 6) g.append(line(...at(cut, k), ...at(cut + p.side * 6, k - 4), "hatch"));
  root.append(g);
  return cut;
}

function drawMeshPairs(root, f, spots, layout, say) {
  const { right, up } = views[view];
  const pairs = leastLoadedFirst(pairsOf(f).filter((p) => p.at !== null));
  const r = pairs.length > 60 ? 3.2 : 5;
  for (const p of pairs) {
    const t = onPage(p.direction);
    const [x, y] = [spots[2 * p.at], spots[2 * p.at + 1]];
    const mark = pairMark(p.look, x, y, r, p.closed);
    mark.append(svg("title", {}, `Pair ${p.pair}, dof ${p.name}, face ${p.surface}, ${lookWords(p)}: ` +
      (p.closed ? `force ${short(p.force)}` : `gap ${short(p.gap)}`)));
    if (t !== null) {
      const pixels = layout.factor * layout.scale * Math.hypot(right[p.direction - 1], up[p.direction - 1]);
      const node = pixels * p.w;  // from where it was, along the pair's direction
      const face = drawMeshFace(root, p, t, [x, y], pixels);
      if (p.closed && Math.abs(face - node) > 8) root.append(line(x + (face - node) * t[0], y + (face - node) * t[1], x, y, "spring"));
      const length = mesh.force > 0 ? (36 * Math.abs(p.force)) / mesh.force : 0;
      // Beyond the face's hatches and the node's mark.
      const tip = (p.side > 0 ? Math.max(face + 10, node + r + 3) : Math.min(face - 10, node - r - 3)) - node;
      const start = tip + p.side * length;
      if (p.force > 0 && length >= 1) root.append(arrow(x + start * t[0], y + start * t[1], -p.side * length * t[0], -p.side * length * t[1], "force"));
      if (pairs.length <= 60) say(x + (start + p.side * 11) * t[0], y + (start + p.side * 11) * t[1] + 4, String(p.pair), "axis-word");
    } else if (pairs.length <= 60) say(x + 13, y - 8, String(p.pair), "axis-word");
    root.append(mark);
  }
}

// Where the axes point, and how long a length is.
function drawMeshAxes(root, width, height, layout) {
  const [x, y] = [40, height - 34];
  const { right, up } = views[view];
  ["x", "y", "z"].forEach((name, axis) => {
    const [dx, dy] = [26 * right[axis], -26 * up[axis]];
    if (Math.hypot(dx, dy) < 3) return;
    root.append(line(x, y, x + dx, y + dy, "thin"),
      label(x + dx * 1.45, y + dy * 1.45 + 4, name, { "text-anchor": "middle", class: "axis-word" }));
  });
  if (!(layout.size > 0)) return;
  const length = roundUp(layout.size / 8);
  const [to, bar] = [width - 30, length * layout.scale];
  root.append(path([[to - bar, y - 4], [to - bar, y], [to, y], [to, y - 4]], "thin"),
    label(to, y + 18, `length ${rough(length)}`, { "text-anchor": "end", class: "axis-word" }));
}

function drawMesh(f) {
  const holder = byId("picture");
  const width = widthOf(holder);
  const layout = meshLayout(width);
  const place = (list) => list.map((v, i) => (i % 2 === 0 ? layout.X(v) : layout.Y(v)));
  const was = place(projected(f, 0));
  const spots = place(projected(f, layout.factor));
  const root = canvas(holder, width, layout.height, stateWords(f));
  const factor = layout.factor.toLocaleString("en", { maximumSignificantDigits: 3 });
  root.append(label(16, 18, width < 520 ? `Displacement × ${factor}` : `Displacement, drawn × ${factor}; ${views[view].words}`, { class: "panel-title" }));
  const all = mesh.drawn;
  if (mesh.edges.length > 0) root.append(edgePath(was, "mesh-was"), edgePath(spots, mesh.edges.length > 400 ? "member many" : "member"));
  else root.append(marksAt(all, was, "h0", "mesh-was dots"), marksAt(all, spots, "h0", "member dots"));
  if (mesh.still.length > 0) root.append(marksAt(mesh.still, was, "m-3 -3l6 6m-6 0l6 -6", "thin still"));
  drawMeshSupports(root, spots);
  if (all.length <= 200) {
    for (const i of all) root.append(svg("circle", { cx: spots[2 * i], cy: spots[2 * i + 1], r: 2.2, class: "mesh-node" }, svg("title", {}, `node ${structure.nodes[i].node}`)));
  }
  const say = wordsInFreePlaces(root, width, layout.height - 62);
  drawMeshLoads(root, f, spots, say);
  drawMeshPairs(root, f, spots, layout, say);
  drawMeshAxes(root, width, layout.height, layout);
  offerMagnifications(layout.fitting);
}

function offerViews() {
  const select = byId("view");
  byId("view-label").hidden = select.hidden = !mesh;
  if (!mesh) return;
  select.replaceChildren(...views.map((v, i) => element("option", { value: String(i) }, v.words)));
  select.value = String(view);
  select.addEventListener("change", () => { view = Number(select.value); draw(frames[current]); });
}

// ---- load against deflection ----

const sumOf = (f) => f.load.force ?? f.load.sum ?? 0;
const [leastTotal, mostTotal] = spread(frames.map(sumOf));
const byForce = mostTotal - leastTotal > 1e-9 * Math.max(Math.abs(leastTotal), Math.abs(mostTotal));
const progress = (f) => (f.step === 0 ? 0 : f.step - 1 + f.fraction);
const measure = (f) => (byForce ? sumOf(f) : progress(f));

// The dofs that are deflections, by number. Of a matrix those that are known to be lengths, or all.
function deflectingDofs() {
  if (!ofMatrix) return structure.nodes.map((_, i) => i * dofsPerNode[structure.kind]);
  const met = new Set(places.pairs.map((p) => p.u));
  const known = structure.dofs.flatMap((d, i) => (met.has(i) || (d.at && d.direction >= 1 && d.direction <= 3) ? [i] : []));
  return known.length > 0 || mesh ? known : structure.dofs.map((_, i) => i);
}

// What the path can be drawn of: first the node that moves most, then every node, or some, or those of pairs.
const paths = (() => {
  const most = { u: 0, size: -1 };
  for (const u of deflectingDofs()) {
    for (const f of frames) if (Math.abs(f.u[u]) > most.size) Object.assign(most, { u, size: Math.abs(f.u[u]) });
  }
  const stride = dofsPerNode[structure.kind];
  const all = ofMatrix ? [...new Set(places.pairs.map((p) => p.u))] : evenly(structure.nodes.length, 400).map((i) => i * stride);
  return [most.u, ...all.filter((u) => u !== most.u)].map((u) => ({ name: String(nameOf((structure.dofs || structure.nodes)[u / stride])), read: (f) => f.u[u] }));
})();
let followed = paths[0];

function offerPaths() {
  const select = byId("chart-node");
  byId("chart-node-label").textContent = `Path of ${unitOf}`;
  const byNumber = [...paths].sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }));
  select.replaceChildren(...byNumber.map((p) => element("option", { value: p.name }, p === paths[0] ? `${p.name} (moves most)` : p.name)));
  select.value = followed.name;
  select.addEventListener("change", () => {
    followed = paths.find((p) => p.name === select.value);
    drawChart(current);
  });
}

function drawChart(current) {
  const holder = byId("chart");
  const width = widthOf(holder);
  const height = width < 520 ? 280 : 340;
  const room = { left: 84, right: 28, top: 34, bottom: 54 };
  const [x0, x1] = padded(spread(frames.map(followed.read)));
  const [y0, y1] = padded(spread(frames.map(measure)));
  const X = (v) => room.left + ((v - x0) / (x1 - x0)) * (width - room.left - room.right);
  const Y = (v) => height - room.bottom - ((v - y0) / (y1 - y0)) * (height - room.top - room.bottom);
  const f = frames[current];
  const root = canvas(holder, width, height,
    `Load against the ${moves} of ${placed(followed.name)}, ${frames.length} states; now load ${rough(measure(f))}, ${moves} ${rough(followed.read(f))}`);
  for (const v of ticks(x0, x1, Math.floor(width / 95))) {
    root.append(line(X(v), room.top, X(v), height - room.bottom, v === 0 ? "zero" : "grid"));
    root.append(label(X(v), height - room.bottom + 18, rough(v), { "text-anchor": "middle", class: "axis-word" }));
  }
  for (const v of ticks(y0, y1, 5)) {
    root.append(line(room.left, Y(v), width - room.right, Y(v), v === 0 ? "zero" : "grid"));
    root.append(label(room.left - 8, Y(v) + 4, rough(v), { "text-anchor": "end", class: "axis-word" }));
  }
  root.append(label(room.left, 18, byForce ? (ofMatrix ? "Sum of the loads" : inUnit("Sum of the loads, positive up", "force")) : "Steps of load applied", { class: "panel-title" }));
  root.append(label(width - room.right, height - 12, `${ofMatrix ? moves : inUnit("deflection w", "w")} of ${placed(followed.name)}`, { "text-anchor": "end", class: "axis-word" }));
  root.append(line(X(followed.read(f)), Y(measure(f)), X(followed.read(f)), height - room.bottom, "cross"), line(room.left, Y(measure(f)), X(followed.read(f)), Y(measure(f)), "cross"));
  root.append(path(frames.map((g) => [X(followed.read(g)), Y(measure(g))]), "track"));
  for (const g of frames) root.append(chartMark(g, X(followed.read(g)), Y(measure(g))));
  root.append(svg("circle", { cx: X(followed.read(f)), cy: Y(measure(f)), r: 9, class: "here" }));
}

function padded([low, high]) {
  const reach = high - low || Math.abs(high) || 1;
  return [low - 0.06 * reach, high + 0.06 * reach];
}

function chartMark(f, x, y) {
  const crowd = frames.length > 60 ? 0.6 : 1;
  const words = `${where(f)}: ${f.events.length > 0 ? allEventWords(f.events) : f.end ? "end of step" : "no event"}`;
  const makes = f.events.some((e) => e.change === "make");
  const mark = f.events.length === 0
    ? svg("rect", { x: x - 4 * crowd, y: y - 4 * crowd, width: 8 * crowd, height: 8 * crowd, class: "step-end" })
    : svg("circle", { cx: x, cy: y, r: 4.6 * crowd, class: makes ? "make" : "break" });
  mark.append(svg("title", {}, words));
  return mark;
}

// ---- words for a state, read aloud when it changes ----

const countsOf = (f) => ["o", "c", "f"].map((look) => f.pairs.filter((p) => p.look === look).length);
// The largest deflection, inside a beam's elements too.
const mostOf = (f) => (f.extremes.w ? largestOf(f.extremes.w) : { value: 0, ...(ofMatrix ? { dof: paths[0].name } : structure.nodes[0]) });

function stateWords(f) {
  const n = f.pairs.length;
  const [open, closed, atFace] = countsOf(f);
  const place = f.step === 0 ? "Before any load."
    : `Step ${f.step}${f.number > 0 ? `, increment ${f.number}` : ""}: ${f.snap ? "a rigid-body motion at constant load; " : ""}load: ${minus(f.load.words)}, share ${short(f.fraction)} of the step.`;
  const event = f.events.length > 0 ? ` Then ${allEventWords(f.events, 3)}.` : f.end && f.fraction < 1 ? " The path ends here." : f.end ? " The step's load is applied." : "";
  const fallback = f.exact ? " This state is the end of the exact path: the path in doubles could not reach it."
    : f.from_fallback ? " This state is the reference solution: the path could not reach it." : "";
  const pairs = n === 0 ? " There are no contact pairs." : ` ${counted(closed, "pair")} in contact, ${open} separated, ${atFace} at ${atFace === 1 ? "its face" : "their faces"}.`;
  return `${place}${event}${fallback}${pairs} Largest ${moves} ${short(mostOf(f).value)} at ${placeOf(mostOf(f))}.`;
}

function showReadings(f) {
  const read = (name, value, whole) => element("div", {}, element("dt", {}, name),
    element("dd", whole === undefined ? {} : { "data-reading": name, "data-value": String(whole), title: String(whole) }, value));
  const list = [
    read("Increment", f.step === 0 ? "start" : where(f)),
    read("Share of the step", short(f.fraction), f.fraction),
    read("Scale factor s", f.number === 0 ? "–" : f.snap ? "snap" : short(f.s), f.s),
    read("Load", minus(f.load.words)),
    read(`Largest ${ofMatrix ? moves : "w"}, ${placeOf(mostOf(f))}`, short(mostOf(f).value), mostOf(f).value),
  ];
  const [open, closed, atFace] = countsOf(f);
  if (f.pairs.length > 0) list.push(read("In contact, separated, at face", `${closed}, ${open}, ${atFace}`));
  byId("readings").replaceChildren(...list);
}

// ---- tables ----

const row = (...cells) => element("tr", {}, ...cells);

function head(...names) {
  return element("thead", {}, row(...names.map(([name, words]) => element("th", { scope: "col", ...(words ? { class: "words" } : {}) }, name))));
}

const mostPairRows = 250;

const pairCount = places.pairs.length;
if (pairCount > 60) cuts.add("The numbers of the pairs are not written beside their marks, but shown when the pointer is over a mark.");
const firstPairs = `The first ${mostPairRows} of ${pairCount} pairs are listed.`;
if (pairCount > mostPairRows) cuts.add(`Pairs in a state: the first ${mostPairRows} of ${pairCount} are listed.`);

function showPairs(f) {
  const table = byId("pair-table");
  if (pairCount === 0) {
    table.parentElement.hidden = true;
    byId("pairs-words").textContent = "The problem has no contact pairs.";
    return;
  }
  const shown = f.pairs.slice(0, mostPairRows);
  byId("pairs-words").textContent = `State ${where(f)}. A gap is that of a separated pair. A contact force is positive when it pushes the structure off the face; a negative one is tension.` +
    (shown.length < pairCount ? ` ${firstPairs}` : "");
  table.replaceChildren(head(["Pair"], ofMatrix ? ["Dof", true] : ["Node"], ["Surface", true], ["Face"], ["State", true], ["Gap"], ["Force"]),
    element("tbody", {}, ...shown.map((p) => {
      const r = row(element("th", { scope: "row" }, String(p.pair)), cell(p.name, { "data-value": String(p.name) }), cell(p.surface), cell(p.face),
        cell(lookWords(p)), cell(p.gap), cell(p.force));
      r.dataset.pair = String(p.pair);
      return r;
    })));
}

const mostPaperRows = 60;
const mostEventRows = 1200;

function showEvents() {
  byId("events-words").textContent = increments.length === 0 ? "The path has no increment."
    : `${counted(increments.length, "increment")}. Share is the share of the step that is applied after the increment; s is the share of the remaining load that the increment applies, which the paper calls the scale factor.`;
  if (increments.length === 0) byId("event-table").parentElement.hidden = true;
  const stops = new Map(frames.map((f, i) => [where(f), i]));
  const table = byId("event-table");
  table.replaceChildren(head(["Increment"], ["Share"], ["s"], ["Load", true], ["Events", true]));
  const listed = increments.slice(0, mostEventRows);
  if (listed.length < increments.length) cuts.add(`Of ${increments.length} increments the first ${mostEventRows} are listed.`);
  for (let i = 0; i < listed.length;) {
    let next = i + 1;
    const { step } = listed[i];
    while (next < listed.length && listed[next].step === step && atNoLoad(listed[next])) ++next;
    const group = listed.slice(i, next);
    const rows = group.map((increment) => eventRow(increment, stops));
    if (group.length > 1 && atNoLoad(group[0])) table.append(element("tbody", {}, summaryRow(group, rows)));
    table.append(element("tbody", i >= mostPaperRows ? { class: "late" } : {}, ...rows));
    i = next;
  }
}

// Where a structure lifts off as soon as it is loaded, or a load's share is rounding: events of one load.
const atNoLoad = (increment) => increment.fraction <= 1e-9 && increment.events.length > 0;

// One line for many increments, whose own rows are shown on request.
function summaryRow(group, rows) {
  const [makes, breaks] = ["make", "break"].map((kind) => group.flatMap((i) => i.events).filter((e) => e.change === kind).length);
  const told = [[breaks, breaks === 1 ? "separates" : "separate"], [makes, makes === 1 ? "makes contact" : "make contact"]]
    .filter(([n]) => n > 0).map(([n, verb]) => `${counted(n, "pair")} ${verb}`).join(", ");
  const [first, last] = [group[0], group[group.length - 1]].map((i) => `${i.step}.${i.number}`);
  const list = element("details", {}, element("summary", {},
    `${told} at ${first.startsWith("1.") ? "the first load" : `the beginning of step ${group[0].step}`} (increments ${first} to ${last})`));
  const follow = () => { for (const r of rows) r.hidden = !list.open; };
  list.addEventListener("toggle", follow);
  follow();
  return row(element("td", { colspan: "5", class: "words" }, list));
}

function eventRow(i, stops) {
  const name = `${i.step}.${i.number}`;
  const stop = stops.get(name);
  const heading = element("th", { scope: "row" });
  if (stop === undefined) heading.append(name);
  else {
    const button = element("button", { type: "button", "aria-label": `Show increment ${name}` }, name);
    button.addEventListener("click", () => { stopPlaying(); show(stop); });
    heading.append(button);
  }
  const r = row(heading, cell(i.fraction), i.snap ? cell("snap") : cell(i.s), cell(minus(i.load.words)),
    element("td", { class: "words wrap" }, i.events.length > 0 ? allEventWords(i.events) : "–"));
  r.dataset.increment = name;
  return r;
}

function markCurrentRow(f) {
  for (const r of document.querySelectorAll("#event-table tr.current")) r.classList.remove("current");
  const now = document.querySelector(`#event-table tr[data-increment="${where(f)}"]`);
  if (now) now.classList.add("current");
}

function showCalls() {
  const [leader, ...others] = kernels;
  const words = byId("comparison-words");
  const holder = byId("call-table").parentElement;
  byId("comparison-heading").textContent = kernels.join(" against ");
  if (others.length === 0) {
    byId("comparison-heading").textContent = `Calls of ${leader}`;
    words.textContent = "One kernel ran, so nothing was compared. These are its answers.";
  } else if (!result.lockstep) {
    words.textContent = `Free run: each kernel followed its own path, so single calls were not compared: ${result.words.comparison}. The calls of ${leader}:`;
  } else {
    words.textContent = `Lockstep: ${others.join(" and ")} had the same input as ${leader} at every call: ${result.words.comparison}. ` +
      "A distance of 0 ULP means equal to the bit. Compared are SMIN, every s, every status, and the text of unit 26 where both have one.";
  }
  if (result.calls.length === 0) {
    words.textContent += result.calls_made === 0 ? " No call was made." : "";
    holder.hidden = true;
    return;
  }
  const pairs = Math.max(...result.calls.map((c) => c.s.length));
  const names = [["Call"], ["Increment", true], [`SMIN of ${leader}`]];
  const compared = result.lockstep ? others : [];
  for (const k of compared) names.push([`ULP off in SMIN, ${k}`], ["ULP off in any s"], ["values compared"], ["different"]);
  for (let i = 0; i < pairs; ++i) names.push([`s of pair ${i + 1}`]);
  byId("call-table").replaceChildren(head(...names), element("tbody", {}, ...result.calls.map((c, n) => {
    const cells = [element("th", { scope: "row" }, String(n + 1)), cell(c.step === 0 ? "settling" : `${c.step}.${c.increment}`), cell(c.smin)];
    compared.forEach((_, k) => {
      const a = c.followers[k];
      if (!a || a.failed) cells.push(cell("no answer"), cell("no answer"), cell("–"), cell("–"));
      else cells.push(cell(a.smin_ulps), cell(a.s_ulps), cell(a.values), cell(a.mismatches));
    });
    for (let i = 0; i < pairs; ++i) cells.push(cell(c.s[i]));
    return row(...cells);
  })));
  if (pairCount > pairs) words.textContent += ` Distances are over all pairs; s is listed for the first ${pairs} of ${pairCount}.`;
  if (result.calls.length < result.calls_made) cuts.add(`Of ${result.calls_made} calls the first ${result.calls.length} are listed.`);
}

const markOf = (c) => (!c ? "no certificate" : c.exact ? "certified" : "NOT certified");

function showCertificate() {
  const words = byId("certificate-words");
  const say = (text, kind) => words.append(element("p", kind ? { class: kind } : {}, text));
  say("A step is certified when the errors of all numbers of its final state are within the allowed ones: by proved bounds, or, where none can be proved, by comparison with the reference solution. That is the minimiser of the structure's energy; it uses neither the kernels nor the path.");
  if (result.words.certificate.length > 0) say(sentence(result.words.certificate.join("; ")), result.certified ? "good" : "bad");
  for (const text of result.words.complaints) say(sentence(text));
  const steps = result.steps.map((s) => s.certificate);
  if (steps.length === 0) {
    say("No step reached its full load, so there is nothing to certify.");
    byId("certificate-table").parentElement.hidden = true;
    return;
  }
  const own = steps.filter((c) => c && !c.independent).length;
  if (own > 0) say(`${counted(own, "state")} came from the reference solution itself, so a comparison with it shows nothing: only equilibrium, penetration and tension are judged there.`);
  const small = (x) => (x === null || x === undefined ? "–" : minus(x === 0 ? "0" : x.toExponential(1)));
  const fields = ["displacement_error", "shape_error", "equilibrium", "penetration", "tension", "tolerance"];
  byId("certificate-table").replaceChildren(
    head(["Step"], ["Certificate", true], ["error of deflections"], ["error of shape"], ["equilibrium"], ["penetration"], ["tension"], ["allowed"], ["digits"]),
    element("tbody", {}, ...steps.map((c, i) => row(element("th", { scope: "row" }, String(i + 1)), cell(markOf(c)),
      ...fields.map((name) => element("td", c ? { title: String(c[name]) } : {}, c ? small(c[name]) : "–")),
      element("td", {}, c ? String(c.digits) : "–")))));
}

// ---- tables of the input and of the ends of steps, as the run has them ----

function cellOf(value, words) {
  if (value === null) return element("td", words ? { class: "words" } : {}, "–");
  if (!Array.isArray(value)) return cell(value);
  return element("td", {}, ...value.flatMap(([number, at, rounding]) => [
    element("span", { "data-value": String(number), title: String(number) }, rounding ? "0" : short(number)),
    ...(at && !rounding ? [element("small", {}, at)] : [])]));
}

// Texts are to the left, as their headings are; a step's or a pair's number comes first and heads its row.
function tableOf({ title, head: names, rows }) {
  const words = names.map((_, i) => rows.every((r) => r[i] === null || typeof r[i] === "string"));
  return element("div", { class: rows.length > 12 ? "scroll" : "scroll whole", tabindex: "0", role: "region", "aria-label": title },
    element("p", { class: "caption" }, title), element("table", { "aria-label": title }, head(...names.map((name, i) => [name, words[i]])),
      element("tbody", {}, ...rows.map(([first, ...rest]) =>
        row(element("th", { scope: "row", class: "words" }, first), ...rest.map((value, i) => cellOf(value, words[i + 1])))))));
}

// Beside the largest of its kind a number may be nothing but rounding: it is shown as 0.
class Sizes {
  constructor() { this.largest = {}; }
  take(kind, value) { this.largest[kind] = Math.max(this.largest[kind] || 0, Math.abs(value)); }
  // [number, where it is, whether it is rounding]
  cell(kind, value, place = "") { return [value, place, value !== 0 && Math.abs(value) <= 1e-12 * this.largest[kind]]; }
}
const kindOf = (name) => (name.startsWith("m") ? "moment" : name);
const kindOfSupport = (s) => (s.dof === "w" || ofMatrix ? "force" : "reaction moment");
const stepName = (s) => (s.name ? `${s.step}, ${s.name}` : String(s.step));
const inLength = (name) => inUnit(name, "w");
const placeHead = ofMatrix ? ["Dof"] : structure.kind === "plate" ? ["Node", inLength("x"), inLength("y")] : ["Node", inLength("x")];
const placeCells = (p) => (ofMatrix ? [p.name] : structure.kind === "plate" ? [String(p.name), p.x, p.y] : [String(p.name), p.x]);
const supportRows = places.supports.flatMap((s) => s.dofs.map(([dof, spring, number]) => ({ ...s, dof, spring, number }))).sort((a, b) => a.number - b.number);
const quantityHead = (name) => inUnit(/^m[xy]/.test(name) || name === "w" ? name : sentence(name).slice(0, -1), name);
const largestBy = (list, value) => list.reduce((a, b) => (Math.abs(value(b)) > Math.abs(value(a)) ? b : a));

const mostTableRows = 40;
// The first rows, or those of the largest size; what is cut is told in the title and at the end of the page.
function cutTable(title, names, rows, sizeOf = null, cellsOf = (row) => row) {
  if (rows.length === 0) return [];
  if (rows.length <= mostTableRows) return [tableOf({ title, head: names, rows: rows.map(cellsOf) })];
  const how = `${sizeOf ? "largest" : "first"} ${mostTableRows} of ${rows.length}`;
  cuts.add(`${title}: the table has the ${how} rows.`);
  const order = sizeOf ? [...rows].sort((a, b) => sizeOf(b) - sizeOf(a)) : rows;
  const kept = new Set(order.slice(0, mostTableRows));
  return [tableOf({ title: `${title} (${how})`, head: names, rows: rows.filter((r) => kept.has(r)).map(cellsOf) })];
}

// The larger of both values by magnitude, then the other one where its sign differs.
function rangeCell(sizes, name, range) {
  const first = largestOf(range);
  const second = first === range.max ? range.min : range.max;
  const told = second.value * first.value < -1e-9 * first.value ** 2 ? [first, second] : [first];
  return told.map((v) => sizes.cell(kindOf(name), v.value, placeOf(v)));
}

function sizesOfSteps(steps) {
  const sizes = new Sizes();
  for (const s of steps) {
    for (const [name, range] of Object.entries(s.extremes)) sizes.take(kindOf(name), largestOf(range).value);
    for (const p of s.pairs) sizes.take("force", p.force);
    s.reactions.forEach((r) => sizes.take(kindOfSupport(r), r.value));
  }
  return sizes;
}

function endTables() {
  const steps = result.steps.slice(0, 24);
  if (steps.length < result.steps.length) cuts.add(`Tables have the ends of ${steps.length} of ${result.steps.length} steps.`);
  if (steps.length === 0) return [];
  const sizes = sizesOfSteps(steps);
  const quantities = Object.keys(steps[0].extremes);
  const force = (s) => {
    const p = largestBy(s.pairs, (q) => q.force);
    return p.force === 0 ? null : [sizes.cell("force", p.force, `pair ${p.pair}, ${placed(nameOf(p))}`)];
  };
  const reaction = (s) => {
    const r = largestBy(s.reactions, (q) => q.value);
    return [sizes.cell(kindOfSupport(r), r.value, `${ofMatrix ? "" : `${r.dof} at `}${placed(nameOf(r))}`)];
  };
  const [pairs, supports] = [structure.pairs.length > 0, structure.supports.length > 0];
  return [
    ...cutTable("Largest values at the end of each step",
      ["Step", "Share", ...quantities.map(quantityHead), ...(pairs ? [inUnit("Contact force", "force")] : []), ...(supports ? ["Reaction"] : []), "Certificate"],
      steps.map((s) => [stepName(s), s.fraction, ...quantities.map((name) => rangeCell(sizes, name, s.extremes[name])), ...(pairs ? [force(s)] : []),
        ...(supports ? [reaction(s)] : []), markOf(s.certificate)])),
    ...besideEachOther(steps, inUnit("Contact forces", "force"), ["Pair", ...placeHead, "Surface"],
      places.pairs.map((p) => [String(p.pair), ...placeCells(p), p.surface]), (s, i) => sizes.cell("force", s.pairs[i].force), true),
    ...besideEachOther(steps, "Reactions: what supports exert on the structure", [...placeHead, "What"], supportRows.map((s) => [...placeCells(s), whatHolds(s)]),
      (s, i) => sizes.cell(kindOfSupport(supportRows[i]), s.reactions[supportRows[i].number].value), false),
  ];
}
const whatHolds = (s) => (ofMatrix ? "" : inUnit(s.dof, s.dof === "w" ? "force" : "moment"));

// The ends of steps as columns, six in each table; rows that are 0 in all of them may be left out.
function besideEachOther(steps, title, names, begins, read, zerosLeftOut) {
  const rows = begins.map((begin, i) => ({ begin, cells: steps.map((s) => read(s, i)) }));
  const sizeOf = (r) => Math.max(...r.cells.map(([value]) => Math.abs(value)));
  const told = rows.filter((r) => !zerosLeftOut || sizeOf(r) > 0);
  const zeros = rows.length - told.length;
  const whole = zeros === 0 ? title : `${title}; ${zeros} that are 0 at all of these ends have no row`;
  if (zeros > 0) cuts.add(`${whole}.`);
  const tables = [];
  for (let from = 0; from < steps.length; from += 6) {
    const beside = steps.slice(from, from + 6).map((s) => `Step ${stepName(s)}`);
    tables.push(...cutTable(whole, [...names, ...beside], told, sizeOf, (r) => [...r.begin, ...r.cells.slice(from, from + 6).map((c) => [c])]));
  }
  return tables;
}

function envelopeTables({ states, pairs, reactions, ...ranges }) {
  const when = (v) => `step ${v.step}, increment ${v.increment}`;
  const timed = (value, v) => [[value, when(v), false]];
  const bound = (v) => [[v.value, `${placeOf(v)}; ${when(v)}`, false]];
  return [
    ...cutTable("Least and largest of all increments", ["Quantity", "Least", "Largest"],
      Object.entries(ranges).map(([name, range]) => [quantityHead(name), bound(range.min), bound(range.max)])),
    ...cutTable(inUnit("Largest contact force of each pair", "force"), ["Pair", ...placeHead, "Surface", "Largest"],
      pairs.map((p, i) => [String(p.pair), ...placeCells(places.pairs[i]), places.pairs[i].surface, timed(p.force_max, p)])),
    ...cutTable("Reactions: what supports exert on the structure", [...placeHead, "What", "Least", "Largest"],
      supportRows.map((s) => [...placeCells(s), whatHolds(s), timed(reactions[s.number].min.value, reactions[s.number].min), timed(reactions[s.number].max.value, reactions[s.number].max)])),
  ];
}

// Neighbouring entries that are alike are one row: "2..9".
function runs(list, alike) {
  const found = [];
  list.forEach((entry, i) => {
    const last = found[found.length - 1];
    if (last && alike(list[last[1]], entry)) last[1] = i;
    else found.push([i, i]);
  });
  return found;
}
const rangeWords = (first, last) => (first === last ? String(first) : `${first}..${last}`);

function structureTable() {
  if (ofMatrix) return cutTable("Structure from a matrix", ["Quantity", "Value"], [["Stiffness matrix", structure.matrix], ["Dofs", structure.dofs.length]]);
  if (beam) {
    return cutTable("Beam", ["Elements", inLength("From x"), inLength("to x"), inUnit("EI", "EI")],
      runs(structure.EI, (a, b) => a === b).map(([first, last]) => [rangeWords(first + 1, last + 1), beam.xs[first], beam.xs[last + 1], structure.EI[first]]));
  }
  const { columns, nodes, D, nu } = structure;
  const lines = (name, values) => [name, values.length, values[0], values[values.length - 1]];
  return cutTable("Plate", ["Quantity", "Value", inLength("From"), inLength("to")], [[inUnit("D", "moment"), D, null, null], ["Poisson's ratio", nu, null, null],
    lines("Grid lines along x", nodes.slice(0, columns).map((n) => n.x)), lines("Grid lines along y", nodes.filter((_, i) => i % columns === 0).map((n) => n.y))]);
}

function inputTables() {
  const spring = (s) => (s.spring === null ? "fixed" : short(s.spring));
  const loads = result.steps.flatMap((s) => loadRows(s));
  return [
    ...structureTable(),
    ...cutTable("Supports: fixed, or the stiffness of a spring", [...placeHead, "Dof", "Held"], supportRows.map((s) => [...placeCells(s), s.dof, spring(s)])),
    ...cutTable("Candidate pairs", ["Pair", ...placeHead, "Surface", inLength("Face"), inUnit("Stiffness", "stiffness"), "At the start"],
      places.pairs.map((p) => [String(p.pair), ...placeCells(p), p.surface, p.face, p.stiffness, p.state === "contact" ? "in contact" : "separated"])),
    ...cutTable("Loads and settlements at the ends of steps", ["Step", "What", "Where", "Value"], loads),
  ];
}

function loadRows(s) {
  const { uniform = [], point = [], settlement = [] } = s.load;
  const one = (kind) => (p) => {
    const name = Object.keys(p).find((key) => key !== "node" && key !== "dof");
    return [stepName(s), kind === "load" ? name : `${kind} ${name}`, placed(nameOf(p)), p[name]];
  };
  const polynomial = (a) => a.map((c, i) => `${short(c)}${i === 0 ? "" : i === 1 ? " x" : ` x^${i}`}`).join(" + ");
  const rows = [...uniform.map((d) => [stepName(s), beam ? "per length" : "pressure", `elements ${d.elements}`, d.polynomial ? polynomial(d.polynomial) : d.value]),
    ...point.map(one("load")), ...settlement.map(one("settlement"))];
  return rows.length > 0 ? rows : [[stepName(s), "resultant of all loads", "", s.load.force ?? s.load.sum]];
}

function showTables() {
  const shown = { input: inputTables(), ends: endTables(), envelope: result.envelope && result.envelope.states > 0 ? envelopeTables(result.envelope) : [] };
  for (const [name, tables] of Object.entries(shown)) {
    byId(name === "ends" ? "end-tables" : `${name}-tables`).replaceChildren(...tables);
    byId(name).hidden = tables.length === 0;
  }
}

// ---- the head of the page, and what stands still ----

function showHead() {
  const { file, date, units, words, status } = result;
  const block = [["Problem file", file === "-" ? "standard input" : file],
    ["Units", units ? `${units.length}, ${units.force}` : "as in the problem file, which names none"],
    ["Date of the run", date], ["Kernels", `${kernels.join(" and ")}, engine ${result.engine}`], ["Program", words.program.join(" · ")]];
  byId("title-block").replaceChildren(...block.filter(([, text]) => text)
    .map(([name, text]) => element("div", {}, element("dt", {}, name), element("dd", {}, text))));
  const size = mesh ? [counted(structure.nodes.length, "node"), counted(structure.edges.length, "edge"), counted(structure.dofs.length, "dof")]
    : ofMatrix ? [counted(structure.dofs.length, "dof")] : [counted(structure.nodes.length, "node"), counted(frames[frames.length - 1].elements.length, "element")];
  byId("size").textContent = [...size, counted(pairCount, "pair"), counted(result.steps.length, "load step"), counted(increments.length, "increment")].join(", ");
  const say = (text, kind) => byId("verdict").append(element("li", { class: kind }, text));
  say(words.end ? `Not solved: ${words.end}.` : "All load is applied.", words.end ? "bad" : "good");
  const equal = status !== "kernels-disagree";
  if (kernels.length < 2) say("One kernel ran; nothing was compared.", "note");
  else if (result.calls_made === 0) say("The kernels were never called; nothing was compared.", "note");
  else say(`${kernels.join(" and ")} ${result.lockstep ? (equal ? "are equal to the bit" : "are NOT equal to the bit") : equal ? "agree in free run" : "do NOT agree in free run"}: ${words.comparison}.`, equal ? "good" : "bad");
  if (words.certificate.length > 0) say(sentence(words.certificate.join("; ")), result.certified ? "good" : "bad");
  if (result.steps.some((s) => s.certificate)) {
    byId("mesh-words").textContent = "Certified means that these are the right numbers for this mesh. The error of the mesh itself is not judged.";
  }
}

function showLog() {
  byId("log-words").textContent = result.log === "" ? `${kernels[0]} wrote nothing to unit 26, or writes no text.` : `What ${kernels[0]} wrote to unit 26.`;
  byId("log-text").textContent = result.log;
  byId("log-text").hidden = result.log === "";
}

function showThinned() {
  for (const note of structure.notes || []) cuts.add(note);
  const within = increments.length + 1 + result.steps.filter((s) => !endsAt(s, s.increments.length - 1)).length;
  if (frames.length < within) cuts.add(`The path has ${increments.length} increments; the slider stops at ${frames.length} states: the start, some of the increments, evenly chosen, and the ends of steps.`);
  if (frames.some((f) => f.load.words !== "none" && f.load.words !== "" && !f.load.uniform && !f.load.point && !f.load.settlement)) cuts.add("Loads of more than 32 parts are not drawn: their sum is told.");
  if (result.log.length < result.log_bytes) cuts.add(`Of ${result.log_bytes} bytes of unit 26 the first ${result.log.length} are shown.`);
  const list = cuts.size > 0 ? [...cuts] : [`Nothing: every increment, ${unitOf}, pair and call is on this page.`];
  byId("thinned").replaceChildren(...list.map((text) => element("li", {}, text)));
}

// Which looks pairs have in any state.
const looksSeen = new Set(frames.flatMap((f) => f.pairs.map((p) => (p.look === "f" && p.closed ? "f in contact" : p.look))));

function faceMark() {
  const face = svg("g", {}, line(2, 8, 20, 8, "face-line"));
  for (let k = 4; k < 20; k += 6) face.append(line(k, 8, k - 4, 14, "hatch"));
  return face;
}

function showLegend() {
  const item = (words, ...marks) => {
    const s = svg("svg", { width: 22, height: 18, viewBox: "0 0 22 18", "aria-hidden": "true" }, ...marks);
    return element("li", {}, s, words);
  };
  const list = [];
  const looked = [["c", "in contact, with a force", "c"], ["o", "separated, with a gap", "o"], ["f", "at its face, separated", "f"], ["f in contact", "at its face, in contact, no force", "f"]];
  for (const [seen, words, look] of looked) {
    if (looksSeen.has(seen)) list.push(item(words, pairMark(look, 11, 9, 5, seen === "f in contact")));
  }
  const loaded = frames.some((f) => pointsOf(f).some((p) => p.value !== 0) || (f.load.uniform || []).length > 0);
  const pressed = frames.some((f) => f.pairs.some((p) => p.force > 0));
  if (beam) {
    if (pairCount > 0) list.push(item("face, hatched behind", faceMark()));
    if (pressed) list.push(item("contact force", arrow(11, 17, 0, -15, "force")));
    if (loaded) list.push(item("load", arrow(11, 1, 0, 15, "load")));
    list.push(item("undeformed", line(0, 9, 22, 9, "undeformed")));
    byId("picture-words").textContent = "Up is positive. Between two increments every point moves along a straight line. Numbers under supports are reactions. " +
      "Moments M = EI w\u2033 (positive where the beam sags) and shears V = dM/dx (the upward force of the part left of a cut on the part right of it) " +
      "are those of EI w\u2033\u2033 = q between the nodes too; dots are at the largest values.";
  } else if (mesh) {
    if (pairCount > 0) list.push(item("face, hatched behind", faceMark()));
    if (pressed) list.push(item("contact force", arrow(11, 17, 0, -15, "force")));
    if (loaded) list.push(item("load", arrow(11, 1, 0, 15, "load")));
    list.push(item("undeformed", line(0, 9, 22, 9, "mesh-was")));
    if (places.supports.length > 0) list.push(item("support of a dof", svg("path", { d: "M11 3l7 12h-14Z", class: "support" })));
    if (mesh.still.length > 0) list.push(item("node without a dof: it does not move", svg("path", { d: "M8 6l6 6m-6 0l6 -6", class: "thin" })));
    byId("picture-words").textContent = "Edges are drawn straight between their nodes. Between two increments every point moves along a straight line. " +
      "A face is drawn beside its node, across the direction of the pair's dof, at its distance from the undeformed node, magnified as displacements are.";
    byId("magnification-label").textContent = "Displacements drawn";
  } else if (!plate) {
    list.length = 0;
    byId("picture-words").textContent = "No coordinates of this structure are known, so it is not drawn. " +
      "[matrix] takes coordinates, [calculix] the mesh in CalculiX's input.";
    byId("magnification").parentElement.hidden = true;
  } else {
    const down = svg("g", { class: "load" }, svg("circle", { cx: 11, cy: 9, r: 7, "fill-opacity": 0 }), svg("path", { d: "M7 5l8 8m-8 0l8 -8" }));
    const up = svg("g", { class: "load" }, svg("circle", { cx: 11, cy: 9, r: 7, "fill-opacity": 0 }), svg("circle", { cx: 11, cy: 9, r: 2.5 }));
    const point = (sign) => frames.some((f) => pointsOf(f).some((p) => p.dof === "w" && sign * p.value > 0));
    const holds = (w) => places.supports.some((s) => s.dofs.some(([dof]) => dof === "w") === w);
    if (point(-1)) list.push(item("load, down", down));
    if (point(1)) list.push(item("load, up", up));
    if (holds(true)) list.push(item("support of w", svg("path", { d: "M11 3l6 11h-12Z", class: "support" })));
    if (plate.reaction > 0) list.push(item("reaction up, by its area", svg("circle", { cx: 11, cy: 9, r: 7, class: "reaction" })));
    if (holds(false)) list.push(item("support of a slope", svg("path", { d: "M8 6l6 6m-6 0l6 -6", class: "thin" })));
    byId("picture-words").textContent = "The colours are the same in all states: dark is low. Up is positive; moments are those of sagging, means of the elements at each node; between nodes colours are interpolated. The square of a pair in contact grows with its force; a bar over a pair means that its face is above.";
    byId("magnification").hidden = byId("magnification-label").hidden = true;
  }
  byId("legend").classList.toggle("on-map", Boolean(plate));
  byId("legend").replaceChildren(...list);
  byId("chart-words").textContent = "Lines are straight between events. Filled circles: pairs that make contact; rings: pairs that break it; squares: ends of steps.";
}

// ---- where we are ----

let current = 0;
let timer = 0;

function draw(f) {
  if (beam) drawBeam(f);
  else if (plate) drawPlate(f);
  else if (mesh) drawMesh(f);
}

function show(n) {
  current = Math.max(0, Math.min(frames.length - 1, n));
  const f = frames[current];
  const slider = byId("slider");
  slider.value = String(current);
  slider.setAttribute("aria-valuetext", `${where(f)}, state ${current + 1} of ${frames.length}`);
  byId("state").textContent = stateWords(f);
  draw(f);
  drawChart(current);
  showReadings(f);
  showPairs(f);
  markCurrentRow(f);
}

function stopPlaying() {
  clearInterval(timer);
  timer = 0;
  const play = byId("play");
  play.setAttribute("aria-pressed", "false");
  play.textContent = "Play";
}

function startPlaying() {
  const play = byId("play");
  play.setAttribute("aria-pressed", "true");
  play.textContent = "Pause";
  if (current === frames.length - 1) show(0);
  const step = () => {
    if (current >= frames.length - 1) return stopPlaying();
    show(current + 1);
  };
  timer = setInterval(step, calm.matches ? 1600 : 1100);
}

// On paper the final state, then the ends of the steps before it.
const mostPaperPictures = 6;

function drawForPaper() {
  stopPlaying();
  printing = true;
  const ends = frames.flatMap((f, i) => (f.end && i < frames.length - 1 && (mesh || !ofMatrix) ? [i] : []));
  byId("step-pictures").replaceChildren(...ends.slice(-mostPaperPictures).map((i) => {
    show(i);
    return element("figure", {}, element("div", { class: "picture" }, byId("picture").firstChild.cloneNode(true)), element("figcaption", {}, stateWords(frames[i])));
  }));
  byId("paper-words").textContent = "Not on paper, but in the page's file: the states between the ends of steps" +
    (ends.length > mostPaperPictures ? `, pictures of the first ${ends.length - mostPaperPictures} of ${ends.length + 1} ends` : "") +
    (plate ? `, of the plate all but ${field.words}` : "") +
    ", the pairs of each state, the kernels' calls and sources, unit 26" +
    (increments.length > mostPaperRows ? `, increments after the first ${mostPaperRows} of ${increments.length}` : "") + ".";
  show(frames.length - 1);
}

function listen() {
  const slider = byId("slider");
  slider.max = String(frames.length - 1);
  slider.addEventListener("input", () => { stopPlaying(); show(Number(slider.value)); });
  byId("first").addEventListener("click", () => { stopPlaying(); show(0); });
  byId("back").addEventListener("click", () => { stopPlaying(); show(current - 1); });
  byId("next").addEventListener("click", () => { stopPlaying(); show(current + 1); });
  byId("last").addEventListener("click", () => { stopPlaying(); show(frames.length - 1); });
  byId("play").addEventListener("click", () => (timer ? stopPlaying() : startPlaying()));
  byId("magnification").addEventListener("change", (e) => {
    magnification = e.target.value === "" ? null : Number(e.target.value);
    draw(frames[current]);
  });
  for (const [id, act] of [["zoom-in", () => zoom(0.5)], ["zoom-out", () => zoom(2)], ["whole", () => zoom(Infinity)],
    ["left", () => move(-(part[1] - part[0]) / 4)], ["right", () => move((part[1] - part[0]) / 4)]]) {
    byId(id).addEventListener("click", act);
  }
  byId("zooming").hidden = !beam;
  let width = innerWidth;
  addEventListener("resize", () => {
    if (innerWidth === width) return;
    width = innerWidth;
    show(current);
  });
  addEventListener("beforeprint", drawForPaper);
  addEventListener("afterprint", () => { printing = false; byId("step-pictures").replaceChildren(); show(current); });
}

showHead();
showTables();
offerViews();
offerFields();
offerPaths();
showLegend();
showEvents();
showCalls();
showCertificate();
showLog();
listen();
showThinned();
show(frames.reduce((best, f, i) => (Math.abs(mostOf(f).value) > Math.abs(mostOf(frames[best]).value) ? i : best), frames.length - 1));
