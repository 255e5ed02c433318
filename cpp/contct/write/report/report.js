// The report of a run: its tables, its words and the controls for its states. The playground uses this file too.
"use strict";

const known = { fortran: "FORTRAN", cpp: "C++", "fortran-r4": "FORTRAN (4-byte REAL)", "cpp-r4": "C++ (4-byte REAL)" };
const kernelNames = () => result.kernels.map((name) => known[name] || name);
const calledNames = () => kernelNames().slice(result.rule_1989 ? 1 : 0); // for both rules: only the 1989 kernels
const where = (f) => (f.step === 0 ? "Start" : f.number === 0 ? `${f.step}, end` : `${f.step}.${f.number}`);

// ---- load against deflection ----

let byForce = true;  // true: the vertical axis is the sum of loads; false: the number of steps
let followed = null; // the dof of the chart: that with the largest deflection

const sumOf = (f) => f.load.force ?? f.load.sum ?? 0;
const measure = (f) => (byForce ? sumOf(f) : f.step === 0 ? 0 : f.step - 1 + f.fraction);

// The dofs that are deflections. In a matrix with known places: dofs of pairs and dofs along an axis.
function deflections() {
  const paired = new Set(places.pairs.map((p) => p.u));
  const all = places.dofs.map((d, u) => ({ ...d, u }));
  const lengths = all.filter(({ u, at, direction }) => paired.has(u) || (at >= 0 && direction >= 1 && direction <= 3));
  return structure.places_from ? lengths : all;
}

function prepareChart() {
  const [least, most] = spread(frames.map(sumOf));
  byForce = most - least > 1e-9 * Math.max(Math.abs(least), Math.abs(most));
  const reach = ({ u }) => largest((f) => [f.u[u]]);
  followed = deflections().map((d) => ({ ...d, reach: reach(d) })).reduce((a, b) => (b.reach > a.reach ? b : a));
}

function drawChart(f) {
  const holder = byId("chart");
  const width = widthOf(holder);
  const height = width < 520 ? 280 : 340;
  const room = { left: 84, right: 28, top: 34, bottom: 54 };
  const deflection = (g) => g.u[followed.u];
  const [x0, x1] = padded(spread(frames.map(deflection)));
  const [y0, y1] = padded(spread(frames.map(measure)));
  const bottom = height - room.bottom;
  const X = (v) => room.left + ((v - x0) / (x1 - x0)) * (width - room.left - room.right);
  const Y = (v) => bottom - ((v - y0) / (y1 - y0)) * (bottom - room.top);
  const spot = (g) => [X(deflection(g)), Y(measure(g))];
  const root = canvas(holder, width, height,
    `Load against the ${moves()} of ${placed(followed.name)}, ${frames.length} states; now load ${rough(measure(f))}, ${moves()} ${rough(deflection(f))}`);
  scaleAlong(root, ticks(x0, x1, Math.floor(width / 95)), X, bottom, room.top);
  scaleUp(root, ticks(y0, y1, 5), Y, room.left, width - room.right, 8);
  const sum = ofMatrix ? "Sum of the loads" : inUnit(width < 520 ? "Sum of the loads" : "Sum of the loads, positive up", "force");
  root.append(panelTitle(room.left, 18, byForce ? sum : "Steps of load applied"),
    axisWord(width - room.right, height - 12, `${ofMatrix ? moves() : inUnit("deflection w", "w")} of ${placed(followed.name)}, which moves most`, "end"));
  const [x, y] = spot(f);
  root.append(line(x, y, x, bottom, "cross"), line(room.left, y, x, y, "cross"), ...tracks().map((track) => path(track.map(spot), "track")));
  for (const g of frames) root.append(chartMark(g, ...spot(g)));
  const say = wordsInFreePlaces(root, width, bottom, room.left);
  const ends = frames.filter((g) => g.end);
  if (ends.length > 1 && ends.length < 8) for (const g of ends) say(spot(g)[0], spot(g)[1] - 14, `step ${nameOfStep(g.step)}`, "axis-word", `step ${nameOfStep(g.step)}`);
  root.append(svg("circle", { cx: x, cy: y, r: 9, class: "here" }));
}

// The lines of the chart: one for the path, or one for each combination. Each line begins with the unloaded structure.
const tracks = () => (!startsFromZero() ? [frames]
  : [...new Set(frames.slice(1).map((f) => f.step))].map((step) => [frames[0], ...frames.filter((f) => f.step === step)]));

const padded = ([low, high], reach = high - low || Math.abs(high) || 1) => [low - 0.06 * reach, high + 0.06 * reach];

function chartMark(f, x, y) {
  const r = frames.length > 60 ? 2.6 : 4.4;
  const mark = f.events.length === 0 ? svg("rect", { x: x - r, y: y - r, width: 2 * r, height: 2 * r, class: "step-end" })
    : svg("circle", { cx: x, cy: y, r, class: f.events.some((e) => e.change === "make") ? "make" : "break" });
  return titled(`${where(f)}: ${allEventWords(f.events) || (f.end ? "end of step" : "no event")}`, mark);
}

// ---- sections and tables ----

// Fills a section of the page, or hides the section if there is no content.
function fill(id, heading, words, ...content) {
  byId(id).replaceChildren(element("h2", { id: `${id}-heading` }, heading), element("p", { class: "quiet" }, words), ...content);
  byId(id).hidden = content.length === 0;
}

// A cell for a text, a number, an element, or a list of { number, at: place }; for null, a cell with a dash.
function cellOf(value, words) {
  const numeral = (tag, x) => element(tag, { "data-value": String(x), title: String(x) }, short(x));
  if (typeof value === "number") return numeral("td", value);
  if (!Array.isArray(value)) return element("td", words ? { class: "words" } : {}, value ?? "–");
  return element("td", {}, ...value.flatMap(({ number, at }) => [numeral("span", number), ...(at ? [element("small", {}, at)] : [])]));
}

// A table. Columns of texts are left-aligned; the first cell of a row is its heading. If there are more than `most`
// rows, the table keeps the first rows, or the rows with the largest `sizeOf`. The title of the table and the end of
// the page tell which rows it keeps.
function tableOf(title, names, rows, most = Infinity, sizeOf = null) {
  if (rows.length === 0) return [];
  const how = `${sizeOf ? "largest" : "first"} ${most} of ${rows.length}`;
  const whole = rows.length <= most;
  if (!whole) cuts.add(`${title}: the table has the ${how} rows.`);
  const kept = new Set((sizeOf ? [...rows].sort((a, b) => sizeOf(b) - sizeOf(a)) : rows).slice(0, most));
  const words = names.map((_, i) => rows.every((r) => r[i] === null || typeof r[i] === "string"));
  const caption = whole ? title : `${title} (${how})`;
  const row = (cells) => element("tr", {}, element("th", { scope: "row", class: "words" }, cells[0]), ...cells.slice(1).map((value, i) => cellOf(value, words[i + 1])));
  const head = element("tr", {}, ...names.map((name, i) => element("th", { scope: "col", ...(words[i] ? { class: "words" } : {}) }, name)));
  return [element("div", { class: rows.length > 12 ? "scroll" : "scroll whole", tabindex: "0", role: "region", "aria-label": caption }, element("p", { class: "caption" }, caption),
    element("table", { "aria-label": title }, element("thead", {}, head), element("tbody", {}, ...rows.filter((r) => kept.has(r)).map(row))))];
}

