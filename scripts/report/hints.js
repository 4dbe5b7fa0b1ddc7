// SPDX-License-Identifier: MIT
// What a mark of a chart says (its <title>) beside the pointer, at once.
"use strict";
(() => {
const tooltip = document.createElement("div");
tooltip.className = "tooltip";
tooltip.hidden = true;
document.body.append(tooltip);
for (const mark of document.querySelectorAll("svg .hint")) {
    const title = mark.querySelector("title");
    mark.setAttribute("aria-label", title.textContent);
    title.remove(); // or the browser would show it a second time
}
addEventListener("pointermove", event => {
    const mark = event.target.closest?.("svg .hint");
    tooltip.hidden = !mark;
    if (!mark) return;
    tooltip.textContent = mark.getAttribute("aria-label");
    const width = tooltip.offsetWidth;
    tooltip.style.left = Math.min(event.clientX + 12, innerWidth - width - 8) + "px";
    tooltip.style.top = event.clientY + 14 + "px";
});
})();
