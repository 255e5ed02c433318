// A page of the course. Each picture becomes a scene when the reader scrolls to it. Without JavaScript, the page shows
// the pictures.
"use strict";

function sceneAt(holder) {
  const { rules, beside, ...more } = given.scenes[holder.dataset.scene];
  return rules ? new TwoRules(holder, { kernels: rules, ...more }) : new ContactScene(holder, { listing: given.listing, beside: beside && given.beside, ...more });
}

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