const inLength = (name) => inUnit(name, "w");
const placeHead = () => (ofMatrix ? ["Dof"] : structure.kind === "plate" ? ["Node", inLength("x"), inLength("y")] : ["Node", inLength("x")]);
const placeCells = (p) => (ofMatrix ? [p.name] : structure.kind === "plate" ? [String(p.name), p.x, p.y] : [String(p.name), p.x]);
// The same of a support, with its name.
const supportCells = (s) => [labelled(s.name, s.label), ...placeCells(s).slice(1)];

// ---- the state, increments and calls ----

function showPairs(f) {
  fill("pairs", "Pairs in this state", `State ${where(f)}. A separated pair has a gap, a pair in contact a force. A force is positive if it pushes the structure off the face; ` +
    "a negative force is tension.", ...tableOf("Pairs", ["Pair", ofMatrix ? "Dof" : "Node", "Surface", "Face", "State", "Gap", "Force"],
    f.pairs.map((p) => [labelled(p.pair, p.label), String(p.name), p.surface, p.face, lookWords(p), p.gap, p.force]), 250));
}

function showEvents() {
  const stops = new Map(frames.map((f, i) => [where(f), i]));
  const nameOfIncrement = (i) => {
    const name = `${i.step}.${i.number}`;
    if (!stops.has(name)) return name;
    const button = element("button", { type: "button", "aria-label": `Show increment ${name}` }, name);
    button.addEventListener("click", () => show(stops.get(name)));
    return button;
  };
  const rows = increments.map((i, n) => [n < 1200 ? nameOfIncrement(i) : "", i.fraction, i.snap ? "snap" : i.s, minus(i.load.words), allEventWords(i.events) || "–"]);
  const tables = tableOf("Increments", ["Increment", "Share", "s", "Load", "Events"], rows, 1200);
  fill("events", "Increments and events", "Share is the share of the step that is applied after the increment; s is the share of the remaining load that the " +
    "increment applies, which the paper calls the scale factor.", ...tables);
  for (const r of byId("events").querySelectorAll("tbody tr")) r.dataset.increment = r.firstChild.textContent;
}

const markCurrentRow = (f) => byId("events").querySelectorAll("tbody tr").forEach((r) => r.classList.toggle("current", r.dataset.increment === where(f)));

function showCalls() {
  const [leader, ...others] = calledNames();
  const { calls, calls_made, lockstep, words } = result;
  const told = others.length === 0 ? "One kernel ran, so nothing was compared. These are its answers."
    : !lockstep ? `Free run: each kernel followed its own path, so single calls were not compared: ${words.comparison}. The calls of ${leader}:`
      : `Lockstep: ${others.join(" and ")} had the same input as ${leader} at every call: ${words.comparison}. ` +
        "A distance of 0 ULP means equal to the bit. The comparison covers SMIN, every s, every status, and the text of unit 26 if both write it.";
  const pairs = Math.max(0, ...calls.map((c) => c.s.length));
  if (pairs > 0 && places.pairs.length > pairs) cuts.add(`Calls: s is listed for the first ${pairs} of ${places.pairs.length} pairs; the distances cover all pairs.`);
  if (calls.length < calls_made) cuts.add(`The first ${calls.length} of ${calls_made} calls are listed.`);
  const compared = lockstep ? others : [];
  const names = compared.flatMap((k) => [`ULP off in SMIN, ${k}`, "ULP off in any s", "values compared", "different"]);
  const answer = (a) => (!a || a.failed ? ["no answer", "no answer", "–", "–"] : [a.smin_ulps, a.s_ulps, a.values, a.mismatches]);
  fill("comparison", others.length > 0 ? calledNames().join(" against ") : `Calls of ${leader}`, calls_made === 0 ? `${told} No call was made.` : told,
    ...tableOf("Calls", ["Call", "Increment", `SMIN of ${leader}`, ...names, ...Array.from({ length: pairs }, (_, i) => `s of pair ${i + 1}`)],
      calls.map((c, n) => [String(n + 1), c.step === 0 ? "settling" : `${c.step}.${c.increment}`, c.smin, ...compared.flatMap((_, k) => answer(c.followers[k])), ...c.s]), 1200));
  byId("comparison").hidden = false;
}

// ---- the ends of steps, the envelope and the input ----

const markOf = (c) => (!c ? "no certificate" : c.certified ? "certified" : "NOT certified");
// The proved error of the mesh beside a largest value.
const meshErrorOf = ({ kind, error, of }, read) => (kind === "proved" && read(of) > 0 ? `; mesh error ${Number((100 * read(error) / read(of)).toPrecision(2))}\u00a0%` : "");
const quantityHead = (key) => inUnit(sentence(quantityOf(key).words).slice(0, -1), key);
const largestBy = (list, key) => list.reduce((a, b) => (Math.abs(b[key]) > Math.abs(a[key]) ? b : a));
const kindOf = ({ direction }) => (direction > 3 ? "couple" : direction > 0 ? "force" : "");  // empty: not known
const springKind = (s) => ({ force: "stiffness", couple: "couple" })[ofMatrix ? kindOf(s) : s.dof === "w" ? "force" : "couple"];
const whatHolds = (s) => inUnit(ofMatrix ? kindOf(s) || "along the dof" : s.dof, kindOf(s));
const mostReactions = 1000;  // there are more if every node has a spring
const reactionsTitle = "Reactions: what supports exert on the structure";

// What ranks steps that have states: the contact force, and the largest value of each quantity.
const sizesOf = (steps) => [(s) => Math.abs(s.largest.pair?.force ?? 0), ...Object.keys(steps[0]?.extremes ?? {}).map((name) => (s) => Math.abs(largestOf(s.extremes[name]).value))];

// At most `most` steps that have states: those with the largest values, relative to the largest value of a quantity.
function endsOf(most) {
  const steps = result.steps.filter((s) => s.displacement);
  const sizes = sizesOf(steps).map((size) => steps.map(size));
  const share = steps.map((_, i) => Math.max(0, ...sizes.map((all) => all[i] / (Math.max(...all) || 1))));
  const kept = new Set(steps.map((_, i) => i).sort((a, b) => share[b] - share[a]).slice(0, most));
  return steps.filter((_, i) => kept.has(i));
}

