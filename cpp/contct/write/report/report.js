// The report of a run: its tables and words, and the way through its states. The playground has it in its page, too.
"use strict";

const known = { fortran: "FORTRAN", cpp: "C++", "fortran-r4": "FORTRAN (4-byte REAL)", "cpp-r4": "C++ (4-byte REAL)" };
const kernelNames = () => result.kernels.map((name) => known[name] || name);
const where = (f) => (f.step === 0 ? "Start" : f.number === 0 ? `${f.step}, end` : `${f.step}.${f.number}`);

// ---- load against deflection ----

let byForce = true;  // the load is told by its sum; else by the number of steps
let paths = [];      // of which nodes or dofs the path can be drawn
let followed = null;

const sumOf = (f) => f.load.force ?? f.load.sum ?? 0;
const measure = (f) => (byForce ? sumOf(f) : f.step === 0 ? 0 : f.step - 1 + f.fraction);

// The dofs that are deflections, by number. Of a matrix those that are known to be lengths, or all.
function deflectingDofs() {
  if (!ofMatrix) return structure.nodes.map((_, i) => i * dofsPerNode[structure.kind]);
  const met = new Set(places.pairs.map((p) => p.u));
  const lengths = structure.dofs.flatMap((d, i) => (met.has(i) || (d.at && d.direction >= 1 && d.direction <= 3) ? [i] : []));
  return lengths.length > 0 || mesh ? lengths : structure.dofs.map((_, i) => i);
}

// First the node that moves most, then every node, or some, or those of pairs.
function pathsOf() {
  const most = { u: 0, size: -1 };
  for (const u of deflectingDofs()) {
    for (const f of frames) if (Math.abs(f.u[u]) > most.size) Object.assign(most, { u, size: Math.abs(f.u[u]) });
  }
  const stride = dofsPerNode[structure.kind];
  const all = ofMatrix ? [...new Set(places.pairs.map((p) => p.u))] : evenly(structure.nodes.length, 400).map((i) => i * stride);
  return [most.u, ...all.filter((u) => u !== most.u)].map((u) => ({ name: String(nameOf((structure.dofs || structure.nodes)[u / stride])), read: (f) => f.u[u] }));
}

function preparePaths() {
  const [least, most] = spread(frames.map(sumOf));
  byForce = most - least > 1e-9 * Math.max(Math.abs(least), Math.abs(most));
  paths = pathsOf();
  followed = paths.find((p) => followed && p.name === followed.name) || paths[0];
  byId("chart-node-label").textContent = `Path of ${unitOf()}`;
  const byNumber = [...paths].sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }));
  byId("chart-node").replaceChildren(...byNumber.map((p) => element("option", { value: p.name }, p === paths[0] ? `${p.name} (moves most)` : p.name)));
  byId("chart-node").value = followed.name;
}

function drawChart(f) {
  const holder = byId("chart");
  const width = widthOf(holder);
  const height = width < 520 ? 280 : 340;
  const room = { left: 84, right: 28, top: 34, bottom: 54 };
  const [x0, x1] = padded(spread(frames.map(followed.read)));
  const [y0, y1] = padded(spread(frames.map(measure)));
  const bottom = height - room.bottom;
  const X = (v) => room.left + ((v - x0) / (x1 - x0)) * (width - room.left - room.right);
  const Y = (v) => bottom - ((v - y0) / (y1 - y0)) * (bottom - room.top);
  const spot = (g) => [X(followed.read(g)), Y(measure(g))];
  const root = canvas(holder, width, height,
    `Load against the ${moves()} of ${placed(followed.name)}, ${frames.length} states; now load ${rough(measure(f))}, ${moves()} ${rough(followed.read(f))}`);
  scaleAlong(root, ticks(x0, x1, Math.floor(width / 95)), X, bottom, room.top);
  scaleUp(root, ticks(y0, y1, 5), Y, room.left, width - room.right, 8);
  const sum = ofMatrix ? "Sum of the loads" : inUnit("Sum of the loads, positive up", "force");
  root.append(panelTitle(room.left, 18, byForce ? sum : "Steps of load applied"));
  root.append(axisWord(width - room.right, height - 12, `${ofMatrix ? moves() : inUnit("deflection w", "w")} of ${placed(followed.name)}`, "end"));
  const [x, y] = spot(f);
  root.append(line(x, y, x, bottom, "cross"), line(room.left, y, x, y, "cross"), path(frames.map(spot), "track"));
  for (const g of frames) root.append(chartMark(g, ...spot(g)));
  root.append(svg("circle", { cx: x, cy: y, r: 9, class: "here" }));
}

