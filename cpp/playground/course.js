// A page of the course. Each picture becomes a scene when the reader scrolls to it. Without JavaScript, the page shows
// the pictures.
"use strict";

function sceneAt(holder) {
  const [[still], { rules, beside, ...more }] = [holder.children, given.scenes[holder.dataset.scene]];
  if (rules) new TwoRules(holder, { kernels: rules, ...more });
  else new ContactScene(holder, { listing: given.listing, beside: beside && given.beside, ...more });
  holder.append(still); // on paper the scene is its picture
}

const units = { "": ["", 1], "%": ["", 0.01], m: ["length", 1], cm: ["length", 0.01], mm: ["length", 0.001], kn: ["force", 1], n: ["force", 0.001] };

/** The kind and the size of the number in words such as "1/64", "2,5 mm" or "stop 3"; null if they have not exactly one.
    `unit`: that of a number without a unit. */
function numberIn(words, unit) {
  const [found, ...more] = words.toLowerCase().replace(/,/g, ".").replace(/\u2212/g, "-").matchAll(/(-?(?:\d+\.?\d*|\.\d+)(?:e-?\d+)?)(?:\s*\/\s*(\d+\.?\d*))?\s*(mm|cm|m|kn|n|%)?(?![a-z])/g);
  const [kind, factor] = units[found?.[3] ?? unit];
  return found && more.length === 0 ? { kind, size: (factor * found[1]) / (found[2] ?? 1) } : null;
}

/** A field for the reader's own answer, before an answer that is a number or a range, as "15kN" or "0.015..0.016mm". Of a
    negative answer, a downward force, the size is enough. */
document.querySelectorAll("details[data-is]").forEach((details) => {
  const [, low, high = low, unit] = /^([-.\d]+?)(?:\.\.([-.\d]+))?([a-z]*)$/.exec(details.dataset.is.toLowerCase());
  const [least, most] = [numberIn(low, unit), numberIn(high, unit)];
  const near = (x) => x >= least.size - 0.01 * Math.abs(least.size) && x <= most.size + 0.01 * Math.abs(most.size);
  const [field, said] = [element("input", { "aria-label": "Your answer" }), element("span", { role: "status" })];
  field.addEventListener("change", () => {
    const answer = numberIn(field.value, unit);
    const right = answer?.kind === most.kind && (near(answer.size) || (most.size < 0 && near(-answer.size)));
    said.textContent = right ? " Right." : answer === null ? " Write one number, such as 0.004." : " Not yet: try again, or open the answer.";
    details.open = details.open || right;
  });
  details.before(element("p", { class: "guess" }, "Your answer: ", field, said));
});

/** On paper, all details are open, and the answers are at the end. */
addEventListener("beforeprint", () => {
  document.querySelectorAll("details").forEach((details) => { details.open = true; });
  const answers = [...document.querySelectorAll(".answer")];
  const places = answers.map((_, k) => element("p", {}, `Answer ${k + 1} is at the end.`));
  answers.forEach((answer, k) => answer.replaceWith(places[k]));
  const end = element("section", { class: "answers" }, ...answers.flatMap((answer, k) => [element("p", {}, `Answer ${k + 1}`), answer]));
  if (answers.length > 0) document.querySelector("main").append(end);
  addEventListener("afterprint", () => { places.forEach((place, k) => place.replaceWith(answers[k])); end.remove(); }, { once: true });
});

async function startCourse() {
  const places = [...document.querySelectorAll("[data-scene]")];
  if (places.length === 0) return;
  program = await contct_module();
  const seen = new IntersectionObserver((entries) => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting) continue;
      seen.unobserve(target);
      sceneAt(target);
      target.dataset.lives = "yes";
    }
  }, { rootMargin: "400px" });
  places.forEach((place) => seen.observe(place));
}
startCourse();