function endTables() {
  const { steps } = result;
  const whole = steps.filter((s) => s.pairs);
  const someOf = (of) => (of.length < steps.length ? `, ${of.length} of ${steps.length} steps` : "");
  const quantities = Object.keys(steps[0]?.extremes || {});
  const most = (list = [], key, words) => (list.length === 0 ? null : [largestBy(list, key)].map((e) => ({ number: e[key], at: words(e) })));
  const kinds = ["force", "couple", ""].filter((kind) => places.supports.some((s) => kindOf(s) === kind));
  const ofKind = (all, kind) => all.filter((r) => kindOf(places.locate(r, r.dof)) === kind);
  const headsOfLargest = ["Step", "Share", ...quantities.map(quantityHead), inUnit("Contact force", "force"), ...kinds.map((kind) => inUnit(kind === "couple" ? "Reaction moment" : "Reaction", kind)), "Certificate"];
  const row = (s) => [stepName(s), s.fraction, ...quantities.map((name) => toldOf(s.extremes[name]).map((v, i) => ({ number: v.value, at: placeOf(v) + (i === 0 ? meshErrorOf(s.mesh, (of) => of[name]) : "") }))),
    most([s.largest.pair ?? []].flat(), "force", (p) => `pair ${labelled(p.pair, p.name)}, ${placed(nameOf(p))}`), ...kinds.map((kind) => most(ofKind(s.largest.reactions, kind), "value", (r) => `${ofMatrix ? "" : `${r.dof} at `}${labelled(placed(nameOf(r)), r.name)}`)),
    markOf(s.certificate)];
  const sums = steps.filter((s) => s.balance).map((s) => [stepName(s), s.balance.loads, s.balance.reactions, s.balance.contact]);
  const [ownPairs, bedPairs] = [places.pairs.filter((p) => !p.bed), places.pairs.filter((p) => p.bed)];
  const paired = new Set(places.pairs.map((p) => p.u));
  const motionOf = (d) => (kindOf(d) === "couple" ? "Rotations" : kindOf(d) || paired.has(d.u) ? inUnit("Displacements u", "w") : "Displacements of dofs of unknown direction");
  const onBeds = bedPairs.length > 0 ? endsOf(6) : [];
  if (onBeds.length < whole.length && bedPairs.length > 0) cuts.add(`Contact forces of beds: the tables have ${onBeds.length} of ${steps.length} steps, those with the largest values.`);
  const beds = steps.flatMap((s) => (s.beds || []).map((b) => [stepName(s), labelled(b.bed, b.name), b.force, ...[b.pressure.min, b.pressure.max].map((v, i) => [{ number: v.value, at: placeOf(v) + (i === 1 ? meshErrorOf(s.mesh, (of) => of.pressure) : "") }]), b.contact]));
  const hinges = steps.flatMap((s) => (s.hinges || []).map((h) => [stepName(s), String(h.hinge), h.x, h.rotation, h.moment]));
  const hingeTable = tableOf("Hinges: theta on the right minus theta on the left, and moment", ["Step", "Hinge", inUnit("x", "w"), ...(hinges.length > 0 ? ["hinge_rotation", "hinge_moment"].map(quantityHead) : [])], hinges, 200);
  const watched = steps.flatMap((s) => watchedRows(s.watch, (v) => placeOf(v)).map((row) => [stepName(s), ...row]));
  const largestTables = [...tableOf("Largest values at the end of each step", headsOfLargest, steps.map(row)),
    ...tableOf("Beds: resultant, pressure and contact", ["Step", "Bed", inUnit("Force", "force"), ...["Least", "Largest"].map((name) => inUnit(`${name} pressure`, "bed_pressure")), inUnit("In contact", "bed_contact")], beds)];
  const byEnvelope = startsFromZero() && result.envelope;  // combinations: their extremes are the governing results
  const held = whole.length > 0 ? holdTable(endsOf(byEnvelope ? 3 : 6), byEnvelope) : [];
  return [byEnvelope ? held : [...largestTables, ...tableOf("Watched parts", ["Step", "Part", "Quantity", "Least", "Largest"], watched), ...held, ...hingeTable], [
    ...(byEnvelope ? [...largestTables, ...hingeTable] : []),
    ...tableOf(inUnit("Sums of forces, positive up", "force"), ["Step", "Loads", "Reactions", "Contact forces"], sums),
    ...tableOf(inUnit("Sums by direction; if they do not add up to 0, give bearings that are inside the matrix as [[support]] with spring", "force"), ["Step", "Direction", "Loads", "Reactions", "Contact forces"], ofMatrix ? steps.flatMap(sumsByDirection) : []),
    ...besideEachOther(whole, `${inUnit("Contact forces", "force")}; for a separated pair the ${inUnit("gap", "w")}${someOf(whole)}`, ["Pair", ...placeHead(), "Surface"],
      ownPairs.map(pairCells), (s, i) => forceOrGap(s.pairs[ownPairs[i].pair - 1])),
    ...besideEachOther(onBeds, `${inUnit("Contact forces of beds", "force")}${someOf(onBeds)}`, ["Pair", ...placeHead(), "Surface"],
      bedPairs.map(pairCells), (s, i) => s.pairs[bedPairs[i].pair - 1].force, 40),
    ...groupsOf(ofMatrix ? places.dofs.map((d, u) => ({ ...d, u })) : [], motionOf).flatMap((of) => besideEachOther(whole, motionOf(of[0]) + someOf(whole), ["Dof"], of.map((d) => [d.name]), (s, i) => s.displacement[of[i].u], 40)),
    ...besideEachOther(whole, reactionsTitle + someOf(whole), [...placeHead(), "What"], places.supports.map((s) => [...supportCells(s), whatHolds(s)]), (s, i) => s.reactions[i].value, mostReactions),
  ]];
}

// The rows of watched parts: part, quantity, least and largest value.
const watchedRows = (watch = [], words) => watch.flatMap(({ name, extremes }) => Object.entries(extremes)
  .map(([key, { min, max }]) => [name, quantityHead(key), ...[min, max].map((v) => [{ number: v.value, at: words(v) }])]));