function padded([low, high]) {
  const reach = high - low || Math.abs(high) || 1;
  return [low - 0.06 * reach, high + 0.06 * reach];
}

function chartMark(f, x, y) {
  const r = frames.length > 60 ? 2.6 : 4.4;
  const makes = f.events.some((e) => e.change === "make");
  return titled(`${where(f)}: ${f.events.length > 0 ? allEventWords(f.events) : f.end ? "end of step" : "no event"}`, f.events.length === 0
    ? svg("rect", { x: x - r, y: y - r, width: 2 * r, height: 2 * r, class: "step-end" })
    : svg("circle", { cx: x, cy: y, r, class: makes ? "make" : "break" }));
}

// ---- tables ----

const row = (...cells) => element("tr", {}, ...cells);
const head = (...names) => element("thead", {}, row(...names.map(([name, words]) => element("th", { scope: "col", ...(words ? { class: "words" } : {}) }, name))));

function cell(value, attributes = {}) {
  if (typeof value !== "number") return element("td", { class: "words", ...attributes }, value);
  return element("td", { "data-value": String(value), title: String(value), ...attributes }, short(value));
}

const rowHead = (words) => element("th", { scope: "row" }, words);

// A table of the page with these rows; it is hidden where there is none.
function fill(id, names, rows) {
  byId(id).parentElement.hidden = rows.length === 0;
  byId(id).replaceChildren(head(...names), element("tbody", {}, ...rows));
}

const mostPairRows = 250;
const mostEventRows = 1200;

function showPairs(f) {
  const all = f.pairs.length;
  byId("pairs-words").textContent = all === 0 ? "The problem has no contact pairs."
    : `State ${where(f)}. A gap is that of a separated pair. A contact force is positive when it pushes the structure off the face; a negative one is tension.` +
      (all > mostPairRows ? ` The first ${mostPairRows} of ${all} pairs are listed.` : "");
  fill("pair-table", [["Pair"], ofMatrix ? ["Dof", true] : ["Node"], ["Surface", true], ["Face"], ["State", true], ["Gap"], ["Force"]],
    f.pairs.slice(0, mostPairRows).map((p) => row(rowHead(String(p.pair)), cell(p.name, { "data-value": String(p.name) }),
      cell(p.surface), cell(p.face), cell(lookWords(p)), cell(p.gap), cell(p.force))));
}

function showEvents() {
  byId("events-words").textContent = increments.length === 0 ? "The path has no increment."
    : `${counted(increments.length, "increment")}. Share is the share of the step that is applied after the increment; ` +
      `s is the share of the remaining load that the increment applies, which the paper calls the scale factor.`;
  const stops = new Map(frames.map((f, i) => [where(f), i]));
  fill("event-table", [["Increment"], ["Share"], ["s"], ["Load", true], ["Events", true]],
    increments.slice(0, mostEventRows).map((i) => eventRow(i, stops)));
}

function eventRow(i, stops) {
  const name = `${i.step}.${i.number}`;
  const stop = stops.get(name);
  const button = element("button", { type: "button", "aria-label": `Show increment ${name}` }, name);
  button.addEventListener("click", () => { stopPlaying(); show(stop); });
  return element("tr", { "data-increment": name }, rowHead(stop === undefined ? name : button),
    cell(i.fraction), cell(i.snap ? "snap" : i.s), cell(minus(i.load.words)),
    cell(i.events.length > 0 ? allEventWords(i.events) : "–", { class: "words wrap" }));
}

function markCurrentRow(f) {
  for (const r of byId("event-table").querySelectorAll("tr.current")) r.classList.remove("current");
  byId("event-table").querySelector(`tr[data-increment="${where(f)}"]`)?.classList.add("current");
}

