// The picture of the structure in one state of a result: a beam with its moments and shears, a plate from above, or
// what a matrix comes from, where its nodes have places. The report and the playground draw with it.
"use strict";

// ---- words and numbers ----

const minus = (text) => text.replace(/-/g, "\u2212");
const digits = (x, count) => minus(String(Number(x.toPrecision(count))));
// Seven digits for people; the whole number stands in the title and in data-value.
const short = (x) => (x === null || x === undefined ? "–" : digits(x, 7));
const rough = (x) => digits(x, 4);
const counted = (n, what) => `${n.toLocaleString("en")} ${what}${n === 1 ? "" : "s"}`;
const sentence = (text) => text[0].toUpperCase() + text.slice(1) + ".";
// What moves and how it is named: "deflection w of node 3", "displacement of dof 6.y".
const moves = () => (ofMatrix ? "displacement" : "deflection");
const unitOf = () => (ofMatrix ? "dof" : "node");
const placed = (name) => `${unitOf()} ${name}`;

// A unit, by its powers of force and length; none where the problem names none. A plate's moments are per length.
const powers = { w: [0, 1], force: [1, 0], moment: [1, 1], shear: [1, 0], pressure: [1, -2], stiffness: [1, -1], EI: [1, 2] };
function unit(quantity) {
  if (!result.units || !(quantity in powers || /^m[xy]/.test(quantity))) return "";
  const { length, force } = result.units;
  if (!(quantity in powers)) return `${force} ${length}/${length}`;
  const [f, l] = powers[quantity];
  const of = l === 0 ? "" : length + ["", "", "²"][Math.abs(l)];
  return f === 0 ? of : force + (l === 0 ? "" : l > 0 ? " " : "/") + of;
}
const inUnit = (name, quantity) => name + (unit(quantity) ? ` [${unit(quantity)}]` : "");

// Where a value of the extremes is: at a node, or between two of a beam's.
function placeOf(v) {
  if (v.dof !== undefined) return placed(v.dof);
  const node = structure.nodes.find((n) => n.x === v.x && (v.y === undefined || n.y === v.y));
  return node === undefined ? `x = ${rough(v.x)}` : placed(node.node);
}
const largestOf = (range) => (-range.min.value > range.max.value ? range.min : range.max);
// The largest deflection, inside a beam's elements too.
const mostOf = (f) => (f.extremes.w ? largestOf(f.extremes.w) : { value: 0, ...(ofMatrix ? structure.dofs[0] : structure.nodes[0]) });

const looks = { o: "separated", c: "in contact", f: "at its face" };
const lookWords = (p) => (p.look === "f" ? `at its face, ${p.closed ? "in contact" : "separated"}` : looks[p.look]);
const pairWords = (p) => `Pair ${p.pair}, ${placed(p.name)}, face ${p.surface} at ${short(p.face)}, ${lookWords(p)}: ` +
  (p.closed ? `force ${short(p.force)}` : `gap ${short(p.gap)}`);
const supportWords = (f, s) => `Support at ${placed(s.name)}: ` +
  s.dofs.map(([dof, spring]) => (spring === null ? `${dof} fixed` : `${dof} on a spring of ${short(spring)}`)).join(", ") +
  (reactionAt(f, s) === null ? "" : `; reaction ${short(reactionAt(f, s))}`);
const eventWords = (e) => `pair ${e.pair} ${e.change === "make" ? "makes" : "breaks"} contact (${placed(nameOf(e))}, ${e.surface})`;

function allEventWords(events, most = 8) {
  const named = events.slice(0, most).map(eventWords);
  if (events.length > most) named.push(`and ${events.length - most} more`);
  return named.join("; ");
}

// A state in words, read aloud when it changes.
function stateWords(f) {
  const [open, closed, atFace] = ["o", "c", "f"].map((look) => f.pairs.filter((p) => p.look === look).length);
  const place = f.step === 0 ? "Before any load."
    : `Step ${f.step}${f.number > 0 ? `, increment ${f.number}` : ""}: ${f.snap ? "a rigid-body motion at constant load; " : ""}` +
      `load: ${minus(f.load.words)}, share ${short(f.fraction)} of the step.`;
  const end = !f.end ? "" : f.fraction < 1 ? " The path ends here." : " The step's load is applied.";
  const event = f.events.length > 0 ? ` Then ${allEventWords(f.events, 3)}.` : end;
  const fallback = f.exact ? " This state is the end of the exact path: the path in doubles could not reach it."
    : f.from_fallback ? " This state is the reference solution: the path could not reach it." : "";
  const pairs = f.pairs.length === 0 ? " There are no contact pairs."
    : ` ${counted(closed, "pair")} in contact, ${open} separated, ${atFace} at ${atFace === 1 ? "its face" : "their faces"}.`;
  return `${place}${event}${fallback}${pairs} Largest ${moves()} ${short(mostOf(f).value)} at ${placeOf(mostOf(f))}.`;
}

// ---- of very many things some are drawn ----

const cuts = new Set();  // what the page leaves out, in words