// Supports, and the pairs of [[contact]]: their least and largest values in all combinations, and those in these steps.
function holdTable(steps, envelope, most = 40) {
  const whole = steps.filter((s) => s.pairs);
  const kind = (s) => (kindOf(s) === "force" ? "" : `, ${whatHolds(s)}`);
  const where = (label, what, name) => (label ? `${label}, ${placed(name)}` : `${what}, ${placed(name)}`).replaceAll(" ", "\u00a0");
  const when = (v) => (startsFromZero() ? result.steps[v.step - 1].name : whenReached(v));
  const range = (r) => [r?.min, r?.max].map((v) => (!v ? null : v.value === 0 ? [{ number: 0 }] : envelopeCell(v, when(v))));
  const rows = [...places.supports.map((s, i) => [[where(s.label, "support", s.name) + kind(s), ...(envelope ? [...range(envelope.reactions[i]), null] : [])], (of) => of.reactions[i].value]),
    ...places.pairs.filter((p) => !p.bed).map((p) => [[where(p.label, `pair ${p.pair}`, p.name), ...(envelope ? [...range(envelope.pairs[p.pair - 1].force),
      ...range(envelope.pairs[p.pair - 1].gap).slice(1)] : [])], (of) => forceOrGap(of.pairs[p.pair - 1])])];
  const title = `${inUnit("Reactions and contact forces", "force")}; for a separated pair the ${inUnit("gap", "w")}${steps.length > 0 && whole.length < result.steps.length ? `, ${envelope ? "of all combinations, and " : ""}${whole.length} of ${result.steps.length} steps` : ""}`;
  const sizeOf = (r) => Math.max(...r.slice(1, envelope ? 3 : undefined).map((v) => (Array.isArray(v) ? Math.abs(envelope ? v[0].number : 0) : Math.abs(v ?? 0))));
  return tableOf(title, ["Where", ...(envelope ? ["Least", "Largest", "Largest gap"] : []), ...whole.map((s) => `Step ${stepName(s)}`)], rows.map(([begin, read]) => [...begin, ...whole.map(read)]), most, sizeOf);
}

// The sums of loads, reactions and contact forces of a matrix along each axis.
function sumsByDirection(s) {
  const ofPair = (p, { direction, side, otherU }) => [[2, direction, -side * p.force], [2, places.dofs[otherU]?.direction, side * p.force]];
  const forces = [...pointsOf(s).map((p) => [0, p.direction, p.value]), ...(s.reactions || []).map((r, i) => [1, places.supports[i].direction, r.value]), ...(s.pairs || []).flatMap((p, i) => ofPair(p, places.pairs[i]))];
  const sum = (kind, axis) => forces.reduce((total, [k, direction, value]) => (k === kind && direction === axis ? total + value : total), 0);
  return [1, 2, 3].filter((axis) => forces.some(([, direction]) => direction === axis))
    .map((axis) => [stepName(s), "xyz"[axis - 1], sum(0, axis), places.supports.length > 0 ? sum(1, axis) : null, sum(2, axis)]);
}

const pairCells = (p) => [labelled(p.pair, p.label), ...placeCells(p), p.surface];
const forceOrGap = (p) => (p.state === "separated" ? [{ number: p.gap, at: "gap" }] : p.force);

// Tables with a column for the end of each step, six steps in each table.
function besideEachOther(steps, title, names, begins, read, most = Infinity) {
  if (steps.length === 0) return [];
  const beside = steps.slice(0, 6);
  const sizeOf = most < Infinity ? (r) => Math.max(...r.slice(names.length).map(Math.abs)) : null;
  const rows = begins.map((begin, i) => [...begin, ...beside.map((s) => read(s, i))]);
  return [...tableOf(title, [...names, ...beside.map((s) => `Step ${stepName(s)}`)], rows, most, sizeOf), ...besideEachOther(steps.slice(6), title, names, begins, read, most)];
}

const whenReached = (v) => (startsFromZero() ? nameOfStep(v.step) : `step ${v.step}, increment ${v.increment}`);
const envelopeCell = (v, at = whenReached(v)) => [{ number: v.value, at }];
// Mesh errors are proved at the ends of steps, which the envelope has only of combinations.
const meshErrorIn = (name, v) => (startsFromZero() ? meshErrorOf(result.steps[v.step - 1].mesh, (of) => of[name]) : "");

// The extremes without mesh error over all combinations, if one of them differs by more than 1 % of the largest.
function withoutMeshError(name, range) {
  const known = result.steps.filter((s) => startsFromZero() && s.mesh.extremes?.[name]);
  if (known.length === 0) return [];
  const found = [["min", -1], ["max", 1]].map(([bound, side]) => {
    const s = known.reduce((a, b) => (side * b.mesh.extremes[name][bound] > side * a.mesh.extremes[name][bound] ? b : a));
    return { value: s.mesh.extremes[name][bound], step: s.step, told: range[bound].value };
  });
  const size = Math.max(...found.map(({ value }) => Math.abs(value)));
  return found.some(({ value, told }) => Math.abs(value - told) > 0.01 * size) ? [[`${quantityHead(name)}, without mesh error`, ...found.map((v) => envelopeCell(v, nameOfStep(v.step)))]] : [];
}

// The governing values of the envelope, and its other tables.
function envelopeTables({ pairs, reactions: _, beds = [], hinges = [], watch = [], states, curves, ...ranges }) {
  const lists = [["Bed", "bed", beds], ["Hinge", "hinge", hinges]].flatMap(([words, key, list]) => list.flatMap(({ [key]: number, name, ...numbers }) =>
    Object.entries(numbers).map(([what, range]) => [labelled(`${words} ${number}`, name), quantityHead(`${key}_${what}`), envelopeCell(range.min), envelopeCell(range.max)])));
  const onBeds = pairs.flatMap((p, i) => (places.pairs[i].bed ? [[...pairCells(places.pairs[i]), [{ number: p.force_max, at: whenReached(p) }]]] : []));
  return states === 0 ? [[], []] : [[
    ...(curves ? [element("figure", {}, element("div", { id: "curves", class: "picture" }), element("figcaption", {}, "Least and largest values along the beam. ",
      element("span", { class: "screen-only" }, "Point at a curve to see which step it comes from; click it to show the end of that step.")))] : []),
    ...tableOf(startsFromZero() ? "Least and largest of all combinations" : "Least and largest of all increments", ["Quantity", "Least", "Largest"],
      Object.entries(ranges).flatMap(([name, range]) => [[quantityHead(name), ...[range.min, range.max].map((v) => envelopeCell(v, `${placeOf(v)}; ${whenReached(v)}${v === largestOf(range) ? meshErrorIn(name, v) : ""}`))],
        ...withoutMeshError(name, range)])),
    ...tableOf(hinges.length > 0 ? "Beds and hinges: least and largest values" : "Beds: least and largest values", ["Where", "Quantity", "Least", "Largest"], lists),
    ...tableOf("Watched parts: least and largest values", ["Part", "Quantity", "Least", "Largest"], watchedRows(watch, (v) => `${placeOf(v)}; ${whenReached(v)}`)),
  ], [
    ...(startsFromZero() ? [] : holdTable([], result.envelope, mostReactions)),
    ...tableOf(inUnit("Largest contact force of each pair of a bed", "force"), ["Pair", ...placeHead(), "Surface", "Largest"], onBeds, 40, (r) => Math.abs(r[r.length - 1][0].number)),
  ]];
}

