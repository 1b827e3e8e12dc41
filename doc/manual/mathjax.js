/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Formulas begin at the left and break at the width of their column: on a phone it is narrow. */
MathJax.Hub.Config({
  displayAlign: "left",
  displayIndent: "0em",
  SVG: { linebreaks: { automatic: true, width: "container" } }
});