// `count` numbers from 0 to `all` - 1, evenly, the first and the last among them; all where there are no more.
const evenly = (all, count) => Array.from({ length: Math.min(all, count) }, (_, i) => (all <= count ? i : Math.floor((i * (all - 1)) / (count - 1))));

function some(what, all, most) {
  if (all > most) cuts.add(`${most} of ${all} ${what} are drawn, evenly chosen. The largest values are those of all.`);
  return evenly(all, most);
}

// ---- SVG ----

function svg(name, attributes = {}, ...children) {
  const e = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) {
    e.setAttribute(key, typeof value === "number" ? String(Math.round(value * 100) / 100) : value);
  }
  e.append(...children);
  return e;
}

const line = (x1, y1, x2, y2, kind) => svg("line", { x1, y1, x2, y2, class: kind });
const label = (x, y, words, attributes = {}) => svg("text", { x, y, ...attributes }, words);
const axisWord = (x, y, words, anchor = "middle") => label(x, y, words, { "text-anchor": anchor, class: "axis-word" });
const panelTitle = (x, y, words) => label(x, y, words, { class: "panel-title" });
const shape = (d, kind, more = {}) => svg("path", { d, class: kind, ...more });
const lineTo = (points) => "M" + points.map(([x, y]) => `${x.toFixed(2)} ${y.toFixed(2)}`).join("L");
const path = (points, kind, end = "") => shape(lineTo(points) + end, kind);
// Shapes that tell what they are when the pointer is over them.
const titled = (words, ...shapes) => svg("g", {}, svg("title", {}, words), ...shapes);

function canvas(holder, width, height, title) {
  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "img", "aria-label": title });
  holder.replaceChildren(root);
  return root;
}

// On paper pictures have a width of their own, at which their words are as large as the text around.
let printing = false;
const widthOf = (holder) => (printing ? 940 : Math.max(320, holder.clientWidth));

// One of these digits times a power of ten, not above x.
function roundDown(x, leading = [1, 2, 5]) {
  const power = 10 ** Math.floor(Math.log10(x));
  return Number((Math.max(...leading.filter((d) => d * power <= x * (1 + 1e-12)), 1) * power).toPrecision(3));
}
// 1, 2 or 5 times a power of ten, not below x.
function roundUp(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return Number(([1, 2, 5, 10].find((d) => d * power >= x * (1 - 1e-12)) * power).toPrecision(3));
}
// How many times larger than they are displacements of `most` can be drawn in `room`.
const magnificationFor = (most, room) => (most > 0 && room > 0 ? roundDown(room / most, [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8]) : 1);
const timesWords = (factor) => `× ${factor.toLocaleString("en", { maximumSignificantDigits: 3 })}`;

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

