/* A larger view of pictures whose text is too small to read at the width of their column, as on a phone.

   Such a picture gets a button below it; the button and a click on the picture open a dialog that shows the picture with
   legible text and scrolls in both directions. Esc, the button Close and a click beside the dialog close it. */

(() => {
  "use strict";

  const LEGIBLE = 9; // CSS pixels: text below this size is too small
  const COMFORTABLE = 12; // CSS pixels: minimum text size in the larger view
  const PLOTTED = 13.9; // pixels: matplotlib's default text, 10 pt at 100 dots per inch

  const buttons = new Map(); // picture -> its button

  /* The size of the smallest text of a picture as it is shown [CSS px]; Infinity without text. */
  function smallestText(svg) {
    if (svg instanceof HTMLImageElement) return (PLOTTED * svg.getBoundingClientRect().width) / svg.naturalWidth;
    let least = Infinity;
    for (const text of svg.querySelectorAll("text, tspan")) {
      const matrix = text.getScreenCTM();
      if (!matrix || ![...text.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.data.trim())) continue;
      const scale = Math.sqrt(Math.abs(matrix.a * matrix.d - matrix.b * matrix.c));
      least = Math.min(least, scale * Number.parseFloat(getComputedStyle(text).fontSize));
    }
    return least;
  }

  /* The caption of a picture, or the first sentence of its description. */
  function nameOf(svg) {
    const caption = svg.closest("figure:has(> figcaption)")?.querySelector(":scope > figcaption .caption-text");
    return caption?.textContent.trim() || svg.getAttribute("aria-label")?.split(". ")[0] || "picture";
  }

  const dialog = document.createElement("dialog");
  dialog.className = "larger-view";
  dialog.setAttribute("aria-label", "Larger view");
  dialog.innerHTML = '<form method="dialog"><button>Close</button></form><div role="group" tabindex="0"></div>';
  const room = dialog.lastElementChild;
  const place = document.createElement("div"); // keeps the place of the picture that is in the dialog

  function open(svg) {
    const { width, height } = svg.getBoundingClientRect();
    const legible = (width * COMFORTABLE) / smallestText(svg);
    room.setAttribute("aria-label", nameOf(svg));
    place.style.height = `${height}px`;
    svg.replaceWith(place);
    room.replaceChildren(svg);
    buttons.get(svg).focus({ preventScroll: true }); // where the focus returns to
    dialog.showModal();
    svg.style.setProperty("--larger", `${Math.max(legible, room.clientWidth)}px`);
    room.scrollTo(0, 0);
    room.focus();
  }

  function shut() {
    if (place.isConnected) place.replaceWith(room.firstElementChild);
  }

  dialog.addEventListener("close", shut);
  // Sphinx's own handler of Esc, on the document, would prevent the browser from closing the dialog.
  dialog.addEventListener("keydown", (event) => event.key === "Escape" && event.stopPropagation());
  dialog.addEventListener("click", ({ target }) => target === dialog && dialog.close());
  globalThis.addEventListener("beforeprint", () => {
    dialog.close();
    shut(); // before the event, which comes too late for the print
  });

  function buttonOf(svg) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "larger";
    button.textContent = "Larger view";
    button.setAttribute("aria-label", `Larger view: ${nameOf(svg)}`);
    button.setAttribute("aria-haspopup", "dialog");
    button.addEventListener("click", () => open(svg));
    svg.addEventListener("click", ({ target }) => !button.hidden && !dialog.open && !target.closest("a") && open(svg));
    svg.after(button);
    return button;
  }

  const sizes = new ResizeObserver((entries) => {
    for (const { target: svg } of entries) {
      if (dialog.contains(svg)) continue;
      const isSmall = smallestText(svg) < LEGIBLE;
      if (isSmall && !buttons.has(svg)) buttons.set(svg, buttonOf(svg));
      if (buttons.has(svg)) buttons.get(svg).hidden = !isSmall;
      svg.classList.toggle("opens", isSmall);
    }
  });
  document.body.append(dialog);
  // A script soon replaces the still picture of a player.
  const drawn = '.rosmini-figure:not([data-mounted]) svg[role=img], .cell_output img[src$=".png"]';
  for (const svg of document.querySelectorAll(`.bd-article :is(${drawn})`)) {
    if (!svg.parentElement.closest("svg")) sizes.observe(svg);
  }
})();
