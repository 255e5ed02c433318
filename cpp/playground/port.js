// The judge of page 12: a kernel in JavaScript, typed into a box, answers the golden calls. The judge draws the first
// call with a wrong answer, and compares all answers with the answers of known faults, as
// reference/course/port/hint.py does.
"use strict";

const emptyKernel = `// dd, dtest, cc, ss, id, isep, isurf: arrays that begin with 0. Nodes and dofs are numbered from 1.
// Write ss and isep, and return SMIN.
function contct(dd, dtest, cc, ss, id, isep, isurf, nc, indof, ndofpn) {

}
`;
const unset = -7; // the value of SS before a call
const patience = 3000; // ms

/** In the worker: the answers of a kernel's source to calls. `tell` receives the number of each call before it. */
function answerAll(source, calls, tell) {
  const kernel = new Function(`${source}\nreturn contct;`)();
  return calls.map((c, number) => {
    tell(number);
    const [dd, dtest] = [1, 2].map((k) => {
      const all = new Float64Array(c.ndof).fill(NaN);
      for (const dof of c.dofs) all[dof[0] - 1] = dof[k];
      return all;
    });
    const [id, isep, isurf] = [0, 1, 2].map((k) => Int32Array.from(c.pairs, (p) => p[k]));
    const ss = new Float64Array(c.pairs.length).fill(-7); // unset
    try {
      const smin = Number(kernel(dd, dtest, Float64Array.from(c.pairs, (p) => p[3]), ss, id, isep, isurf, c.pairs.length, c.indof, c.ndofpn));
      return { smin, ss: [...ss], isep: [...isep] };
    } catch (error) {
      return { error: String(error) };
    }
  });
}

/** The answers of a kernel's source, or an error. A worker that exceeds `patience` is stopped. */
function answersOf(source, calls) {
  const code = `onmessage = (e) => { try { postMessage({ answers: (${answerAll})(e.data.source, e.data.calls, (number) => postMessage({ number })) }); }
    catch (error) { postMessage({ error: String(error) }); } };`;
  const place = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
  const worker = new Worker(place);
  return new Promise((done) => {
    let number = 0;
    const end = (what) => { clearTimeout(clock); worker.terminate(); URL.revokeObjectURL(place); done(what); };
    const clock = setTimeout(() => end({ error: `The kernel does not answer call ${calls[number].name} in ${patience / 1000} seconds: is there a loop that does not end?` }), patience);
    worker.onmessage = (e) => { if (e.data.number === undefined) end(e.data); else number = e.data.number; };
    worker.onerror = (e) => end({ error: e.message });
    worker.postMessage({ source, calls });
  });
}

// ---- the computations of hint.py ----

const bitsOf = (() => {
  const view = new DataView(new ArrayBuffer(8));
  return (x) => {
    if (Number.isNaN(x)) return [0x7ff80000, 0];
    view.setFloat64(0, x);
    return [view.getUint32(0), view.getUint32(4)];
  };
})();
const hex = (...words) => words.map((w) => w.toString(16).padStart(8, "0")).join("");
const sameBits = (a, b) => hex(...bitsOf(a)) === hex(...bitsOf(b));

function digestOf(answers) {
  let h = 2166136261;
  for (const { smin = unset, ss = [], isep = [] } of answers) {
    for (const word of [...[smin, ...ss].flatMap(bitsOf), ...isep]) {
      h = Math.imul(h ^ word, 16777619) >>> 0;
      h = (h ^ (h >>> 15)) >>> 0;
    }
  }
  return hex(h);
}

/** The first value that differs, in the order of the listing; null if all bits are equal. */
function firstDifference(answer, right) {
  if (answer.error) return { quantity: "no answer", pair: 0, bits: "" };
  const at = (quantity, i, value, expected) => ({ quantity, pair: i + 1, value, right: expected, bits: quantity === "ISEP" ? String(value) : hex(...bitsOf(value)) });
  const s = right.ss.findIndex((x, i) => !sameBits(x, answer.ss[i]));
  if (s >= 0) return at("SS", s, answer.ss[s], right.ss[s]);
  if (!sameBits(answer.smin, right.smin)) return at("SMIN", -1, answer.smin, right.smin);
  const k = right.isep.findIndex((x, i) => x !== answer.isep[i]);
  return k < 0 ? null : at("ISEP", k, answer.isep[k], right.isep[k]);
}