// Grid lines with their numbers: up the left side of what is drawn, and along its bottom.
function scaleUp(root, values, Y, left, right, away = 16) {
  for (const v of values) {
    root.append(line(left, Y(v), right, Y(v), v === 0 ? "zero" : "grid"),
      axisWord(left - away, Y(v) + 4, rough(v), "end"));
  }
}
function scaleAlong(root, values, X, bottom, top = bottom + 5) {
  for (const v of values) {
    root.append(line(X(v), top, X(v), bottom, v === 0 || top > bottom ? "zero" : "grid"),
      axisWord(X(v), bottom + 19, rough(v)));
  }
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

// The looks differ in shape: open is a ring, closed a square, at its face a diamond, full when in contact.
function pairMark(look, x, y, r, closed = false) {
  if (look === "o") return svg("circle", { cx: x, cy: y, r, class: "pair-open" });
  if (look === "c") return svg("rect", { x: x - r, y: y - r, width: 2 * r, height: 2 * r, class: "pair-closed" });
  const d = r * 1.3;
  return shape(`M${x} ${y - d}L${x + d} ${y}L${x} ${y + d}L${x - d} ${y}Z`, closed ? "pair-face in-contact" : "pair-face");
}

// A word where no other stands, and inside the picture, to the right of `left`; otherwise none.
function wordsInFreePlaces(root, width, height, left = 2) {
  const boxes = [];
  return (at, y, words, kind) => {
    const half = 4.4 * words.length + 2;
    const x = Math.min(Math.max(at, left + half), width - 2 - half);
    const box = [x - half, y - 13, x + half, y + 5];
    const free = box[1] >= 24 && box[3] <= height - 4 &&
      boxes.every((b) => b[0] >= box[2] || b[2] <= box[0] || b[1] >= box[3] || b[3] <= box[1]);
    if (!free) return;
    boxes.push(box);
    root.append(label(x, y, words, { "text-anchor": "middle", class: `${kind} halo` }));
  };
}

// ---- pairs, supports and loads of a beam and of a structure by its matrix ----
//
// `view` says where they are on the page. spot(p): where the node is now. along(p): the dof's positive direction, of
// length 1; null where it has none on the page. pixels(p): pixels for a displacement of 1 in that direction. say: see
// wordsInFreePlaces. r, half: sizes of marks and of half a face. limits: how far from its node's first place a face is
// drawn. force, point: the largest contact force and concentrated load in all states.

let drawnPairs = [], drawnSupports = [];
const pairsOf = (f) => drawnPairs.map((i) => f.pairs[i]);

// Several pairs may stand at one node: their marks are drawn one over another, the one that carries most last.
const drawingOrder = { o: 0, f: 1, c: 2 };
const leastLoadedFirst = (pairs) => [...pairs].sort((a, b) => drawingOrder[a.look] - drawingOrder[b.look] || Math.abs(a.force) - Math.abs(b.force));

function drawPairs(root, pairs, view) {
  const marks = [];
  for (const p of leastLoadedFirst(pairs)) {
    const [[x, y], t] = [view.spot(p), view.along(p)];
    if (t !== null) drawFace(root, p, [x, y], t, view, pairs.length <= 60);
    else if (pairs.length <= 60) view.say(x + 13, y - 8, String(p.pair), "axis-word");
    const mark = pairMark(p.look, x, y, view.r, p.closed);
    mark.append(svg("title", {}, pairWords(p)));
    marks.push(mark);
  }
  root.append(...marks);
}

// The face stands across the pair's direction, as far from where the node was as c is, hatched on the far side; dashed
// where that is farther than is drawn. From it the contact force.
function drawFace(root, p, [x, y], t, view, numbered) {
  const node = view.pixels(p) * p.w;
  const along = view.pixels(p) * p.face;
  const face = Math.max(view.limits[0], Math.min(view.limits[1], along));
  const at = (a, across = 0) => [x + (a - node) * t[0] - across * t[1], y + (a - node) * t[1] + across * t[0]];
  const { half } = view;
  root.append(line(...at(face, -half), ...at(face, half), "face-line" + (face === along ? "" : " far")));
  if (half >= 5) for (let k = -half + 2; k < half; k += 6) root.append(line(...at(face, k), ...at(face + p.side * 6, k - 4), "hatch"));
  if (p.closed && Math.abs(face - node) > 8) root.append(line(...at(face), x, y, "spring"));
  // Beyond the face's hatches and the node's mark, which may have pressed the spring past its face.
  const tip = p.side > 0 ? Math.max(face + 10, node + view.r + 3) : Math.min(face - 10, node - view.r - 3);
  const length = view.force > 0 ? (36 * Math.abs(p.force)) / view.force : 0;
  const start = tip + p.side * length;
  if (p.force > 0) root.append(arrow(...at(start), -p.side * length * t[0], -p.side * length * t[1], "force"));
  if (!numbered) return;
  const word = ([a, b], words, kind) => view.say(a, b + 4, words, kind);
  word(at(start + p.side * 11), String(p.pair), "axis-word");
  if (p.look === "c") word(at(start + p.side * 30), rough(p.force), "value");
}

function supportMark([x, y], t, spring) {
  const at = (along, across) => `${(x - along * t[0] + across * t[1]).toFixed(1)} ${(y - along * t[1] - across * t[0]).toFixed(1)}`;
  if (drawnSupports.length > 40) return shape(`M${at(4, 0)}L${at(spring === null ? 14 : 9, 0)}`, spring === null ? "support" : "thin");
  if (spring === null) return shape(`M${at(2, 0)}L${at(16, 8)}L${at(16, -8)}Z`, "support");
  return shape(`M${at(2, 0)}L${at(4, 5)}L${at(8, -5)}L${at(12, 5)}L${at(16, -5)}L${at(18, 0)}M${at(18, 8)}L${at(18, -8)}`, "thin");
}

function drawSupports(root, f, supports, view) {
  for (const s of supports) {
    const [[x, y], t] = [view.spot(s), view.along(s)];
    const held = s.dofs.filter(([dof]) => dof === "w" || ofMatrix).map(([, own]) => own);
    const spring = held.includes(null) ? null : held[0];
    const turns = s.dofs.some(([dof, own]) => dof === "theta" && own === null);
    const mark = turns && spring === null ? shape(`M${x} ${y - 20}v40` + [-16, -8, 0, 8, 16].map((k) => `M${x} ${y + k}l${view.outwards(s) * 8} -8`).join(""), "wall")
      : t === null || spring === undefined ? svg("rect", { x: x - 6, y: y - 6, width: 12, height: 12, class: "support", "fill-opacity": 0 })
        : supportMark([x, y], t, spring);
    root.append(titled(supportWords(f, s), mark));
    const reaction = reactionAt(f, s);
    if (t !== null && reaction && drawnSupports.length <= 40) view.say(x - 36 * t[0], y - 36 * t[1] + 4, rough(reaction), "value reaction-value");
  }
}

// Concentrated loads as arrows or, about an axis, as arcs.
function drawPoints(root, points, view) {
  for (const p of points) {
    const [[x, y], t] = [view.spot(p), view.along(p)];
    const words = `Load ${short(p.value)} at ${placed(p.name)}`;
    if (t === null) {
      root.append(titled(words, shape(`M${x + 13} ${y + 7}A15 15 0 1 1 ${x + 13} ${y - 7}`, "load-line", { "stroke-width": 2 })));
      view.say(x, y - 20, `${rough(p.value)} ${p.value > 0 ? "↺" : "↻"}`, "value");
      continue;
    }
    const size = (42 * p.value) / view.point;
    const away = size + (size > 0 ? 8 : -8);
    root.append(titled(words, arrow(x - away * t[0], y - away * t[1], size * t[0], size * t[1], "load")));
    const beyond = away + (size > 0 ? 11 : -11);
    view.say(x - beyond * t[0], y - beyond * t[1] + 4, rough(p.value), "value");
  }
}

// ---- the beam ----

const margin = { left: 74, right: 26 };
let beam = null;  // what the pictures of a beam have in common
let beamScale = null;  // of the last picture: X, Y, pixels for a deflection of 1, and where faces are drawn
let heldRange = null;  // of deflections: while the playground's user drags a face, the picture keeps its scale

function beamOf() {
  const xs = structure.nodes.map((n) => n.x);
  const [low, high] = rangeOf("w");
  const reach = Math.max(-low, high);
  const [least, most] = heldRange || spread([low, high, ...places.pairs.map((p) => p.face).filter((face) => reach === 0 || Math.abs(face) <= 2.5 * reach)]);
  return {
    xs, low: least, high: most, from: xs[0], to: xs[xs.length - 1],
    stations: some("nodes", xs.length, 1000),
    point: largest((f) => pointsOf(f).filter((p) => p.dof === "w").map((p) => p.value)),
    spread: largest((f) => { const q = lineLoadOf(f); return q ? xs.slice(1).flatMap((x, e) => [q(e, xs[e]), q(e, x)]) : []; }),
    force: largest((f) => f.pairs.map((p) => p.force)),
    strips: { moment: rangeOf("moment"), shear: rangeOf("shear") },
  };
}

// Places along the beam, nodes and places between: [element, share].
function placesAlong() {
  const { xs, stations } = beam;
  const pieces = stations.length < xs.length ? 1 : Math.ceil(240 / xs.length);
  return [...stations.slice(0, -1).flatMap((e) => Array.from({ length: pieces }, (_, k) => [e, k / pieces])), [xs.length - 2, 1]];
}
const xAt = ([e, share]) => (share === 1 ? beam.xs[e + 1] : beam.xs[e] + share * (beam.xs[e + 1] - beam.xs[e]));

// The distributed load above or below the beam, as large as it is there.
function drawLineLoad(root, f, X, Y) {
  const load = lineLoadOf(f);
  if (load === null || beam.spread === 0) return;
  const spot = (e, x) => {
    const size = (25 * load(e, x)) / beam.spread;
    return { x: X(x), y: Y(deflectionAt(f, x, e)) + (size > 0 ? 8 : -8), size };
  };
  const pieces = [];
  placesAlong().forEach(([e, a], i, all) => {
    if (i + 1 === all.length) return;
    const [next, share] = all[i + 1];
    const [from, to] = [spot(e, xAt([e, a])), spot(e, xAt([e, next === e ? share : 1]))];
    if (from.size !== 0 || to.size !== 0) pieces.push(lineTo([[from.x, from.y + from.size], [to.x, to.y + to.size]]));
  });
  root.append(shape(pieces.join(""), "load-line"));
  const arrows = Math.ceil((X(beam.to) - X(beam.from)) / 34);
  for (let i = 0; i < arrows; ++i) {
    const x = beam.from + ((i + 0.5) / arrows) * (beam.to - beam.from);
    const at = spot(elementAt(x), x);
    if (Math.abs(at.size) > 3) root.append(arrow(at.x, at.y + at.size, 0, -at.size, "load"));
  }
}

// A strip under the beam with a quantity that may jump at the nodes.
function drawStrip(root, f, X, top, height, name, title) {
  const range = f.extremes[name] || { min: { value: 0, x: beam.from }, max: { value: 0, x: beam.from } };
  const [low, high] = beam.strips[name];
  const Y = (v) => top + 24 + ((high - v) / (high - low || 1)) * (height - 34);
  scaleUp(root, [...new Set([0, ...ticks(low, high, 4)])], Y, margin.left, X(beam.to));
  const points = placesAlong().flatMap(([e, a], i) => {
    const here = [X(xAt([e, a])), Y(forceAt(f, name, [e, a]))];
    return i === 0 || a !== 0 ? [here] : [[here[0], Y(forceAt(f, name, [e - 1, 1]))], here];
  });
  // The least and the largest value may be between these places.
  const ends = [range.max, range.min].sort((a, b) => Math.abs(b.value) - Math.abs(a.value));
  for (const v of ends) {
    const after = points.findIndex(([x]) => x > X(v.x));
    if (after > 0 && !beam.xs.includes(v.x)) points.splice(after, 0, [X(v.x), Y(v.value)]);
  }
  root.append(path([[X(beam.from), Y(0)], ...points, [X(beam.to), Y(0)]], name + "-area", "Z"), path(points, name),
    panelTitle(margin.left, top + 12, title));
  const told = ends.filter((v, i) => i === 0 || v.value * ends[0].value < -1e-9 * ends[0].value ** 2);
  for (const v of told) root.append(svg("circle", { cx: X(v.x), cy: Y(v.value), r: 3, class: "dot-" + name }));
  const words = told.slice(0, X(beam.to) < 600 ? 1 : 2).map((v) => `${digits(v.value, 5)} at x = ${digits(v.x, 5)}`);
  root.append(label(X(beam.to), top + 12, words.join("; "), { "text-anchor": "end", class: "value" }));
}

function drawBeam(f, holder) {
  const width = widthOf(holder);
  const room = width < 520 ? 150 : 190;  // for deflections
  const [above, below] = [-1, 1].map((side) => (places.pairs.some((p) => p.side === -side) ? 92 : 74));  // for loads and pairs' forces
  const scale = (width - margin.left - margin.right) / (beam.to - beam.from);
  const factor = magnificationFor(beam.high - beam.low, room / scale);
  const pixels = factor * scale;
  const middle = (beam.high + beam.low) / 2;
  const X = (x) => margin.left + (x - beam.from) * scale;
  const Y = (w) => above + room / 2 - (w - middle) * pixels;
  const bottom = above + room + below;
  beamScale = { X, Y, pixels, top: 28, bottom: bottom - 8 };
  const strip = 126;
  const root = canvas(holder, width, bottom + 30 + 2 * (strip + 14), stateWords(f));
  root.append(panelTitle(margin.left, 16, `${inUnit("Deflection", "w")}, drawn ${timesWords(factor)}`));
  const reach = room / 2 / pixels;
  scaleUp(root, ticks(middle - reach, middle + reach, 4), Y, margin.left, X(beam.to));
  root.append(line(X(beam.from), bottom, X(beam.to), bottom, "zero"), line(X(beam.from), Y(0), X(beam.to), Y(0), "undeformed"),
    path(placesAlong().map((at) => [X(xAt(at)), Y(deflectionAt(f, xAt(at), at[0]))]), "beam"));
  const pairs = pairsOf(f);
  const gaps = pairs.map((p) => X(p.x)).sort((a, b) => a - b).flatMap((x, i, all) => (i > 0 && x - all[i - 1] > 0.01 ? [x - all[i - 1]] : []));
  const apart = gaps.length > 0 ? Math.min(...gaps) : 60;
  const view = {
    spot: ({ x }) => [X(x), Y(deflectionAt(f, x))], along: ({ dof }) => (dof === "theta" ? null : [0, -1]), pixels: () => pixels,
    limits: [Y(0) - beamScale.bottom, Y(0) - beamScale.top], r: Math.max(1.6, Math.min(5, apart * 0.3)), half: Math.max(1, Math.min(16, apart * 0.36)),
    force: beam.force, point: beam.point, say: wordsInFreePlaces(root, width, bottom, margin.left - 12), outwards: (s) => (s.x - beam.from < beam.to - s.x ? -1 : 1),
  };
  drawLineLoad(root, f, X, Y);
  drawPoints(root, pointsOf(f).filter((p) => p.value !== 0).map((p) => ({ ...p, x: beam.xs[p.name - 1] })), view);
  drawPairs(root, pairs, view);
  drawSupports(root, f, drawnSupports, view);
  scaleAlong(root, ticks(beam.from, beam.to, Math.floor(width / 75)), X, bottom);
  const wide = width >= 620;
  drawStrip(root, f, X, bottom + 36, strip, "moment", inUnit(wide ? "Moment, positive where it sags" : "M", "moment"));
  drawStrip(root, f, X, bottom + 36 + strip + 14, strip, "shear", inUnit(wide ? "Shear, of the left part on the right" : "V", "shear"));
}

// ---- the plate ----

let plate = null;   // grid lines that are drawn, and the nodes where they cross, row by row
let fields = [];    // what can be shown of a plate
let field = null;   // what is shown

function plateOf() {
  const count = structure.columns;
  const [columns, rows] = [some("grid lines along y", count, 40), some("grid lines along x", structure.nodes.length / count, 40)];
  return {
    x: columns.map((i) => structure.nodes[i].x), y: rows.map((j) => structure.nodes[j * count].y),
    crossings: rows.flatMap((j) => columns.map((i) => j * count + i)),
    force: largest((f) => f.pairs.map((p) => Math.max(0, p.force))),
    reaction: largest((f) => places.supports.map((s) => reactionAt(f, s) || 0)),
  };
}

// With levels that are the same in all states.
function fieldsOf() {
  const known = { w: "deflection w", mx: "moment mx", my: "moment my", mxy: "twisting moment mxy" };
  if (structure.pairs.some((p) => p.bed)) known.pressure = "foundation pressure";
  return Object.entries(known).map(([name, words]) => {
    const [low, high] = spread(frames.flatMap((f) => spread(atCrossings(f, name))));
    const step = high > low ? roundDown(((high - low) / 9) * 1.3, [1, 2, 2.5, 5]) : 1;
    const base = Math.floor(low / step + 1e-9);
    return { name, words, step, level: (i) => (base + i) * step, bands: Math.max(1, Math.ceil(high / step - 1e-9) - base) };
  });
}

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

// From deep blue, the lowest, to pale, the highest; light changes all along, so that grey prints tell too.
function bandColour(i) {
  const share = field.bands > 1 ? i / (field.bands - 1) : 0.5;
  const stops = [[22, 52, 98], [38, 104, 160], [104, 165, 200], [178, 210, 222], [250, 244, 228]];
  const at = share * (stops.length - 1);
  const k = Math.min(stops.length - 2, Math.floor(at));
  const mix = stops[k].map((c, j) => Math.round(c + (stops[k + 1][j] - c) * (at - k)));
  return `rgb(${mix.join(",")})`;
}

// Places in the middle of `count` equal parts of a side, as [grid line before, share of the way to the next].
function between(lines, count) {
  const [from, to] = [lines[0], lines[lines.length - 1]];
  let i = 0;
  return Array.from({ length: count }, (_, k) => {
    const at = from + ((k + 0.5) / count) * (to - from);
    while (i + 2 < lines.length && lines[i + 1] < at) ++i;
    return [i, (at - lines[i]) / (lines[i + 1] - lines[i])];
  });
}

// The field in rows of pixels, bilinear between grid lines. A row is cut where its colour changes.
function drawMap(root, f, x, y, width, height) {
  const values = atCrossings(f, field.name);
  const count = plate.x.length;
  const [columns, rows] = [between(plate.x, Math.ceil(width / 2)), between(plate.y, Math.ceil(height / 2))];
  const [dx, dy] = [width / columns.length, height / rows.length];
  const bands = Array.from({ length: field.bands }, () => []);
  rows.forEach(([j, b], row) => {
    const along = Array.from({ length: count }, (_, i) => values[j * count + i] * (1 - b) + values[(j + 1) * count + i] * b);
    const bandOf = ([i, a]) => Math.max(0, Math.min(field.bands - 1, Math.floor((along[i] * (1 - a) + along[i + 1] * a - field.level(0)) / field.step)));
    for (let from = 0; from < columns.length;) {
      const band = bandOf(columns[from]);
      let to = from + 1;
      while (to < columns.length && bandOf(columns[to]) === band) ++to;
      const [left, top, wide] = [x + from * dx, y + height - (row + 1) * dy, (to - from) * dx].map((v) => v.toFixed(1));
      bands[band].push(`M${left} ${top}h${wide}v${dy.toFixed(1)}h-${wide}Z`);
      from = to;
    }
  });
  bands.forEach((d, i) => { if (d.length > 0) root.append(svg("path", { d: d.join(""), fill: bandColour(i), stroke: bandColour(i), "stroke-width": 0.7 })); });
}

function drawPlate(f, holder) {
  const width = widthOf(holder);
  const [x0, x1] = spread(plate.x);
  const [y0, y1] = spread(plate.y);
  const room = { left: 62, right: 24, top: 34, bottom: 96 };
  const scale = Math.min((width - room.left - room.right) / (x1 - x0), 520 / (y1 - y0));
  const height = room.top + room.bottom + (y1 - y0) * scale;
  const left = room.left + (width - room.left - room.right - (x1 - x0) * scale) / 2;
  const X = (x) => left + (x - x0) * scale;
  const Y = (y) => room.top + (y1 - y) * scale;
  const root = canvas(holder, width, height, stateWords(f));
  root.append(panelTitle(left, 18, sentence(field.words).slice(0, -1)));
  drawMap(root, f, X(x0), Y(y1), X(x1) - X(x0), Y(y0) - Y(y1));
  root.append(svg("rect", { x: X(x0), y: Y(y1), width: X(x1) - X(x0), height: Y(y0) - Y(y1), class: "edge" }));
  scaleAlong(root, ticks(x0, x1, 6), X, Y(y0));
  scaleUp(root, ticks(y0, y1, 6), Y, X(x0), X(x0), 9);
  root.append(axisWord(X(x1) + 8, Y(y0) + 36, "x", "end"),
    axisWord(X(x0) - 9, Y(y1) - 14, "y", "end"));
  const over = svg("g", { class: "on-map" });
  root.append(over);
  drawPlateSupports(over, f, X, Y);
  drawPlatePairs(over, f, X, Y);
  drawPlateLoads(over, f, X, Y);
  drawColours(root, room.left, height - 40, width - room.left - room.right);
}

// With a ring whose area goes with the reaction.
function drawPlateSupports(root, f, X, Y) {
  for (const s of drawnSupports) {
    const reaction = reactionAt(f, s);
    const [x, y] = [X(s.x), Y(s.y)];
    const size = plate.reaction > 0 ? 14 * Math.sqrt(Math.abs(reaction || 0) / plate.reaction) : 0;
    root.append(titled(supportWords(f, s), ...(size > 2 ? [svg("circle", { cx: x, cy: y, r: size, class: reaction > 0 ? "reaction" : "reaction down" })] : []),
      s.dofs.some(([dof]) => dof === "w") ? shape(`M${x} ${y - 5}l5 9h-10Z`, "support") : shape(`M${x - 3} ${y - 3}l6 6m-6 0l6 -6`, "thin")));
  }
}

function drawPlatePairs(root, f, X, Y) {
  const pairs = pairsOf(f);
  const xs = [...new Set(pairs.map((p) => X(p.x)))].sort((a, b) => a - b);
  const room = xs.length > 1 ? Math.min(...xs.slice(1).map((x, i) => x - xs[i])) : 40;
  const most = Math.max(1.6, Math.min(9, room * 0.38));
  for (const p of leastLoadedFirst(pairs)) {
    const grown = p.look === "c" && plate.force > 0 ? 0.35 + 0.65 * Math.sqrt(Math.max(0, p.force) / plate.force) : 0.5;
    const [x, y, r] = [X(p.x), Y(p.y), Math.max(1.5, most * grown)];
    const mark = pairMark(p.look, x, y, r, p.closed);
    mark.append(svg("title", {}, pairWords(p)));
    root.append(mark);
    if (p.side > 0 && most > 3) root.append(shape(`M${x - r - 1} ${y - r - 3}h${2 * r + 2}`, "face-line"));
  }
}

// A load that acts away from who looks at it is a cross, one towards them a dot.
const plateLoad = (x, y, down, r = 8) => svg("g", { class: "load" }, svg("circle", { cx: x, cy: y, r, "fill-opacity": 0, "stroke-width": 2 }),
  down ? shape(`M${x - 5} ${y - 5}l10 10m-10 0l10 -10`, "") : svg("circle", { cx: x, cy: y, r: 2.5 }));

function drawPlateLoads(root, f, X, Y) {
  for (const { name, dof, value } of pointsOf(f)) {
    if (dof !== "w" || value === 0) continue;
    const { x, y } = structure.nodes[name - 1];
    root.append(titled(`Load ${short(value)} at node ${name}`, plateLoad(X(x), Y(y), value < 0)));
  }
}

function drawColours(root, x, y, width) {
  const { bands } = field;
  for (let i = 0; i < bands; ++i) root.append(svg("rect", { x: x + (width * i) / bands, y, width: width / bands + 0.5, height: 14, fill: bandColour(i) }));
  root.append(svg("rect", { x, y, width, height: 14, fill: "none", class: "zero" }),
    panelTitle(x, y - 6, inUnit(field.name === "pressure" ? "p" : field.name, field.name)));
  const every = Math.ceil((bands * 75) / width);
  for (let i = 0; i <= bands; i += every) root.append(axisWord(x + (width * i) / bands, y + 30, rough(field.level(i))));
}

// ---- a structure by its matrix, where its nodes have places ----

// Directions of view: unit vectors in space that point right and up on the page.
const views = [
  { words: "x to the right, y up", right: [1, 0, 0], up: [0, 1, 0] },
  { words: "x to the right, z up", right: [1, 0, 0], up: [0, 0, 1] },
  { words: "y to the right, z up", right: [0, 1, 0], up: [0, 0, 1] },
  // The eye is at (3, -6, 3), nearly: right and up are at right angles, and of length 1.
  { words: "oblique, z up", right: [0.8944, 0.4472, 0], up: [-0.1826, 0.3651, 0.9129] },
];
let view = 0;
let mesh = null;

function meshOf() {
  const { nodes, dofs } = structure;
  const along = nodes.map(() => [-1, -1, -1]);  // the dof of a node along each axis
  const held = nodes.map(() => false);
  dofs.forEach((d, i) => {
    if (d.at === null) return;
    held[d.at - 1] = true;
    if (d.direction <= 3) along[d.at - 1][d.direction - 1] = i;
  });
  const [edges, drawn] = drawnEdges();
  const named = new Map(dofs.map((d) => [d.dof, d]));
  const points = (f) => pointsOf(f).map((p) => ({ ...p, ...named.get(p.name) })).filter((p) => p.at !== null && p.value !== 0).map((p) => ({ ...p, at: p.at - 1 }));
  return {
    along, edges, drawn, at: nodes.map((n) => [n.x, n.y, n.z]),
    axes: [0, 1, 2].filter((axis) => along.some((of) => of[axis] >= 0)),
    still: drawn.filter((i) => !held[i]),
    points,
    reach: largest((f) => drawn.map((i) => Math.hypot(...along[i].map((dof) => (dof < 0 ? 0 : f.u[dof]))))),
    force: largest((f) => f.pairs.map((p) => Math.max(0, p.force))),
    point: largest((f) => points(f).filter((p) => p.direction <= 3).map((p) => p.value)),
  };
}

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

// Straight on where one coordinate is the same for all nodes and none of them can leave that plane, else oblique.
function fittingView() {
  const flat = (axis) => !mesh.axes.includes(axis) && mesh.at.every((at) => at[axis] === mesh.at[0][axis]);
  const found = [2, 1, 0].findIndex(flat);
  return found < 0 ? 3 : found;
}

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
  const factor = magnificationFor(mesh.reach, 0.12 * size);
  const room = Math.max(factor * mesh.reach, 0.02 * size);
  const [wide, high] = [x1 - x0 + 2 * room || 1, y1 - y0 + 2 * room || 1];
  const edge = { side: width < 520 ? 46 : 66, top: 76, bottom: 100 };
  const scale = Math.min((width - 2 * edge.side) / wide, 440 / high);
  const left = (width - wide * scale) / 2;
  return {
    factor, scale, size,
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
  const at = (node) => `${spots[2 * node - 2].toFixed(1)} ${spots[2 * node - 1].toFixed(1)}`;
  return shape(mesh.edges.map(([from, to]) => `M${at(from)}L${at(to)}`).join(""), kind);
}

// Small marks of one kind at many nodes, as one path.
const marksAt = (numbers, spots, mark, kind) => shape(numbers.map((i) => `M${spots[2 * i].toFixed(1)} ${spots[2 * i + 1].toFixed(1)}${mark}`).join(""), kind);

// Where the axes point, and how long a length is.
function drawMeshAxes(root, width, height, layout) {
  const [x, y] = [40, height - 34];
  const { right, up } = views[view];
  ["x", "y", "z"].forEach((name, axis) => {
    const [dx, dy] = [26 * right[axis], -26 * up[axis]];
    if (Math.hypot(dx, dy) < 3) return;
    root.append(line(x, y, x + dx, y + dy, "thin"), axisWord(x + dx * 1.45, y + dy * 1.45 + 4, name));
  });
  if (!(layout.size > 0)) return;
  const length = roundUp(layout.size / 8);
  const [to, bar] = [width - 30, length * layout.scale];
  root.append(path([[to - bar, y - 4], [to - bar, y], [to, y], [to, y - 4]], "thin"),
    axisWord(to, y + 18, `length ${rough(length)}`, "end"));
}

function drawMesh(f, holder) {
  const width = widthOf(holder);
  const layout = meshLayout(width);
  const place = (list) => list.map((v, i) => (i % 2 === 0 ? layout.X(v) : layout.Y(v)));
  const was = place(projected(f, 0));
  const spots = place(projected(f, layout.factor));
  const root = canvas(holder, width, layout.height, stateWords(f));
  const times = timesWords(layout.factor);
  root.append(panelTitle(16, 18, width < 520 ? `Displacement ${times}` : `Displacement, drawn ${times}; ${views[view].words}`));
  if (mesh.edges.length > 0) root.append(edgePath(was, "mesh-was"), edgePath(spots, mesh.edges.length > 400 ? "member many" : "member"));
  else root.append(marksAt(mesh.drawn, was, "h0", "mesh-was dots"), marksAt(mesh.drawn, spots, "h0", "member dots"));
  if (mesh.still.length > 0) root.append(marksAt(mesh.still, was, "m-3 -3l6 6m-6 0l6 -6", "thin still"));
  if (mesh.drawn.length <= 200) {
    for (const i of mesh.drawn) {
      const at = { cx: spots[2 * i], cy: spots[2 * i + 1], r: 2.2, class: "mesh-node" };
      root.append(svg("circle", at, svg("title", {}, `node ${structure.nodes[i].node}`)));
    }
  }
  const { right, up } = views[view];
  const pairs = pairsOf(f).filter((p) => p.at !== null);
  const sides = {
    spot: ({ at }) => [spots[2 * at], spots[2 * at + 1]], along: ({ direction }) => onPage(direction),
    pixels: ({ direction }) => layout.factor * layout.scale * Math.hypot(right[direction - 1], up[direction - 1]),
    limits: [-90, 90], r: pairs.length > 60 ? 3.2 : 5, half: 13, force: mesh.force, point: mesh.point,
    say: wordsInFreePlaces(root, width, layout.height - 62),
  };
  drawPoints(root, mesh.points(f), sides);
  drawPairs(root, pairs, sides);
  drawSupports(root, f, drawnSupports.filter((s) => s.at !== null), sides);
  drawMeshAxes(root, width, layout.height, layout);
}

// ---- whatever it is ----

// What the pictures of all states have in common, once the result is read.
function preparePicture() {
  cuts.clear();
  const { kind } = structure;
  drawnPairs = some("pairs", places.pairs.length, kind === "beam" ? 300 : 1000);
  drawnSupports = some(`${unitOf()}s with supports`, places.supports.length, 300).map((i) => places.supports[i]);
  if (places.pairs.length > 60) cuts.add("The numbers of the pairs are not written beside their marks, but shown when the pointer is over a mark.");
  beam = kind === "beam" ? beamOf() : null;
  plate = kind === "plate" ? plateOf() : null;
  mesh = kind === "matrix" && structure.nodes.length > 0 ? meshOf() : null;
  fields = plate ? fieldsOf() : [];
  field = fields.find((f) => field && f.name === field.name) || fields[0];
  view = mesh ? fittingView() : 0;
}

function drawPicture(f, holder) {
  const drawIt = beam ? drawBeam : plate ? drawPlate : mesh ? drawMesh : null;
  if (drawIt) drawIt(f, holder);
}
