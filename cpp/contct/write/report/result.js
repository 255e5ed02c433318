// Reads a result in the format contct-result-2 with structure and states, for a page that draws the result. All numbers
// come from the result; only positions of pairs, and whether pairs are at their faces, are found here.
"use strict";

const byId = (id) => document.getElementById(id);

function filled(e, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, typeof value === "number" ? String(Math.round(value * 100) / 100) : value);
  e.append(...children);
  return e;
}

const element = (name, attributes = {}, ...children) => filled(document.createElement(name), attributes, children);

// The result, and what read() derives from it: dofs, pairs and supports with their positions, and states (frames).
let result, structure, places, frames, increments, ofMatrix;

// The direction of each dof of a node: 1 to 3 along x, y and z, 4 to 6 about these axes. The w of a beam is along y.
const dofsOfNode = { beam: { w: 2, theta: 6 }, plate: { w: 3, wx: 5, wy: 4 } };

function read(given) {
  result = given;
  structure = result.structure;
  ofMatrix = structure.kind === "matrix";
  places = placesOf();
  frames = framesOf();
  increments = result.steps.flatMap((s) => s.increments.map((i) => ({ ...i, step: s.step, number: i.increment })));
}

// The number of a step, followed by its name if it has one.
const stepName = (s) => (s.name ? `${s.step}, ${s.name}` : String(s.step));
const nameOfStep = (number) => stepName(result.steps.find((s) => s.step === number) ?? { step: number });
const startsFromZero = () => result.steps.some((s) => s.start === "zero");

const nameOf = (entry) => entry.node ?? entry.dof;
// Adds the name that the problem file gives to a support, pair or bed.
const labelled = (words, label) => (label ? `${words}, ${label}` : String(words));

function dofsOf() {
  if (ofMatrix) return structure.dofs.map((d) => ({ name: d.dof, at: (d.at ?? 0) - 1, direction: d.direction ?? 0 }));
  const own = Object.entries(dofsOfNode[structure.kind]);
  return structure.nodes.flatMap((n, at) => own.map(([dof, direction]) => ({ name: n.node, dof, at, direction })));
}

// All dofs, pairs and supports. `name`: of the node or dof. `label`: the name in the problem file. `at`: the node, from 0;
// -1 if the dof has no position. `u`: the dof, from 0.
function placesOf() {
  const dofs = dofsOf();
  const numbers = new Map(dofs.map((d, u) => [ofMatrix ? d.name : `${d.name} ${d.dof}`, u]));
  const locate = (entry, dof) => {
    const u = numbers.get(ofMatrix ? entry.dof : `${entry.node} ${dof}`);
    const { x = null, y = null } = structure.nodes[dofs[u].at] || {};
    return { ...entry, label: entry.name, ...dofs[u], u, x, y };
  };
  // The dof that carries the face of a pair, and the node of this dof; -1: none.
  const otherOf = ({ other }) => (other === undefined ? { otherU: -1, otherAt: -1 } : { otherU: numbers.get(other), otherAt: dofs[numbers.get(other)].at });
  return {
    dofs, locate,
    pairs: structure.pairs.map((p) => ({ ...locate(p, "w"), ...otherOf(p), side: p.surface === "above" ? 1 : -1 })),
    supports: structure.supports.map((s, number) => ({ ...locate(s, s.dof), number })),
  };
}

// True if the end of the step and its increment `n`, from 0, have the same state.
const endsAt = ({ increments: all, fraction, ended_by }, n) => n >= 0 && n === all.length - 1 && all[n].fraction === fraction && ended_by !== "reference";