function drawEnvelope() {
  const holder = byId("curves");
  if (!holder) return;
  const { x, ...curves } = result.envelope.curves;
  const count = Object.keys(curves).length;
  const width = widthOf(holder);
  const ends = [x[0], x[x.length - 1]];
  const X = (v) => 74 + ((v - ends[0]) / (ends[1] - ends[0])) * (width - 104);
  const root = canvas(holder, width, 144 * count + 44, "Envelope: least and largest values along the beam");
  Object.entries(curves).forEach(([name, { min, max, min_step, max_step }], k) => {
    const ofCurve = (values, value) => ({ value, x: x[values.indexOf(value)] });
    const range = result.envelope[name] ?? { min: ofCurve(min, spread(min)[0]), max: ofCurve(max, spread(max)[1]) };
    const Y = scaleOfStrip(root, { X, ends }, 8 + 144 * k, name, width < 620 ? inUnit(["w", "M", "V", "p"][k], name) : quantityHead(name), spread([0, range.min.value, range.max.value]), toldOf(range));
    const spots = (values, [first, last]) => values.slice(first, last + 1).map((v, i) => [X(x[first + i]), Y(v)]);
    const whole = [0, x.length - 1];
    root.append(path([...spots(max, whole), ...spots(min, whole).reverse()], `${name}-area`, "Z"));
    for (const [values, steps, bound] of [[min, min_step, "Least"], [max, max_step, "Largest"]]) {
      for (const [first, last] of runsOf(steps)) {
        const points = spots(values, [first, Math.min(last + 1, x.length - 1)]);
        const words = `${bound} ${name} from x = ${rough(x[first])} to ${rough(x[last])}: step ${stepName(result.steps[steps[first] - 1])}`;
        const piece = titled(words, path(points, name), path(points, "under-pointer"));
        const at = frames.findIndex((f) => f.end && f.step === steps[first]);
        if (at >= 0) piece.addEventListener("click", () => show(at));
        root.append(piece);
      }
    }
  });
  scaleAlong(root, ticks(...ends, Math.floor(width / 75)), X, 144 * count + 12);
}

const rangeWords = ([low, high]) => (low === high ? short(low) : `${short(low)} to ${short(high)}`);

function structureRows() {
  if (ofMatrix) return [["Stiffness matrix", structure.matrix], ["SHA-256 of this file", structure.matrix_sha256], ["Entries in this file", String(structure.matrix_entries)], ["Labels of the dofs", structure.labels_from ?? "their numbers"], ["Places of the nodes", structure.places_from ?? "not known"], ["Dofs", structure.dofs.length]];
  const { columns, nodes, D, nu, E, thickness, sections = [] } = structure;
  const sectionWords = ({ element, ...of }, i) => [`Section from x = ${short(nodes[element - 1].x)} to ${short(nodes[(sections[i + 1]?.element ?? nodes.length) - 1].x)}`,
    Object.entries(of).map(([name, value]) => inUnit(`${name} ${short(value)}`, name)).join(", ")];
  const along = ["Nodes along x", columns ?? nodes.length];
  const x = [inLength("x"), rangeWords(spread(nodes.map((n) => n.x)))];
  const runs = (key) => runsOf(structure[key] ?? []).map(([first, last]) => [inUnit(`${key} from x = ${short(nodes[first].x)} to ${short(nodes[last + 1].x)}`, key), structure[key][first]]);
  const joints = (structure.hinges ?? []).map((node, i) => [inUnit(`Hinge at x = ${short(nodes[node - 1].x)}, stiffness`, "couple"), structure.hinge_stiffness[i]]);
  if (structure.EI) return [along, x, ...ofElements.flatMap(runs), ...sections.map(sectionWords), ...joints];
  return [along, x, ["Nodes along y", nodes.length / columns], [inLength("y"), rangeWords(spread(nodes.map((n) => n.y)))],
    ...(E ? [[inUnit("Young's modulus E", "E"), E], [inLength("Thickness t"), thickness]] : []), [inUnit("D", "couple"), D], ["Poisson's ratio", nu]];
}

// The steps; those of a train at its places are one list.
const runsOfTrains = () => runsOf(result.steps.map((s) => (s.train ? JSON.stringify([s.train.name, s.train.factor, s.terms]) : s.step))).map(([first, last]) => result.steps.slice(first, last + 1));
const stepsName = (of) => (of.length === 1 ? stepName(of[0]) : `${of[0].step} to ${of[of.length - 1].step}, ${of[0].train.name}`);
const placesWords = (all) => rangeWords([all[0], all[all.length - 1]]) + (all.length > 1 ? ` by ${short((all[all.length - 1] - all[0]) / (all.length - 1))}, ${all.length} places` : "");

// Returns "1.35 G + 1.5 Q"; a train also has its places.
const termWords = (of) => [...Object.entries(of[0].terms ?? {}), ...(of[0].train ? [[`${of[0].train.name} at ${placesWords(of.map((s) => s.train.at))}`, of[0].train.factor]] : [])]
  .map(([name, factor]) => `${short(factor)} ${name}`).join(" + ").replaceAll("+ \u2212", "\u2212 ");

const inputTables = () => [
  ...tableOf({ beam: "Beam", plate: "Plate", matrix: "Structure from a matrix" }[structure.kind], ["Quantity", "Value"], structureRows()),
  ...tableOf("Supports: fixed, or the stiffness of a spring", [...placeHead(), ...(ofMatrix ? [] : ["Dof"]), "Held"],
    gathered(places.supports, (s) => `${s.dof} ${s.spring}`, 13, supportCells).map(([s, at]) => [...at, ...(ofMatrix ? [] : [s.dof]), s.spring === null ? "fixed" : inUnit(short(s.spring), springKind(s))])),
  ...tableOf("Candidate pairs", ["Pair", ...placeHead(), "Surface", inLength("Face"), inUnit("Stiffness", "stiffness"), "At the start"],
    gathered(places.pairs.filter((p) => !p.bed), (p) => [p.surface, p.face, p.stiffness, p.state].join(" "))
      .map(([p, at, list]) => [labelled(numbersWords(list.map((q) => q.pair)), labelsWords(list)), ...at, p.surface, p.face, p.stiffness, startWords(p)])),
  ...tableOf("Beds: a pair at each node, with the modulus times the node's tributary length or area as its stiffness", ["Pairs", ...placeHead(), "Surface", inLength("Face"), inUnit("Modulus", "modulus"), "At the start"],
    gathered(places.pairs.filter((p) => p.bed), (p) => [p.surface, p.face, modulus(p).toPrecision(9), p.state, p.label].join(" "), 1)
      .map(([p, at, list]) => [labelled(numbersWords(list.map((q) => q.pair)), p.label), ...at, p.surface, p.face, Number(modulus(p).toPrecision(12)), startWords(p)])),
  ...tableOf("Cases: loads as in the problem file, without factors", ["Case", "What", "Where", "Value"], (result.cases ?? []).flatMap((c) => partsOfLoad(c).map((row) => [c.name, ...row.slice(0, 3)]))),
  ...tableOf("Combinations: cases with their factors", ["Step", "Terms"], runsOfTrains().filter(termWords).map((of) => [stepsName(of), termWords(of)])),
  ...tableOf("Loads, settlements and moved faces at the ends of steps", ["Step", "What", "Where", "Value"], runsOfTrains().filter((of) => !result.cases || of[0].train).flatMap(loadRows)),
];

