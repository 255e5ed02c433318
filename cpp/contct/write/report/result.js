// What a page draws of a result in the format contct-result-1 that has the structure and states. Numbers come from
// the result; nothing is computed here but where a pair is, and which pairs are at their faces.
"use strict";

function element(name, attributes = {}, ...children) {
  const e = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
  e.append(...children);
  return e;
}

function svg(name, attributes = {}, ...children) {
  const e = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) {
    e.setAttribute(key, typeof value === "number" ? String(Math.round(value * 100) / 100) : value);
  }
  e.append(...children);
  return e;
}

// The name of a node, or of a dof where each dof is a node of its own.
const nameOf = (entry) => entry.node ?? entry.dof;
const hermite = (h, w0, w1, t0, t1, a, b = 1 - a) => w0 * b * b * (1 + 2 * a) + w1 * a * a * (1 + 2 * b) + h * (t0 * a * b * b - t1 * a * a * b);

// How many of each node's dofs stand one after the other; a matrix has one dof a node.
const dofsPerNode = { beam: 2, plate: 3, matrix: 1 };

// Pairs and supports with their places; supports once a node, with the numbers of their reactions.
function placesOf({ structure }) {
  const stride = dofsPerNode[structure.kind];
  const numbers = new Map((structure.dofs || structure.nodes).map((d, i) => [nameOf(d), i]));
  const placed = (entry) => {
    const number = numbers.get(structure.kind === "matrix" ? entry.dof : entry.node);
    const { x = 0, y = 0 } = structure.dofs ? {} : structure.nodes[number];
    const { at = null, direction = 0 } = structure.dofs ? structure.dofs[number] : {};
    return { name: nameOf(entry), u: number * stride, x, y, at: at === null ? null : at - 1, direction };
  };
  const supports = new Map();
  structure.supports.forEach((s, i) => {
    const place = placed(s);
    if (!supports.has(place.u)) supports.set(place.u, { ...place, dofs: [] });
    supports.get(place.u).dofs.push([s.dof, s.spring, i]);
  });
  return { pairs: structure.pairs.map((p) => ({ ...p, ...placed(p), side: p.surface === "above" ? 1 : -1 })), supports: [...supports.values()] };
}

// Whether a step ends where its increment number `n`, from 0, does: the state is the step's then.
const endsAt = ({ increments, fraction, ended_by }, n) => n >= 0 && n === increments.length - 1 && increments[n].fraction === fraction && ended_by !== "oracle";

// The unloaded structure, then every state of the path that the result has.
function framesOf(result, { pairs } = placesOf(result)) {
  const { structure } = result;
  const frames = [];
  const add = (state, how) => frames.push({
    end: false, exact: false, from_fallback: false, ...how, u: state.displacement, reactions: state.reactions.map((r) => r.value), elements: state.elements, extremes: state.extremes,
    pairs: pairs.map((p, i) => {
      const [w, closed] = [state.displacement[p.u], state.pairs[i].state === "contact"];
      const look = Math.abs(p.face - w) < 1e-10 ? "f" : closed ? "c" : "o";  // the listing's EPSGAP
      return { ...p, w, closed, look, gap: state.pairs[i].gap, force: state.pairs[i].force };
    }),
  });
  const begun = {
    displacement: new Array((structure.dofs || structure.nodes).length * dofsPerNode[structure.kind]).fill(0),
    pairs: pairs.map((p) => ({ state: p.state, gap: p.state === "contact" ? 0 : p.side * p.face, force: 0 })),
    reactions: structure.supports.map(() => ({ value: 0 })), extremes: {},
    elements: (structure.EI || []).map(() => ({ moment: [0, 0], shear: [0, 0] })),
  };
  add(begun, { at: 0, step: 0, number: 0, fraction: 0, s: 0, events: [], load: { words: "none" } });
  let at = 0;
  for (const step of result.steps) {
    const end = { step: step.step, fraction: step.fraction, end: true, exact: step.ended_by === "exact", load: step.load };
    const from_fallback = step.ended_by === "oracle";
    step.increments.forEach((i, n) => {
      const how = { at: ++at, step: step.step, number: i.increment, fraction: i.fraction, s: i.s, snap: i.snap, events: i.events, load: i.load };
      if (endsAt(step, n)) add(step, { ...how, ...end });
      else if (i.displacement) add(i, how);
    });
    if (!endsAt(step, step.increments.length - 1)) add(step, { ...end, at, number: 0, s: 0, events: [], from_fallback });
  }
  return frames;
}

// The deflection of a beam at x. Inside an element it is the polynomial through what its ends have: deflections,
// slopes and, with the stiffness EI, moments. It is exact where the load along the element is straight.
function elementAt(structure, x) {
  let [low, high] = [0, structure.nodes.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (structure.nodes[middle].x <= x) low = middle;
    else high = middle;
  }
  return low;
}
function deflectionAt(structure, f, x, e = elementAt(structure, x)) {
  const [left, right] = [structure.nodes[e].x, structure.nodes[e + 1].x];
  const [h, a] = [right - left, (x - left) / (right - left)];
  const [w0, t0, w1, t1] = f.u.slice(2 * e, 2 * e + 4);
  const [k0, k1] = f.elements[e].moment.map((m) => m / structure.EI[e]);
  // What the cubic of deflections and slopes has for the curvatures, less what is told.
  const [c0, c1] = [k0 - (6 * (w1 - w0) / h - 4 * t0 - 2 * t1) / h, k1 - (-6 * (w1 - w0) / h + 2 * t0 + 4 * t1) / h];
  return hermite(h, w0, w1, t0, t1, a) + 0.5 * h * h * a * a * (1 - a) * (1 - a) * (c0 * (1 - a) + c1 * a);
}