// All states that the result contains: the unloaded structure, states within steps, and ends of steps.
function framesOf() {
  const found = [];
  const add = (state, how) => found.push({
    end: false, exact: false, from_fallback: false, ...how,
    u: state.displacement, reactions: state.reactions.map((r) => r.value), elements: state.elements, pressure: state.pressure, extremes: state.extremes,
    pairs: places.pairs.map((p, i) => {
      const [w, closed] = [state.displacement[p.u], state.pairs[i].state === "contact"];
      const other = p.otherU < 0 ? 0 : state.displacement[p.otherU];
      const face = (state.pairs[i].face ?? p.face) + other;  // the present place: a step may have moved the face
      const look = Math.abs(face - w) < 1e-10 ? "f" : closed ? "c" : "o";  // EPSGAP of the listing
      return { ...p, face, w, closed, look, gap: state.pairs[i].gap, force: state.pairs[i].force };
    }),
  });
  const begun = {
    displacement: places.dofs.map(() => 0),
    pairs: places.pairs.map((p) => ({ state: p.state, gap: p.state === "contact" ? 0 : p.side * p.face, force: 0 })),
    reactions: structure.supports.map(() => ({ value: 0 })), extremes: {}, pressure: structure.nodes.map(() => 0),
    elements: (structure.EI || []).map((_, e) => ({ pieces: [{ x: [structure.nodes[e].x, structure.nodes[e + 1].x], w: [0], moment: [0], shear: [0] }] })),
  };
  add(begun, { step: 0, number: 0, fraction: 0, s: 0, events: [], load: { words: "none" } });
  for (const step of result.steps.filter((s) => s.displacement)) {
    const end = { step: step.step, fraction: step.fraction, end: true, exact: step.ended_by === "exact", load: step.load };
    step.increments.forEach((i, n) => {
      const how = { step: step.step, number: i.increment, fraction: i.fraction, s: i.s, snap: i.snap, events: i.events, load: i.load };
      if (endsAt(step, n)) add(step, { ...how, ...end });
      else if (i.displacement) add(i, how);
    });
    if (!endsAt(step, step.increments.length - 1)) add(step, { ...end, number: 0, s: 0, events: [], from_fallback: step.ended_by === "reference" });
  }
  return found;
}

// The element of a beam at x, from 0.
const elementAt = (x) => Math.max(0, Math.min(structure.nodes.length - 2, structure.nodes.findLastIndex((n) => n.x <= x)));

// A quantity ("w", or one of elements) of a beam at x in element e: the polynomial of the piece that contains x.
function valueAt(f, name, x, e = elementAt(x)) {
  const { pieces } = f.elements[e];
  const { x: [left, right], [name]: polynomial } = pieces.find((p) => x < p.x[1]) ?? pieces[pieces.length - 1];
  return polynomial.reduceRight((sum, a) => (sum * (x - left)) / (right - left) + a, 0);
}

// The values [x, value] on both sides of each place inside an element where a load begins, ends or acts.
const besidePieces = (f, name) => f.elements.flatMap(({ pieces }) =>
  pieces.slice(1).flatMap((p, i) => [[p.x[0], pieces[i][name].reduce((a, b) => a + b)], [p.x[0], p[name][0]]]));

// The concentrated loads of a state: value, and dof of a node or x between two nodes.
const pointsOf = (f) => (f.load.point || []).map((p) => {
  const dof = Object.keys(p).find((key) => !["node", "dof", "x"].includes(key));
  if ("x" in p) return { dof, x: p.x, at: 0, between: true, direction: dofsOfNode.beam[dof], value: p[dof] };
  return { ...places.locate(p, dof), value: p[dof] };
});

// Returns a function that tells whether an element, from 1, is in `elements`: "all", "2..9", or a list.
function numbersIn(elements) {
  if (elements === "all") return () => true;
  if (Array.isArray(elements)) return (e) => elements.includes(e);
  const [first, last] = elements.split("..").map(Number);
  return (e) => e >= first && e <= last;
}

// The distributed load of a beam as a function of element e, from 0, and x; null if there is no such load.
function lineLoadOf(f) {
  const parts = (f.load.uniform || []).map((part) => ({ ...part, has: part.elements ? numbersIn(part.elements) : (e, x) => part.from <= x && x <= part.to }));
  if (parts.length === 0) return null;
  return (e, x) => parts.filter((part) => part.has(e + 1, x))
    .reduce((sum, { value, polynomial = [value] }) => sum + polynomial.reduceRight((y, a) => y * x + a, 0), 0);
}

// The runs of equal values in a list, as indices [first, last].
function runsOf(values) {
  const runs = [];
  values.forEach((v, i) => (i > 0 && v === values[i - 1] ? (runs[runs.length - 1][1] = i) : runs.push([i, i])));
  return runs;
}

// The least and the largest finite number of a list; [0, 0] if the list has no finite number.
function spread(values) {
  const numbers = values.filter((v) => v !== null && isFinite(v));
  return numbers.length === 0 ? [0, 0] : [Math.min, Math.max].map((end) => numbers.reduce((a, b) => end(a, b)));
}

// The entries of a list that have the same key, as lists.
function groupsOf(list, keyOf) {
  const groups = new Map();
  for (const one of list) groups.get(keyOf(one))?.push(one) ?? groups.set(keyOf(one), [one]);
  return [...groups.values()];
}

// The largest magnitude of the numbers `values(f)` over all states f.
const largest = (values) => frames.reduce((most, f) => values(f).reduce((m, x) => Math.max(m, Math.abs(x)), most), 0);

// The range of a quantity over all states, widened to contain 0.
const rangeOf = (name) => spread([0, ...frames.flatMap((f) => (name in f.extremes ? [f.extremes[name].min.value, f.extremes[name].max.value] : []))]);