// The names of entries that are listed in one row.
const labelsWords = (list) => { const all = [...new Set(list.map((p) => p.label ?? "").filter(Boolean))]; return all.length > 2 ? `${all[0]} to ${all[all.length - 1]}` : all.join(", "); };
const modulus = (p) => p.stiffness / p.bed;
const startWords = (p) => (p.state === "contact" ? "in contact" : "separated");

// Returns a list of ascending numbers in words: "1 to 9, 12".
const numbersWords = (numbers) => runsOf(numbers.map((n, i) => n - i)).map(([a, b]) => (a === b ? String(numbers[a]) : `${numbers[a]} to ${numbers[b]}`)).join(", ");

// Merges `fewest` or more entries that differ only by place. A row is [first entry, cells of places, all entries].
const gathered = (list, keyOf, fewest = 13, cells = placeCells) => groupsOf(list, keyOf).flatMap((of) => (ofMatrix || of.length < fewest ? of.map((one) => [one, cells(one), [one]])
  : [[of[0], [numbersWords(of.map((one) => one.name)), ...["x", "y"].slice(0, placeHead().length - 1).map((axis) => rangeWords(spread(of.map((one) => one[axis]))))], of]]));

// The loads of steps. Those that all have are listed once; of the others, which move, each is listed with its places.
function loadRows(of) {
  const [all, count] = [of.map(partsOfLoad), new Map()];
  for (const rows of all) for (const row of new Set(rows.map(String))) count.set(row, (count.get(row) ?? 0) + 1);
  const stays = (row) => count.get(String(row)) === of.length;
  const moving = all.flatMap((rows, i) => rows.filter((row) => !stays(row)).map(([what, , value, x]) => ({ what, value, x, offset: Math.round(1e9 * (x - of[i].train.at)) / 1e9 + 0 })));
  const axles = groupsOf(moving, ({ what, value, offset }) => [what, short(value), offset].join());
  return [...all[0].filter(stays), ...axles.map((list) => [list[0].what, `x = ${placesWords(list.map(({ x }) => x))}`, list[0].value])].map((row) => [stepsName(of), ...row.slice(0, 3)]);
}