function showCalls() {
  const [leader, ...others] = kernelNames();
  byId("comparison-heading").textContent = others.length > 0 ? kernelNames().join(" against ") : `Calls of ${leader}`;
  const words = [others.length === 0 ? "One kernel ran, so nothing was compared. These are its answers."
    : !result.lockstep ? `Free run: each kernel followed its own path, so single calls were not compared: ${result.words.comparison}. The calls of ${leader}:`
      : `Lockstep: ${others.join(" and ")} had the same input as ${leader} at every call: ${result.words.comparison}. ` +
        "A distance of 0 ULP means equal to the bit. Compared are SMIN, every s, every status, and the text of unit 26 where both have one."];
  const { calls } = result;
  const pairs = Math.max(0, ...calls.map((c) => c.s.length));
  if (result.calls_made === 0) words.push("No call was made.");
  else if (places.pairs.length > pairs) words.push(`Distances are over all pairs; s is listed for the first ${pairs} of ${places.pairs.length}.`);
  if (calls.length < result.calls_made) cuts.add(`Of ${result.calls_made} calls the first ${calls.length} are listed.`);
  byId("comparison-words").textContent = words.join(" ");
  const compared = result.lockstep ? others : [];
  const names = compared.flatMap((k) => [[`ULP off in SMIN, ${k}`], ["ULP off in any s"], ["values compared"], ["different"]]);
  const of = (a) => (!a || a.failed ? ["no answer", "no answer", "–", "–"] : [a.smin_ulps, a.s_ulps, a.values, a.mismatches]);
  const ofPairs = Array.from({ length: pairs }, (_, i) => [`s of pair ${i + 1}`]);
  fill("call-table", [["Call"], ["Increment", true], [`SMIN of ${leader}`], ...names, ...ofPairs],
    calls.map((c, n) => row(rowHead(String(n + 1)), cell(c.step === 0 ? "settling" : `${c.step}.${c.increment}`),
      ...[c.smin, ...compared.flatMap((_, k) => of(c.followers[k])), ...c.s].map((value) => cell(value)))));
}

const markOf = (c) => (!c ? "no certificate" : c.exact ? "certified" : "NOT certified");

function showCertificate() {
  const steps = result.steps.map((s) => s.certificate);
  const own = steps.filter((c) => c && !c.independent).length;
  const say = (text, kind) => element("p", kind ? { class: kind } : {}, text);
  byId("certificate-words").replaceChildren(
    say("A step is certified when the errors of all numbers of its final state are within the allowed ones: by proved bounds, " +
      "or, where none can be proved, by comparison with the reference solution. That is the minimiser of the structure's energy; it uses neither the kernels nor the path."),
    ...(result.words.certificate.length > 0 ? [say(sentence(result.words.certificate.join("; ")), result.certified ? "good" : "bad")] : []),
    ...result.words.complaints.map((text) => say(sentence(text))),
    ...(steps.length === 0 ? [say("No step reached its full load, so there is nothing to certify.")] : []),
    ...(own > 0 ? [say(`${counted(own, "state")} came from the reference solution itself, so a comparison with it shows nothing: ` +
      `only equilibrium, penetration and tension are judged there.`)] : []));
  const small = (x) => (x === null || x === undefined ? "–" : minus(x === 0 ? "0" : x.toExponential(1)));
  const names = ["displacement_error", "shape_error", "equilibrium", "penetration", "tension", "tolerance"];
  fill("certificate-table", [["Step"], ["Certificate", true], ["error of deflections"], ["error of shape"], ["equilibrium"],
    ["penetration"], ["tension"], ["allowed"], ["digits"]],
    steps.map((c, i) => row(rowHead(String(i + 1)), cell(markOf(c)),
      ...names.map((name) => element("td", c ? { title: String(c[name]) } : {}, c ? small(c[name]) : "–")),
      element("td", {}, c ? String(c.digits) : "–"))));
}

// ---- tables of the input and of the ends of steps, as the run has them ----

// A cell is a text, a number, null, or a list of numbers, each with where it is.
function cellOf(value, words) {
  if (value === null) return element("td", words ? { class: "words" } : {}, "–");
  if (!Array.isArray(value)) return cell(value);
  return element("td", {}, ...value.flatMap(({ number, kind, at }) => [
    element("span", { "data-value": String(number), title: String(number) }, isRounding(kind, number) ? "0" : short(number)),
    ...(at && !isRounding(kind, number) ? [element("small", {}, at)] : [])]));
}

