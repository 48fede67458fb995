"use strict";
(() => {
  const nav = document.querySelector("nav");
  const menu = nav.querySelector("button");
  const links = [...nav.querySelectorAll("a")];
  const show = (open) => {
    nav.classList.toggle("open", open);
    menu.setAttribute("aria-expanded", String(open));
  };
  menu.addEventListener("click", () => show(!nav.classList.contains("open")));
  // A link to something folded unfolds it, with all around it.
  const unfold = (hash) => {
    const target = hash && document.getElementById(decodeURIComponent(hash.slice(1)));
    if (!target) return;
    for (let each = target; each; each = each.parentElement) if (each.tagName === "DETAILS") each.open = true;
    target.scrollIntoView();
  };
  addEventListener("hashchange", () => unfold(location.hash));
  for (const link of links) {
    link.addEventListener("click", () => {
      show(false);
      unfold(link.hash);
    });
  }
  unfold(location.hash);
  const all = nav.querySelector(".all");
  let unfolded = false;
  all.addEventListener("click", () => {
    unfolded = !unfolded;
    for (const each of document.querySelectorAll("details.section, details.long")) each.open = unfolded;
    all.textContent = unfolded ? "Fold everything" : "Unfold everything";
    show(false);
  });
  // The section at the top of the window is marked in the contents.
  const sections = links.map((link) => document.getElementById(link.hash.slice(1)));
  const mark = () => {
    let here = 0;
    sections.forEach((section, index) => {
      if (section && section.getBoundingClientRect().top < innerHeight / 3) here = index;
    });
    links.forEach((link, index) => link.classList.toggle("here", index === here));
  };
  addEventListener("scroll", mark, { passive: true });
  mark();
})();