// The parts of a load: what, where, value, and x of a point.
function partsOfLoad(s) {
  const { uniform = [], settlement = [], curvature = [], moments = [], move = [] } = s.load;
  const part = ({ from, to }) => [from, to].map((at) => (isBeam() ? digits(at, 12) : `(${at.map((x) => digits(x, 12)).join(", ")})`)).join(" to ").replace(/^(?!\()/, "x = ");
  const polynomial = (a) => a.map((c, i) => `${short(c)}${i === 0 ? "" : i === 1 ? " x" : ` x^${i}`}`).join(" + ");
  const at = (p) => (p.between ? `x = ${short(p.x)}` : placed(p.name) + (ofMatrix ? "" : structure.kind === "plate" ? `, (${short(p.x)}, ${short(p.y)})` : `, x = ${short(p.x)}`));
  const points = (load, words, what) => pointsOf({ load }).map((p) => [words + what(p), at(p), p.value, p.x]);
  const motion = (p) => (ofMatrix ? inUnit("along the dof", kindOf(p) === "force" ? "w" : "") : inUnit(p.dof, p.dof));
  const distributed = (d) => (d.self_weight ? "self-weight " : "") + inUnit(isBeam() ? "per length" : "per area", "load");
  const overArea = (m) => ["wx", "wy"].filter((dof) => m[dof]).map((dof) => [inUnit(`${dof}, over an area`, "couple"), part(m), m[dof]]);
  const rows = [...uniform.map((d) => [distributed(d), d.elements ? elementsWords(d.elements) : part(d), d.polynomial ? polynomial(d.polynomial) : d.value]),
    ...points(s.load, "", whatHolds), ...moments.flatMap(overArea), ...curvature.map((c) => ["imposed curvature", part(c), c.value]), ...points({ point: settlement }, "settlement ", motion), ...points({ point: move }, "face moved ", motion)];
  return rows.length > 0 ? rows : [["resultant of all loads", "", sumOf(s)]];
}

// The elements of a load in words; in a beam with the x at both ends.
function elementsWords(elements) {
  if (elements === "all") return "all elements";
  if (Array.isArray(elements)) return `elements ${numbersWords(elements)}`;
  const [first, last] = elements.split("..").map(Number);
  return `elements ${first} to ${last}` + (isBeam() ? `, x = ${short(structure.nodes[first - 1].x)} to ${short(structure.nodes[last].x)}` : "");
}

// ---- head, certificate, unit 26, legend ----

function verdicts() {
  const { words, lockstep } = result;
  const names = calledNames().join(" and ");
  const equal = result.status !== "kernels-disagree";
  const agree = lockstep ? (equal ? "are equal to the bit" : "are NOT equal to the bit") : equal ? "agree in free run" : "do NOT agree in free run";
  return [words.end ? [`Not solved: ${words.end}.`, "bad"] : ["All load is applied.", "good"],
    result.kernels.length < 2 ? ["One kernel ran; nothing was compared.", "note"]
      : lockstep && lockstep.calls === 0 ? ["The kernels were never called; nothing was compared.", "note"]
        : [`${names} ${agree}: ${words.comparison}.`, equal ? "good" : "bad"],
    ...words.rule_1989.map((line) => [`${sentence(line)}`, "note"]),
    ...(words.refined.length > 0 ? [[sentence(words.refined.join("; ")), "note"]] : []),
    ...result.warnings.map((line) => [`Warning: ${line}.`, "note"]),
    ...(words.certificate.length > 0 ? [[sentence(words.certificate.join("; ")), result.certified ? "good" : "bad"]] : [])];
}

function showHead() {
  const { file, date, units, words, project, author, revision } = result;
  const block = [["Project", project], ["Author", author], ["Revision", revision], ["Problem file", file === "-" ? "standard input" : file],
    ["Units", units ? `${units.length}, ${units.force}` : "the problem file names no units"],
    ["Date of the run", date], ["Kernels", `${kernelNames().join(" and ")}, engine ${result.engine}`], ["Program", words.program.join(" · ")]];
  byId("title-block").replaceChildren(...block.filter(([, text]) => text).map(([name, text]) => element("div", {}, element("dt", {}, name), element("dd", {}, text))));
  const size = [[structure.nodes.length, "node"], [structure.edges?.length ?? 0, "edge"], [frames[frames.length - 1].elements.length, "element"],
    [ofMatrix ? places.dofs.length : 0, "dof"]].filter(([n]) => n > 0);
  byId("size").textContent = [...size, [places.pairs.length, "pair"], [result.steps.length, "load step"], [increments.length, "increment"]]
    .map(([n, what]) => counted(n, what)).join(", ");
  byId("verdict").replaceChildren(...verdicts().map(([text, kind]) => element("li", { class: kind }, text)));
  showTitleOnSheets(result.title.trim() || file);
  byId("mesh-words").hidden = !result.steps.some((s) => s.certificate);
  byId("mesh-words").textContent = "Certified means that these are the right numbers" + ({
    none: ". This beam has no mesh error: a finer mesh has the same numbers.",
    proved: " for this mesh. The error of the mesh is proved, and stands beside the largest values.",
    estimated: " for this mesh. The error of the mesh is estimated by halving the element size twice.",
    unknown: " for this mesh. The error of the mesh itself is not judged." })[(result.steps.find((s) => s.mesh.kind === "unknown") ?? result.steps[0])?.mesh.kind];
}

// Puts the title into the CSS rule for the margin of printed pages, because margins cannot contain elements.
function showTitleOnSheets(title) {
  const inCss = title.replace(/[^\p{L}\p{N} .,:;()+-]/gu, (c) => `\\${c.codePointAt(0).toString(16)} `);
  byId("sheets")?.remove();
  document.head.append(element("style", { id: "sheets" }, `@page { @top-left { content: "${inCss}"; } }`));
}

function showCertificate() {
  const steps = result.steps.map((s) => s.certificate);
  const small = (x) => (x === null || x === undefined ? "–" : minus(x === 0 ? "0" : x.toExponential(1)));
  const columns = { displacement_error: "error of deflections", shape_error: "error of any number", equilibrium: "equilibrium", penetration: "penetration",
    tension: "tension", tolerance: "allowed", digits: "digits" };
  const words = ["A step is certified if the errors of all numbers of its final state are proved to be at most the allowed errors."];
  if (result.words.certificate.length > 0) words.push(sentence(result.words.certificate.join("; ")));
  words.push(...result.words.complaints.map(sentence));
  if (steps.length === 0) words.push("No step reached its full load, so there is nothing to certify.");
  fill("certificate", "Is the answer right?", words.join(" "), ...tableOf("Certificates", ["Step", "Certificate", ...Object.values(columns)],
    steps.map((c, i) => [stepName(result.steps[i]), markOf(c), ...Object.keys(columns).map((name) => (name === "digits" && c ? String(c.digits) : small(c?.[name])))])));
  byId("certificate").hidden = false;
}

function showLog() {
  const [leader] = calledNames();
  fill("log", "Unit 26", result.log === "" ? `${leader} wrote nothing to unit 26.` : `The text that ${leader} wrote to unit 26.`,
    element("pre", { id: "log-text", class: "scroll", tabindex: "0", role: "region", "aria-label": "Unit 26" }, result.log));
}

function showCuts() {
  for (const note of structure.notes || []) cuts.add(note);
  const drawn = result.steps.filter((s) => s.displacement);
  if (drawn.length < result.steps.length)
    cuts.add(`${drawn.length} of ${result.steps.length} combinations are listed with increments, contact forces and reactions, and can be drawn on screen: those with the least and ` +
      "largest values, those that did not reach their load, and others evenly chosen. Of the other combinations, the largest values are listed.");
  const within = increments.length + 1 + drawn.filter((s) => !endsAt(s, s.increments.length - 1)).length;
  if (frames.length < within) cuts.add(`The path has ${increments.length} increments; the slider stops at ${frames.length} states: the start, some of the ` +
      "increments, evenly chosen, and the ends of steps.");
  const isSum = ({ words, uniform, point, moments, settlement, curvature, move }) => words !== "none" && words !== "" && !uniform && !point && !moments && !settlement && !curvature && !move;
  if (frames.some((f) => isSum(f.load))) cuts.add("Within steps, loads of more than 32 parts are not drawn: their sum is told.");
  if (result.log.length < result.log_bytes) cuts.add(`Of ${result.log_bytes} bytes of unit 26 the first ${result.log.length} are shown.`);
  const none = element("li", { class: "screen-only" }, `Nothing: every increment, ${unitOf()}, pair and call is on this page.`);
  byId("cuts").replaceChildren(...(cuts.size > 0 ? [...cuts].map((text) => element("li", {}, text)) : [none]), element("li", { class: "print-only" },
    "Not on paper, but in the page's file: its appendix unless it is printed too, states within steps, the pairs of each state, increments after the first 60, the kernels' calls and sources, and unit 26."));
}

const pictureWords = {
  beam: "Up is positive. Numbers under supports are reactions. Moments are positive where the beam sags; the shear V = dM/dx is the upward " +
    "force of the part left of a cut on the part right of it. Dots are at the largest values.",
  plate: "Colours are the same in all states: dark is low. Up is positive; moments are positive where the plate sags. Colours are means of the elements at " +
    "each node; marked values, and those of tables, are at the corner of one element. Numbers at supports are reactions.",
  matrix: "A face is drawn beside its node, across the direction of the pair's dof, at its distance from the undeformed node, magnified as displacements " +
    "are. Numbers at supports are reactions.",
  none: "No coordinates of this structure are known, so it is not drawn. [matrix] takes coordinates, [calculix] the mesh in CalculiX's input.",
};

function showLegend() {
  const there = (test) => frames.some((f) => f.pairs.some(test));
  const loaded = frames.some((f) => [...pointsOf(f), ...(f.load.uniform || []), ...(f.load.curvature || []), ...(f.load.moments || [])].length > 0);
  const items = [
    [there((p) => p.look === "c"), "in contact, with a force", () => pairMark("c", 11, 9, 5)],
    [there((p) => p.look === "o"), "separated, with a gap", () => pairMark("o", 11, 9, 5)],
    [there((p) => p.look === "f" && !p.closed), "at its face, separated", () => pairMark("f", 11, 9, 5)],
    [there((p) => p.look === "f" && p.closed), "at its face, in contact, no force", () => pairMark("f", 11, 9, 5, true)],
    [places.pairs.length > 0, "face, hatched behind", () => shape("M2 8h18M4 8l-4 6M10 8l-4 6M16 8l-4 6", "face-line")],
    [there((p) => p.force > 0), "contact force", () => arrow(11, 17, 0, -15, "force")],
    [there((p) => p.look === "c"), "where a pressed face stood", () => line(0, 9, 22, 9, "spring")],
    [hasBed() && places.pairs.some((p) => !p.bed), "large: a pair apart from beds", () => pairMark("o", 11, 9, 7)],
    [loaded, "load", () => arrow(11, 1, 0, 15, "load")],
    [true, "undeformed", () => line(0, 9, 22, 9, "was")],
    [places.supports.some((s) => s.direction <= 3), "support", () => shape("M11 3l7 12h-14Z", "support")],
    [places.supports.some((s) => s.direction > 3), "support of a slope", () => shape("M5 3h12v12h-12Z", "thin")],
    [scene && scene.still.length > 0, "node without a dof: it does not move", () => shape("M8 6l6 6m-6 0l6 -6", "thin")],
  ];
  byId("legend").replaceChildren(...items.filter(([isThere]) => scene && isThere).map(([, words, mark]) =>
    element("li", {}, svg("svg", { width: 22, height: 18, viewBox: "0 0 22 18", "aria-hidden": "true" }, mark()), words)));
  byId("picture-words").textContent = pictureWords[scene ? structure.kind : "none"];
}

// Shows the control that chooses the quantity of a plate.
function offerFields() {
  byId("field-label").hidden = byId("field").hidden = fields.length === 0;
  byId("field").replaceChildren(...fields.map(({ name, words }) => element("option", { value: name }, words)));
  byId("field").value = field && field.name;
  byId("save").hidden = scene === null;
}

// ---- the shown state ----

let current = 0;

// Called after a state is drawn. The playground replaces this function by one that adds handles to the picture.
let afterDrawing = () => {};

const draw = () => { drawPicture(frames[current], byId("picture")); afterDrawing(frames[current]); };

function show(n) {
  current = Math.max(0, Math.min(frames.length - 1, n));
  const f = frames[current];
  const slider = byId("slider");
  slider.value = String(current);
  slider.setAttribute("aria-valuetext", `${where(f)}, state ${current + 1} of ${frames.length}`);
  byId("state").textContent = stateWords(f);
  draw();
  drawChart(f);
  drawEnvelope();
  showPairs(f);
  markCurrentRow(f);
}

function listen() {
  const go = (id, event, to) => byId(id).addEventListener(event, () => show(to()));
  go("slider", "input", () => Number(byId("slider").value));
  go("back", "click", () => current - 1);
  go("next", "click", () => current + 1);
  byId("field").addEventListener("change", (e) => { field = fields.find((f) => f.name === e.target.value); draw(); });
  let width = innerWidth;
  addEventListener("resize", () => { if (innerWidth !== width && result) show(current); width = innerWidth; });
  byId("save").addEventListener("click", savePicture);
  addEventListener("beforeprint", () => { printing = true; drawSheets(); show(frames.length - 1); });
  addEventListener("afterprint", () => { printing = false; byId("ends").after(byId("input")); show(current); });
}

// Prepares the printed page: puts the input with a sketch first, and draws the ends of steps in each quantity.
function drawSheets() {
  byId("structure").before(byId("input"));
  if (scene === null) return;
  const drawn = (f, words, isSketch = false) => {
    const holder = element("div", { class: "picture" });
    drawPicture(f, holder, isSketch);
    return element("figure", { class: "print-only" }, holder, element("figcaption", {}, words));
  };
  const loaded = result.steps[result.steps.length - 1];
  byId("system").replaceChildren(...(loaded ? [drawn({ ...frames[0], load: loaded.load }, `The undeformed structure with supports, pairs and the loads of step ${stepName(loaded)}: ${minus(loaded.load.words)}.`, true)] : []));
  const chosen = field;
  const steps = governingEnds();
  const ends = frames.filter((f) => f.end && steps.has(f.step));
  const governs = (of) => ends.reduce((a, b) => (Math.max(...atNodes(b, of.name).map(Math.abs)) > Math.max(...atNodes(a, of.name).map(Math.abs)) ? b : a));
  const wanted = fields.length === 0 ? ends.map((f) => ({ f })) // stresses follow the moments
    : ends.length === 0 ? [] : fields.filter(({ words }) => !/stress/.test(words)).map((of) => ({ f: governs(of), of }));
  const told = steps.size < result.steps.length ? [`The ends of ${steps.size} of ${result.steps.length} steps are drawn: those with the largest values.`] : [];
  byId("ends-drawn").classList.toggle("in-columns", fields.length > 0);
  byId("ends-drawn").replaceChildren(...told.map((text) => cuts.add(text) && element("p", { class: "print-only" }, text)), ...wanted.map(({ f, of }) => {
    [field, widthOnPaper] = [of, of ? 470 : 940];
    return drawn(f, of ? `Step ${nameOfStep(f.step)}: ${of.words}.` : stateWords(f));
  }));
  [field, widthOnPaper] = [chosen, 940];
  showCuts();
}

// The steps in which a quantity is largest, at most three.
function governingEnds(most = 3) {
  const steps = result.steps.filter((s) => s.displacement);
  const [force, ...sizes] = sizesOf(steps);
  const governing = [...sizes, force].map((size) => steps.reduce((a, b) => (size(b) > size(a) * (1 + 1e-9) ? b : a)).step);
  return new Set([...new Set(steps.length <= most ? steps.map((s) => s.step) : governing)].slice(0, most));
}

// The number of the state with the largest deflection.
const mostMoved = () => frames.reduce((best, f, i) => (Math.abs(mostOf(f).value) > Math.abs(mostOf(frames[best]).value) ? i : best), frames.length - 1);

// Shows a result at `state`, by default that with the largest deflection. showRest adds what only a report has.
function load(given, state = null) {
  read(given);
  preparePicture();
  prepareChart();
  showHead();
  showLegend();
  offerFields();
  showEvents();
  byId("slider").max = String(frames.length - 1);
  show(state ?? mostMoved());
}

function showRest() {
  const [governing, all] = endTables();
  const [extremes, others] = result.envelope ? envelopeTables(result.envelope) : [[], []];
  const ofCombinations = startsFromZero();
  fill("ends", "Governing results", "", ...(ofCombinations ? extremes : []), ...governing);
  fill("all-ends", "All results at the ends of steps", "", ...all);
  fill("envelope", ofCombinations ? "Envelope of the combinations" : "Envelope of the path", "", ...(ofCombinations ? [] : extremes), ...others);
  drawEnvelope();
  fill("input", "Input", "", element("div", { id: "system" }), ...inputTables());
  showCalls();
  showCertificate();
  showLog();
  showCuts();
}