// Texts are to the left, as their headings are; a step's or a pair's number comes first and heads its row.
function tableOf(title, names, rows) {
  const words = names.map((_, i) => rows.every((r) => r[i] === null || typeof r[i] === "string"));
  return element("div", { class: rows.length > 12 ? "scroll" : "scroll whole", tabindex: "0", role: "region", "aria-label": title },
    element("p", { class: "caption" }, title), element("table", { "aria-label": title }, head(...names.map((name, i) => [name, words[i]])),
      element("tbody", {}, ...rows.map(([first, ...rest]) => row(element("th", { scope: "row", class: "words" }, first),
        ...rest.map((value, i) => cellOf(value, words[i + 1])))))));
}

const mostTableRows = 40;
// The first rows, or those of the largest size; what is cut is told in the title and at the end of the page.
function cutTable(title, names, rows, sizeOf = null) {
  if (rows.length === 0) return [];
  if (rows.length <= mostTableRows) return [tableOf(title, names, rows)];
  const how = `${sizeOf ? "largest" : "first"} ${mostTableRows} of ${rows.length}`;
  cuts.add(`${title}: the table has the ${how} rows.`);
  const order = sizeOf ? [...rows].sort((a, b) => sizeOf(b) - sizeOf(a)) : rows;
  const kept = new Set(order.slice(0, mostTableRows));
  return [tableOf(`${title} (${how})`, names, rows.filter((r) => kept.has(r)))];
}

// Beside the largest of its kind, at the ends of all steps, a number may be nothing but rounding: it is shown as 0.
let sizes = {};
const isRounding = (kind, number) => number !== 0 && Math.abs(number) <= 1e-12 * sizes[kind];
const kindOf = (name) => (name.startsWith("m") ? "moment" : name);
const kindOfSupport = (s) => (s.dof === "w" || ofMatrix ? "force" : "reaction moment");

function takeSizes() {
  sizes = {};
  const take = (kind, number) => { sizes[kind] = Math.max(sizes[kind] || 0, Math.abs(number)); };
  for (const s of result.steps) {
    for (const [name, range] of Object.entries(s.extremes)) take(kindOf(name), largestOf(range).value);
    for (const p of s.pairs) take("force", p.force);
    for (const r of s.reactions) take(kindOfSupport(r), r.value);
  }
}

const stepName = (s) => (s.name ? `${s.step}, ${s.name}` : String(s.step));
const inLength = (name) => inUnit(name, "w");
const placeHead = () => (ofMatrix ? ["Dof"] : structure.kind === "plate" ? ["Node", inLength("x"), inLength("y")] : ["Node", inLength("x")]);
const placeCells = (p) => (ofMatrix ? [p.name] : structure.kind === "plate" ? [String(p.name), p.x, p.y] : [String(p.name), p.x]);
// A support's dofs one by one, in the order of their reactions.
const supportRows = () => places.supports.flatMap((s) => s.dofs.map(([dof, spring, number]) => ({ ...s, dof, spring, number }))).sort((a, b) => a.number - b.number);
const whatHolds = (s) => (ofMatrix ? "" : inUnit(s.dof, s.dof === "w" ? "force" : "moment"));
const quantityHead = (name) => inUnit(/^m[xy]/.test(name) || name === "w" ? name : sentence(name).slice(0, -1), name);
const largestBy = (list, value) => list.reduce((a, b) => (Math.abs(value(b)) > Math.abs(value(a)) ? b : a));

// The larger of both values by magnitude, then the other one where its sign differs.
function rangeCell(name, range) {
  const first = largestOf(range);
  const second = first === range.max ? range.min : range.max;
  const told = second.value * first.value < -1e-9 * first.value ** 2 ? [first, second] : [first];
  return told.map((v) => ({ number: v.value, kind: kindOf(name), at: placeOf(v) }));
}