/** The hints of hints.toml for these answers. */
function hintOf(digest, first, quantity, right) {
  const known = Object.values(given.hints);
  const same = known.filter((h) => h.digest === digest);
  if (same.length > 0) return ["All answers are those of this fault:", ...same.map((h) => h.says)];
  const stage = given.stages.find((s) => s.digests.includes(digest));
  if (stage) return ["No fault: the answers match an unfinished port. Next:", stage.next];
  const alike = known.filter((h) => h.first === first && right > 0);
  return alike.length > 0 ? ["The first wrong answer matches these faults:", ...alike.slice(0, 3).map((h) => h.says)] : ["No known fault gives this answer.", given.where[quantity]];
}

// ---- the page ----

class KernelJudge extends Scene {
  constructor(holder) {
    super(holder, "div");
    // NaN and infinity are texts in JSON.
    const real = (x) => (typeof x === "string" ? Number(x.replace("inf", "Infinity")) : x);
    this.calls = given.golden.map((c) => ({ ...c, dofs: c.dofs.map((d) => d.map(real)), pairs: c.pairs.map((p) => p.map(real)), smin: real(c.smin), ss: c.ss.map(real) }));
    this.source = element("textarea", { spellcheck: "false", rows: "16", "aria-label": "A kernel in JavaScript" });
    this.source.value = emptyKernel;
    this.button = button("Judge", () => this.judge());
    holder.classList.add("port");
    holder.replaceChildren(this.source, element("div", { class: "controls" }, this.button), this.words, this.picture);
    holder.dataset.lives = "yes";
  }

  async judge(source = this.source.value) {
    this.source.value = source;
    this.button.disabled = true;
    this.say("Judging.");
    const { answers, error } = await answersOf(source, this.calls);
    this.button.disabled = false;
    this.picture.replaceChildren();
    if (error) return this.say(`No golden call was judged. ${error}`);
    const wrong = answers.map((a, i) => [this.calls[i], a, firstDifference(a, this.calls[i])]).filter(([, , difference]) => difference);
    const count = `${answers.length - wrong.length} of ${answers.length} golden calls are right to the bit.`;
    if (wrong.length === 0) return this.say(count, "This is CONTCT, as far as the golden set can tell.");
    const [call, answer, found] = wrong[0];
    const value = found.bits === "" ? answer.error : `${found.quantity}${found.pair ? `(${found.pair})` : ""} is ${found.value}; right: ${found.right}.`;
    this.say(count, `First wrong: ${call.name}${call.note ? `: ${call.note}` : ""}. ${value}`,
      ...hintOf(digestOf(answers), `${call.name} ${found.quantity} ${found.pair} ${found.bits}`, found.quantity, answers.length - wrong.length));
    if (!answer.error) this.draw(call, answer);
  }

  say(...sentences) { this.words.replaceChildren(...sentences.map((s) => element("p", {}, s))); }

  /** Draws the pairs of a call along a line by their s from 0 to 1: the right s above the line, the kernel's s below.
      Near pairs are stacked; toggled pairs are gold. */
  draw(call, answer) {
    const [width, height, middle, left, right] = [widthOf(this.picture), 260, 120, 84, 40];
    const S = (s) => left + s * (width - left - right);
    const root = canvas(this.picture, width, height, `The pairs of call ${call.name} by their s, right ones above and yours below`);
    root.append(line(S(0), middle, S(1), middle, "zero"), ...[0, 1].map((s) => line(S(s), middle - 5, S(s), middle + 5, "zero")),
      axisWord(S(0), height - 8, "0", "start"), axisWord(S(1), height - 8, "1: all the load", "end"), label(8, middle - 20, "right"), label(8, middle + 30, "yours"));
    for (const [of, y, up] of [[call, middle - 24, -26], [answer, middle + 24, 26]]) {
      const say = wordsInFreePlaces(root, width, height - 14, left);
      const shown = of.ss.map((s, i) => ({ s, i, at: S(s), toggled: of.isep[i] !== call.pairs[i][1] })).filter(({ s }) => s >= 0 && s <= 1);
      shown.forEach(({ s, i, at, toggled }, k) => {
        const place = y + up * Math.min(3, shown.slice(0, k).filter((other) => Math.abs(other.at - at) < 18).length);
        const words = `${i + 1}: ${rough(s)}${toggled ? ", toggled" : ""}`;
        root.append(svg("circle", { cx: at, cy: place, r: toggled ? 8 : 6, class: toggled ? "dot gold" : "dot", "data-s": String(s) }, svg("title", {}, `pair ${i + 1}: s = ${s}`)));
        say(at + (s > 0.5 ? -1 : 1) * (16 + 4.4 * words.length), place + 4, words, "axis-word");
      });
      const others = of.ss.length - shown.length;
      if (others > 0) root.append(label(8, y + (up < 0 ? -40 : 52), `${counted(others, "pair")} outside 0 to 1`, { class: "axis-word" }));
    }
  }
}

document.querySelectorAll("[data-port]").forEach((place) => new KernelJudge(place));
