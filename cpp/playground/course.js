// A page of the course. Each picture becomes a scene when the reader scrolls to it. Without JavaScript, the page shows
// the pictures.
"use strict";

function sceneAt(holder) {
  const { rules, beside, ...more } = given.scenes[holder.dataset.scene];
  return rules ? new TwoRules(holder, { kernels: rules, ...more }) : new ContactScene(holder, { listing: given.listing, beside: beside && given.beside, ...more });
}

/** A field for the reader's own answer, before an answer that is a number. */
document.querySelectorAll("details[data-is]").forEach((details) => {
  const [field, said] = [element("input", { inputmode: "decimal", "aria-label": "Your answer" }), element("span", { role: "status" })];
  field.addEventListener("change", () => {
    const near = Math.abs(Number(field.value) / Number(details.dataset.is) - 1) <= 0.01;
    said.textContent = near ? " Right." : " Not yet: try again, or open the answer.";
    details.open = details.open || near;
  });
  details.before(element("p", { class: "guess" }, "Your answer: ", field, said));
});
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((details) => { details.open = true; }));

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