function endTables() {
  const steps = result.steps.slice(0, 24);
  if (steps.length < result.steps.length) cuts.add(`Tables have the ends of ${steps.length} of ${result.steps.length} steps.`);
  if (steps.length === 0) return [];
  const quantities = Object.keys(steps[0].extremes);
  const force = (s) => {
    const p = largestBy(s.pairs, (q) => q.force);
    return p.force === 0 ? null : [{ number: p.force, kind: "force", at: `pair ${p.pair}, ${placed(nameOf(p))}` }];
  };
  const reaction = (s) => {
    const r = largestBy(s.reactions, (q) => q.value);
    return [{ number: r.value, kind: kindOfSupport(r), at: `${ofMatrix ? "" : `${r.dof} at `}${placed(nameOf(r))}` }];
  };
  const [pairs, supports] = [structure.pairs.length > 0, structure.supports.length > 0];
  return [
    ...cutTable("Largest values at the end of each step",
      ["Step", "Share", ...quantities.map(quantityHead), ...(pairs ? [inUnit("Contact force", "force")] : []), ...(supports ? ["Reaction"] : []), "Certificate"],
      steps.map((s) => [stepName(s), s.fraction, ...quantities.map((name) => rangeCell(name, s.extremes[name])), ...(pairs ? [force(s)] : []),
        ...(supports ? [reaction(s)] : []), markOf(s.certificate)])),
    ...besideEachOther(steps, inUnit("Contact forces", "force"), ["Pair", ...placeHead(), "Surface"],
      places.pairs.map((p) => [String(p.pair), ...placeCells(p), p.surface]), (s, i) => ({ number: s.pairs[i].force, kind: "force" }), true),
    ...besideEachOther(steps, "Reactions: what supports exert on the structure", [...placeHead(), "What"], supportRows().map((s) => [...placeCells(s), whatHolds(s)]),
      (s, i) => ({ number: s.reactions[i].value, kind: kindOfSupport(s.reactions[i]) }), false),
  ];
}

// The ends of steps as columns, six in each table; rows that are 0 in all of them may be left out.
function besideEachOther(steps, title, names, begins, read, zerosLeftOut) {
  const sizeOf = (i) => Math.max(...steps.map((s) => Math.abs(read(s, i).number)));
  const told = begins.map((_, i) => i).filter((i) => !zerosLeftOut || sizeOf(i) > 0);
  const zeros = begins.length - told.length;
  const whole = zeros === 0 ? title : `${title}; ${zeros} that are 0 at all of these ends have no row`;
  if (zeros > 0) cuts.add(`${whole}.`);
  const tables = [];
  for (let from = 0; from < steps.length; from += 6) {
    const beside = steps.slice(from, from + 6);
    const rows = new Map(told.map((i) => [[...begins[i], ...beside.map((s) => [read(s, i)])], sizeOf(i)]));
    tables.push(...cutTable(whole, [...names, ...beside.map((s) => `Step ${stepName(s)}`)], [...rows.keys()], (r) => rows.get(r)));
  }
  return tables;
}

function envelopeTables({ pairs, reactions, states, ...ranges }) {
  const when = (v) => `step ${v.step}, increment ${v.increment}`;
  const bound = (v, at = when(v)) => [{ number: v.value ?? v.force_max, at }];
  return states === 0 ? [] : [
    ...cutTable("Least and largest of all increments", ["Quantity", "Least", "Largest"],
      Object.entries(ranges).map(([name, range]) => [quantityHead(name), ...[range.min, range.max].map((v) => bound(v, `${placeOf(v)}; ${when(v)}`))])),
    ...cutTable(inUnit("Largest contact force of each pair", "force"), ["Pair", ...placeHead(), "Surface", "Largest"],
      pairs.map((p, i) => [String(p.pair), ...placeCells(places.pairs[i]), places.pairs[i].surface, bound(p)])),
    ...cutTable("Reactions: what supports exert on the structure", [...placeHead(), "What", "Least", "Largest"],
      supportRows().map((s) => [...placeCells(s), whatHolds(s), bound(reactions[s.number].min), bound(reactions[s.number].max)])),
  ];
}

// Neighbouring entries that are alike are one row, from the first to the last of them.
function runs(list) {
  const found = [];
  list.forEach((entry, i) => {
    if (i > 0 && entry === list[i - 1]) found[found.length - 1][1] = i;
    else found.push([i, i]);
  });
  return found;
}

function structureTable() {
  if (ofMatrix) return cutTable("Structure from a matrix", ["Quantity", "Value"], [["Stiffness matrix", structure.matrix], ["Dofs", structure.dofs.length]]);
  const { columns, nodes, D, nu, EI } = structure;
  if (beam) {
    return cutTable("Beam", ["Elements", inLength("From x"), inLength("to x"), inUnit("EI", "EI")],
      runs(EI).map(([first, last]) => [first === last ? String(first + 1) : `${first + 1}..${last + 1}`, nodes[first].x, nodes[last + 1].x, EI[first]]));
  }
  const lines = (name, values) => [name, values.length, values[0], values[values.length - 1]];
  return cutTable("Plate", ["Quantity", "Value", inLength("From"), inLength("to")], [[inUnit("D", "moment"), D, null, null], ["Poisson's ratio", nu, null, null],
    lines("Grid lines along x", nodes.slice(0, columns).map((n) => n.x)), lines("Grid lines along y", nodes.filter((_, i) => i % columns === 0).map((n) => n.y))]);
}

const inputTables = () => [
  ...structureTable(),
  ...cutTable("Supports: fixed, or the stiffness of a spring", [...placeHead(), "Dof", "Held"],
    supportRows().map((s) => [...placeCells(s), s.dof, s.spring === null ? "fixed" : short(s.spring)])),
  ...cutTable("Candidate pairs", ["Pair", ...placeHead(), "Surface", inLength("Face"), inUnit("Stiffness", "stiffness"), "At the start"],
    places.pairs.map((p) => [String(p.pair), ...placeCells(p), p.surface, p.face, p.stiffness, p.state === "contact" ? "in contact" : "separated"])),
  ...cutTable("Loads and settlements at the ends of steps", ["Step", "What", "Where", "Value"], result.steps.flatMap((s) => loadRows(s))),
];

function loadRows(s) {
  const { uniform = [], settlement = [] } = s.load;
  const polynomial = (a) => a.map((c, i) => `${short(c)}${i === 0 ? "" : i === 1 ? " x" : ` x^${i}`}`).join(" + ");
  const rows = [...uniform.map((d) => [stepName(s), beam ? "per length" : "pressure", `elements ${d.elements}`, d.polynomial ? polynomial(d.polynomial) : d.value]),
    ...pointsOf(s).map((p) => [stepName(s), p.dof, placed(p.name), p.value]),
    ...pointsOf({ load: { point: settlement } }).map((p) => [stepName(s), `settlement ${p.dof}`, placed(p.name), p.value])];
  return rows.length > 0 ? rows : [[stepName(s), "resultant of all loads", "", s.load.force ?? s.load.sum]];
}

function showTables() {
  takeSizes();
  for (const [name, tables] of Object.entries({ input: inputTables(), ends: endTables(), envelope: result.envelope ? envelopeTables(result.envelope) : [] })) {
    byId(`${name}-tables`).replaceChildren(...tables);
    byId(name).hidden = tables.length === 0;
  }
}

// ---- what stands still: head, legend, unit 26 ----

function verdicts() {
  const { words, lockstep } = result;
  const names = kernelNames().join(" and ");
  const equal = result.status !== "kernels-disagree";
  const agree = lockstep ? (equal ? "are equal to the bit" : "are NOT equal to the bit") : equal ? "agree in free run" : "do NOT agree in free run";
  return [words.end ? [`Not solved: ${words.end}.`, "bad"] : ["All load is applied.", "good"],
    result.kernels.length < 2 ? ["One kernel ran; nothing was compared.", "note"]
      : lockstep && lockstep.calls === 0 ? ["The kernels were never called; nothing was compared.", "note"]
        : [`${names} ${agree}: ${words.comparison}.`, equal ? "good" : "bad"],
    ...(words.certificate.length > 0 ? [[sentence(words.certificate.join("; ")), result.certified ? "good" : "bad"]] : [])];
}

function showHead() {
  const { file, date, units, words } = result;
  const block = [["Problem file", file === "-" ? "standard input" : file],
    ["Units", units ? `${units.length}, ${units.force}` : "as in the problem file, which names none"],
    ["Date of the run", date], ["Kernels", `${kernelNames().join(" and ")}, engine ${result.engine}`], ["Program", words.program.join(" · ")]];
  byId("title-block").replaceChildren(...block.filter(([, text]) => text).map(([name, text]) => element("div", {}, element("dt", {}, name), element("dd", {}, text))));
  const size = mesh ? [counted(structure.nodes.length, "node"), counted(structure.edges.length, "edge"), counted(structure.dofs.length, "dof")]
    : ofMatrix ? [counted(structure.dofs.length, "dof")] : [counted(structure.nodes.length, "node"), counted(frames[frames.length - 1].elements.length, "element")];
  byId("size").textContent = [...size, counted(places.pairs.length, "pair"), counted(result.steps.length, "load step"),
    counted(increments.length, "increment")].join(", ");
  byId("verdict").replaceChildren(...verdicts().map(([text, kind]) => element("li", { class: kind }, text)));
  byId("mesh-words").hidden = !result.steps.some((s) => s.certificate);
}

function showLog() {
  const [leader] = kernelNames();
  byId("log-words").textContent = result.log === "" ? `${leader} wrote nothing to unit 26, or writes no text.` : `What ${leader} wrote to unit 26.`;
  byId("log-text").textContent = result.log;
  byId("log-text").hidden = result.log === "";
}

function showCuts() {
  const pairs = places.pairs.length;
  if (pairs > mostPairRows) cuts.add(`Pairs in a state: the first ${mostPairRows} of ${pairs} are listed.`);
  if (increments.length > mostEventRows) cuts.add(`Of ${increments.length} increments the first ${mostEventRows} are listed.`);
  for (const note of structure.notes || []) cuts.add(note);
  const within = increments.length + 1 + result.steps.filter((s) => !endsAt(s, s.increments.length - 1)).length;
  if (frames.length < within) {
    cuts.add(`The path has ${increments.length} increments; the slider stops at ${frames.length} states: the start, some of the ` +
      "increments, evenly chosen, and the ends of steps.");
  }
  const isSum = ({ words, uniform, point, settlement }) => words !== "none" && words !== "" && !uniform && !point && !settlement;
  if (frames.some((f) => isSum(f.load))) cuts.add("Loads of more than 32 parts are not drawn: their sum is told.");
  if (result.log.length < result.log_bytes) cuts.add(`Of ${result.log_bytes} bytes of unit 26 the first ${result.log.length} are shown.`);
  const list = cuts.size > 0 ? [...cuts] : [`Nothing: every increment, ${unitOf()}, pair and call is on this page.`];
  byId("cuts").replaceChildren(...list.map((text) => element("li", {}, text)));
}

const pictureWords = {
  beam: "Up is positive. Between two increments every point moves along a straight line. Numbers under supports are reactions. " +
    "Moments M = EI w\u2033 (positive where the beam sags) and shears V = dM/dx (the upward force of the part left of a cut on the part right of it) " +
    "are those of EI w\u2033\u2033 = q between the nodes too; dots are at the largest values.",
  plate: "The colours are the same in all states: dark is low. Up is positive; moments are those of sagging, means of the elements at each " +
    "node; between nodes colours are interpolated. " +
    "The square of a pair in contact grows with its force; a bar over a pair means that its face is above.",
  mesh: "Edges are drawn straight between their nodes. Between two increments every point moves along a straight line. " +
    "A face is drawn beside its node, across the direction of the pair's dof, at its distance from the undeformed node, " +
    "magnified as displacements are. Numbers at supports are reactions.",
  none: "No coordinates of this structure are known, so it is not drawn. [matrix] takes coordinates, [calculix] the mesh in CalculiX's input.",
};

function showLegend() {
  const kind = beam ? "beam" : plate ? "plate" : mesh ? "mesh" : "none";
  const looked = new Set(frames.flatMap((f) => f.pairs.map((p) => (p.look === "f" && p.closed ? "f in contact" : p.look))));
  const pairs = [["c", "in contact, with a force"], ["o", "separated, with a gap"], ["f", "at its face, separated"],
    ["f in contact", "at its face, in contact, no force"]].map(([look, words]) => [looked.has(look), words, () => pairMark(look[0], 11, 9, 5, look === "f in contact")]);
  const loads = frames.flatMap(pointsOf).filter((p) => p.value !== 0);
  const loaded = loads.length > 0 || frames.some((f) => (f.load.uniform || []).length > 0);
  const holds = (w) => places.supports.some((s) => s.dofs.some(([dof]) => dof === "w") === w);
  const cross = () => shape("M8 6l6 6m-6 0l6 -6", "thin");
  const fromSide = [[places.pairs.length > 0, "face, hatched behind", () => shape("M2 8h18M4 8l-4 6M10 8l-4 6M16 8l-4 6", "face-line")],
    [frames.some((f) => f.pairs.some((p) => p.force > 0)), "contact force", () => arrow(11, 17, 0, -15, "force")],
    [loaded, "load", () => arrow(11, 1, 0, 15, "load")],
    [true, "undeformed", () => line(0, 9, 22, 9, beam ? "undeformed" : "mesh-was")]];
  const items = {
    beam: () => [...pairs, ...fromSide],
    mesh: () => [...pairs, ...fromSide, [places.supports.length > 0, "support of a dof", () => shape("M11 3l7 12h-14Z", "support")],
      [mesh.still.length > 0, "node without a dof: it does not move", cross]],
    plate: () => [...pairs, [loads.some((p) => p.dof === "w" && p.value < 0), "load, down", () => plateLoad(11, 9, true)],
      [loads.some((p) => p.dof === "w" && p.value > 0), "load, up", () => plateLoad(11, 9, false)],
      [holds(true), "support of w", () => shape("M11 3l6 11h-12Z", "support")],
      [plate.reaction > 0, "reaction up, by its area", () => svg("circle", { cx: 11, cy: 9, r: 7, class: "reaction" })],
      [holds(false), "support of a slope", cross]],
    none: () => [],
  };
  byId("legend").classList.toggle("on-map", kind === "plate");
  byId("legend").replaceChildren(...items[kind]().filter(([there]) => there).map(([, words, mark]) =>
    element("li", {}, svg("svg", { width: 22, height: 18, viewBox: "0 0 22 18", "aria-hidden": "true" }, mark()), words)));
  byId("picture-words").textContent = pictureWords[kind];
}

// What can be chosen of the picture: a plate's quantity, a direction of view.
function offer(id, options, chosen) {
  byId(`${id}-label`).hidden = byId(id).hidden = options.length === 0;
  byId(id).replaceChildren(...options.map(([value, words]) => element("option", { value }, words)));
  byId(id).value = chosen;
}

// ---- where we are ----

let current = 0;
let timer = 0;
const calm = matchMedia("(prefers-reduced-motion: reduce)");

// What else is done when a state was drawn: the playground has handles on the picture.
let afterDrawing = () => {};

function draw() {
  drawPicture(frames[current], byId("picture"));
  afterDrawing(frames[current]);
}

function show(n) {
  current = Math.max(0, Math.min(frames.length - 1, n));
  const f = frames[current];
  const slider = byId("slider");
  slider.value = String(current);
  slider.setAttribute("aria-valuetext", `${where(f)}, state ${current + 1} of ${frames.length}`);
  byId("state").textContent = stateWords(f);
  draw();
  drawChart(f);
  showPairs(f);
  markCurrentRow(f);
}

function playingIs(on) {
  byId("play").setAttribute("aria-pressed", String(on));
  byId("play").textContent = on ? "Pause" : "Play";
}

function stopPlaying() {
  clearInterval(timer);
  timer = 0;
  playingIs(false);
}

function startPlaying() {
  playingIs(true);
  if (current === frames.length - 1) show(0);
  timer = setInterval(() => (current < frames.length - 1 ? show(current + 1) : stopPlaying()), calm.matches ? 1600 : 1100);
}

function listen() {
  const go = (id, event, to) => byId(id).addEventListener(event, () => { stopPlaying(); show(to()); });
  go("slider", "input", () => Number(byId("slider").value));
  go("back", "click", () => current - 1);
  go("next", "click", () => current + 1);
  byId("play").addEventListener("click", () => (timer ? stopPlaying() : startPlaying()));
  byId("field").addEventListener("change", (e) => { field = fields.find((f) => f.name === e.target.value); draw(); });
  byId("view").addEventListener("change", (e) => { view = Number(e.target.value); draw(); });
  byId("chart-node").addEventListener("change", (e) => { followed = paths.find((p) => p.name === e.target.value); drawChart(frames[current]); });
  let width = innerWidth;
  addEventListener("resize", () => {
    if (innerWidth === width || !result) return;
    width = innerWidth;
    show(current);
  });
  // On paper there is the final state.
  addEventListener("beforeprint", () => { stopPlaying(); printing = true; show(frames.length - 1); });
  addEventListener("afterprint", () => { printing = false; show(current); });
}

// The state with the largest deflection.
const mostMoved = () => frames.reduce((best, f, i) => (Math.abs(mostOf(f).value) > Math.abs(mostOf(frames[best]).value) ? i : best), frames.length - 1);

// Draw a result, at this state of its path. What a report has more is in showRest.
function load(given, state = null) {
  read(given);
  preparePicture();
  preparePaths();
  showHead();
  showLegend();
  offer("field", fields.map((f) => [f.name, f.words]), field && field.name);
  offer("view", mesh ? views.map((v, i) => [String(i), v.words]) : [], String(view));
  showEvents();
  byId("slider").max = String(frames.length - 1);
  show(state ?? mostMoved());
}

function showRest() {
  showTables();
  showCalls();
  showCertificate();
  showLog();
  showCuts();
}
